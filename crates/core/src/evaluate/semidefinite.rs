//! Which nodes are nowhere negative by value, such as x^2 - 2 x y + 2 y^2 = (x - y)^2 + y^2.
//!
//! A node is a polynomial in *variables*: the symbols and functions that its sums and products are made of. If it has degree
//! 2 in some of them, x, it is v^T M v with v = (x, 1), and it is nowhere negative if M is positive semidefinite: if
//! all pivots of M = L D L^T are nowhere negative [Golub & Van Loan 2013, sec. 4.2.8]. The elements of M may depend on
//! the other variables. So the square of the length of two bars, l1^2 + l2^2 + 2 l1 l2 cos(q), has the pivots 1 and
//! 1 - cos(q)^2 = sin(q)^2.
//!
//! Everything is found by value, in each lane: M from differences at the random point, and whether a pivot is nowhere
//! negative: it is a positive number, or it is positive in all lanes, as squares are. A function that is negative
//! somewhere is positive in a lane with a probability of 1/2. So the answer is the same for all forms, as long as they
//! are made of the same variables.
//!
//! Two more steps cover what has another degree: terms that are nowhere negative, such as z^4, are split off first
//! ([`Part::Term`]), and a sum A + B cos(q) + C sin(q) is a quadratic form in (cos(q/2), sin(q/2)) ([`Part::Angle`]).

use crate::graph::{Graph, Id};
use crate::value::{Field, FieldId, Number, Quadratic, fingerprint};

use super::polynomial::{InLane, Polynomial, with};

/// The bits of a number that is told from other values in the hash lanes, which have 126 bits.
const LONGEST_NUMBER: u64 = 110;

/// What is shown to be nowhere negative, by the variables it depends on.
#[derive(Clone)]
enum Part {
    /// A quadratic form in these variables.
    Form(Vec<usize>),
    /// What vanishes with this variable.
    Term(usize),
    /// A sum A + B cos(q) + C sin(q): the variables that are the cosine and the sine, of which one may be missing.
    Angle([Option<usize>; 2]),
}

/// What the hash lanes show of a pivot.
struct Claim {
    number: Option<Number>,
    is_positive: bool,
}

impl Graph {
    /// Whether the value of a node that is real for real variables is seen to be nowhere negative.
    pub(super) fn is_semidefinite(&self, id: Id) -> bool {
        let id = self.representative(id);
        if let Some(known) = self.lanes.borrow().is_semidefinite(id) {
            return known;
        }
        let found = self.polynomial(id).is_some_and(|polynomial| self.is_nonnegative_polynomial(&polynomial));
        self.lanes.borrow_mut().insert_semidefinite(id, found);
        found
    }

    fn is_nonnegative_polynomial(&self, polynomial: &Polynomial) -> bool {
        let hash = FieldId::HASH.map(|field| self.in_lane(polynomial, field));
        let mut others: Vec<InLane> = Vec::new();
        let mut holds = |zero: &[usize], part: &Part| {
            let Some(claims) = claims(&hash, zero, part) else { return false };
            if others.is_empty() {
                let fields = (0..polynomial.points).flat_map(FieldId::others);
                others = fields.map(|field| self.in_lane(polynomial, field)).collect();
            }
            others.iter().all(|lane| {
                let pivots = lane.pivots(zero, part);
                pivots.is_some_and(|pivots| {
                    pivots.iter().zip(&claims).all(|(value, claim)| claim.holds(value, lane.f))
                })
            })
        };
        if holds(&[], &Part::Form(Vec::new())) {
            return true;
        }
        let all: Vec<usize> = (0..polynomial.variables.len()).collect();
        let free = self.free_variables(polynomial);
        [&free, &all].into_iter().take(if free.len() < all.len() { 2 } else { 1 }).any(|variables| {
            let mut zero = Vec::new();
            for &variable in variables {
                if holds(&zero, &Part::Term(variable)) {
                    zero.push(variable);
                }
            }
            let form = hash[0].quadratic_variables(variables, &zero);
            holds(&zero, &Part::Form(form))
                || self.angles(polynomial).into_iter().any(|angle| holds(&zero, &Part::Angle(angle)))
        })
    }
}

/// What both hash lanes show of the pivots of a part; `None` if one of them is no square and no positive number.
fn claims(hash: &[InLane; 2], zero: &[usize], part: &Part) -> Option<Vec<Claim>> {
    let [first, second] = hash.each_ref().map(|lane| lane.pivots(zero, part));
    first?.iter().zip(&second?).map(|(a, b)| Claim::of([a, b], hash)).collect()
}

impl Claim {
    fn of(values: [&Quadratic; 2], hash: &[InLane; 2]) -> Option<Self> {
        let is_positive = values.iter().zip(hash).all(|(value, lane)| is_positive(value, lane.f));
        let are_real = values.iter().all(|value| value.is_real());
        let short =
            |number: &Number| number.numerator().bits() + number.denominator().bits() <= LONGEST_NUMBER;
        let value = fingerprint(values);
        let number = if are_real {
            value.to_simple_rational().or_else(|| value.to_rational_of_short_form())
        } else {
            None
        };
        let number = number.filter(|number| !number.is_negative() && short(number));
        (is_positive || number.is_some()).then_some(Self { number, is_positive })
    }

    fn holds(&self, value: &Quadratic, f: &Field) -> bool {
        self.number.as_ref().is_some_and(|number| f.is_number(value, number))
            || self.is_positive && is_positive(value, f)
    }
}

fn is_positive(value: &Quadratic, f: &Field) -> bool {
    value.is_real() && f.sign(value) == f.one()
}

impl InLane {
    /// The pivots of a part where some variables are zero: they are nowhere negative only if the part is.
    fn pivots(&self, zero: &[usize], part: &Part) -> Option<Vec<Quadratic>> {
        let base = self.with_zeros(zero);
        match part {
            Part::Form(variables) => self.ldl(self.matrix_of_form(&base, variables)?),
            Part::Angle(angle) => self.ldl(self.matrix_of_angle(&base, *angle)?),
            Part::Term(variable) => {
                let without = with(&base, [(*variable, self.integer(0))]);
                Some(vec![self.f.sub(&self.at(&base)?, &self.at(&without)?)])
            }
        }
    }

    /// The matrix M of the quadratic form v^T M v with v = (x, 1), where x is measured from the point.
    ///
    /// Its last element is the value at the point, so this is not negative if M is semidefinite, whatever the degree is.
    fn matrix_of_form(&self, base: &[Quadratic], variables: &[usize]) -> Option<Vec<Vec<Quadratic>>> {
        let f = self.f;
        let n = variables.len();
        let moved = |steps: &[usize]| {
            let mut point = base.to_vec();
            for &k in steps {
                point[variables[k]] = f.add(&point[variables[k]], &f.one());
            }
            self.at(&point)
        };
        let start = moved(&[])?;
        let ahead: Vec<Quadratic> = (0..n).map(|i| moved(&[i])).collect::<Option<_>>()?;
        let mut matrix = vec![vec![start.clone(); n + 1]; n + 1];
        for i in 0..n {
            for j in 0..=i {
                let changes = f.sub(&moved(&[i, j])?, &f.add(&ahead[i], &ahead[j]));
                matrix[i][j] = f.half(&f.add(&changes, &start));
                matrix[j][i] = matrix[i][j].clone();
            }
            let slope = f.sub(&f.sub(&ahead[i], &start), &matrix[i][i]);
            matrix[i][n] = f.half(&slope);
            matrix[n][i] = matrix[i][n].clone();
        }
        Some(matrix)
    }

    /// The matrix M of A + B cos(q) + C sin(q) = v^T M v with v = (cos(q/2), sin(q/2)): `[[A + B, C], [C, A - B]]`.
    fn matrix_of_angle(&self, base: &[Quadratic], angle: [Option<usize>; 2]) -> Option<Vec<Vec<Quadratic>>> {
        let f = self.f;
        let at = |cos: i64, sin: i64| {
            let places = angle.iter().zip([cos, sin]);
            let moves = places.filter_map(|(variable, value)| Some(((*variable)?, self.integer(value))));
            self.at(&with(base, moves))
        };
        let (ahead, behind, left, right) = (at(1, 0)?, at(-1, 0)?, at(0, 1)?, at(0, -1)?);
        let (twice, across) = (f.add(&ahead, &behind), f.half(&f.sub(&left, &right)));
        let part = |variable: Option<usize>, factor: &Quadratic| {
            variable.map_or(self.integer(0), |variable| f.mul(&base[variable], factor))
        };
        let waves = f.add(&part(angle[0], &f.half(&f.sub(&ahead, &behind))), &part(angle[1], &across));
        let is_sum = f.add(&left, &right) == twice && self.at(base)? == f.add(&f.half(&twice), &waves);
        is_sum.then(|| vec![vec![ahead, across.clone()], vec![across, behind]])
    }

    /// The pivots D of a symmetric matrix M = L D L^T; `None` if one is zero and the rest of its row is not.
    fn ldl(&self, mut matrix: Vec<Vec<Quadratic>>) -> Option<Vec<Quadratic>> {
        let f = self.f;
        let n = matrix.len();
        for k in 0..n {
            let pivot = matrix[k][k].clone();
            if pivot.is_zero() {
                if matrix[k][k..].iter().any(|element| !element.is_zero()) {
                    return None;
                }
                continue;
            }
            let inverse = f.inverse(&pivot);
            let row = matrix[k].clone();
            for i in k + 1..n {
                let multiplier = f.mul(&row[i], &inverse);
                for j in k + 1..n {
                    matrix[i][j] = f.sub(&matrix[i][j], &f.mul(&multiplier, &row[j]));
                }
            }
        }
        Some((0..n).map(|k| matrix[k][k].clone()).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::graph::{Assumption, Function, NumberId};

    /// Real symbols x, y, z, positive symbols a, b, and the cosine and the sine of z.
    fn variables(g: &mut Graph) -> Result<[Id; 7], Error> {
        let [x, y, z] = ["x", "y", "z"].map(|name| g.symbol(name, Assumption::Real));
        let [a, b] = ["a", "b"].map(|name| g.symbol(name, Assumption::Positive));
        Ok([x, y, z, a, b, g.apply(Function::Cos, &[z])?, g.apply(Function::Sin, &[z])?])
    }

    /// A sum of numbers times powers of the variables.
    fn sum(g: &mut Graph, terms: &[(i64, [i64; 7])]) -> Result<Id, Error> {
        let variables = variables(g)?;
        let mut sum = Id::ZERO;
        for (number, exponents) in terms {
            let mut product = Id::ONE;
            for (&variable, &exponent) in variables.iter().zip(exponents) {
                let exponent = g.number_id(&Number::integer(exponent));
                let power = g.product(&[(variable, exponent)])?;
                product = g.mul(product, power)?;
            }
            let number = g.number_id(&Number::integer(*number));
            let term = g.scale(number, product);
            sum = g.sum(&[(NumberId::ONE, sum), (NumberId::ONE, term)]);
        }
        Ok(sum)
    }

    type Terms<'a> = &'a [(i64, [i64; 7])];

    /// x^2 - 2 x y + 2 y^2 and the like: `[last, first]` as coefficients that are just large enough, and a bit too small.
    const FORMS: [Terms<'static>; 8] = [
        &[(1, [2, 0, 0, 0, 0, 0, 0]), (-2, [1, 1, 0, 0, 0, 0, 0]), (1, [0, 2, 0, 0, 0, 0, 0])],
        &[(37, [2, 0, 0, 0, 0, 0, 0]), (74, [1, 1, 0, 0, 0, 0, 0]), (41, [0, 2, 0, 0, 0, 0, 0])],
        // The square of a length of two bars, and one with numbers as lengths.
        &[(1, [0, 0, 0, 2, 0, 0, 0]), (2, [0, 0, 0, 1, 1, 1, 0]), (1, [0, 0, 0, 0, 2, 0, 0])],
        &[(-5, [0, 0, 0, 0, 0, 1, 0]), (5, [0; 7])],
        &[(3, [0, 0, 0, 0, 0, 1, 0]), (4, [0, 0, 0, 0, 0, 0, 1]), (5, [0; 7])],
        // From a point (x, y) to the end of a bar a.
        &[
            (1, [2, 0, 0, 0, 0, 0, 0]),
            (1, [0, 2, 0, 0, 0, 0, 0]),
            (-2, [1, 0, 0, 1, 0, 1, 0]),
            (-2, [0, 1, 0, 1, 0, 0, 1]),
            (1, [0, 0, 0, 2, 0, 0, 0]),
        ],
        // (a x)^2 + 2 a x b y cos(z) + (b y)^2
        &[(1, [2, 0, 0, 2, 0, 0, 0]), (2, [1, 1, 0, 1, 1, 1, 0]), (1, [0, 2, 0, 0, 2, 0, 0])],
        // Even powers and positive terms beside a form.
        &[
            (1, [4, 0, 0, 0, 0, 0, 0]),
            (3, [0, 0, 0, 1, 0, 0, 0]),
            (1, [0, 2, 0, 0, 0, 0, 0]),
            (-2, [0, 1, 1, 0, 0, 0, 0]),
            (1, [0, 0, 2, 0, 0, 0, 0]),
        ],
    ];

    #[test]
    fn forms_are_nowhere_negative_unless_a_coefficient_is_smaller() -> Result<(), Error> {
        let g = &mut Graph::new();
        for form in FORMS {
            let node = sum(g, form)?;
            assert!(g.is_semidefinite(node), "{form:?}");
            let mut smaller = form.iter().map(|&(number, powers)| (100 * number, powers)).collect::<Vec<_>>();
            smaller.last_mut().expect("there are terms").0 -= 1;
            let node = sum(g, &smaller)?;
            let is_strict = form[0].0 == 37; // 41 > 37
            assert_eq!(g.is_semidefinite(node), is_strict, "{smaller:?}");
        }
        Ok(())
    }

    /// y^2 - 4 y^2 [x > 0] [a1 > 0] ... is negative for one combination of signs only.
    #[test]
    fn what_is_negative_for_few_signs_is_not_nowhere_negative() -> Result<(), Error> {
        let g = &mut Graph::new();
        let y = g.symbol("y", Assumption::Real);
        let square = g.mul(y, y)?;
        let mut indicator = Id::ONE;
        for k in 0..6 {
            let x = g.symbol(&format!("x{k}"), Assumption::Real);
            let sign = g.apply(Function::Sign, &[x])?;
            let both = g.sum(&[(NumberId::ONE, Id::ONE), (NumberId::ONE, sign)]);
            indicator = g.mul(indicator, both)?;
            let product = g.mul(indicator, square)?;
            let node = g.sum(&[(NumberId::ONE, square), (NumberId::MINUS_ONE, product)]);
            assert!(!g.is_semidefinite(node), "{k}");
        }
        Ok(())
    }
}
