//! A node as a polynomial in the symbols and functions that its sums and products are made of, by value.
//!
//! Its values are found in the first field of a lane, where any of these variables may be moved from the random point.

use rustc_hash::FxHashMap;

use crate::graph::{Function, Graph, Id, View, children_first};
use crate::interrupt::tick;
use crate::value::{Field, FieldId, Key, Number, Quadratic};

use super::sign_degree::points_for;

/// Larger polynomials are not opened.
const MOST_NODES: usize = 512;
const MOST_VARIABLES: usize = 48;

/// The largest number of variables of a quadratic form.
const LARGEST_FORM: usize = 12;

/// With more independent signs, what is negative for only one combination of them would need too many lanes.
const MOST_SIGNS: usize = 3;

/// A node as a polynomial: the sums and products above the variables, children first, and the variables.
///
/// `points` is the number of points in each lane that show a negative value.
pub(super) struct Polynomial {
    pub(super) points: u16,
    order: Vec<Id>,
    pub(super) variables: Vec<Id>,
    places: FxHashMap<Id, usize>,
}

/// The polynomial in the first field of a lane, and the values of the variables there.
pub(super) struct InLane {
    pub(super) f: &'static Field,
    steps: Vec<Step>,
    point: Vec<Quadratic>,
}

/// How one value is found from those before it.
enum Step {
    Known(Quadratic),
    Variable(usize),
    Sum(Vec<(Quadratic, usize)>),
    /// A known factor, and powers.
    Product(Quadratic, Vec<(usize, Number)>),
}

impl Graph {
    pub(super) fn polynomial(&self, id: Id) -> Option<Polynomial> {
        let order = children_first(&[id], |id, out| self.push_parts_of_polynomial(id, out), |_| true);
        let signs = self.signs(id).all?.len();
        if order.len() > MOST_NODES || signs > MOST_SIGNS {
            return None;
        }
        let points = points_for(signs + 1)?; // one more is the sign of a pivot
        let is_leaf = |id: Id| self.is_variable(id);
        let mut variables: Vec<Id> =
            order.iter().filter(|&&id| self.is_unknown(id)).map(|&id| self.representative(id)).collect();
        variables.sort_by_key(|&id| (!is_leaf(id), self.value(id)));
        variables.dedup();
        let places = order.iter().enumerate().map(|(place, &id)| (id, place)).collect();
        (variables.len() <= MOST_VARIABLES).then_some(Polynomial { points, order, variables, places })
    }

    fn push_parts_of_polynomial(&self, id: Id, out: &mut Vec<Id>) {
        match self.view(id) {
            View::Sum(_) | View::Scale(..) => self.push_children(id, out),
            View::Product(factors) => {
                let whole = factors.iter().filter(|&(_, exponent)| self.get_number(exponent).is_integer());
                out.extend(whole.map(|(base, _)| base));
            }
            _ => {}
        }
    }

    /// Whether a node is a variable of polynomials.
    fn is_unknown(&self, id: Id) -> bool {
        !matches!(
            self.view(id),
            View::Number(_) | View::Pi | View::Sum(_) | View::Scale(..) | View::Product(_)
        )
    }

    /// The cosines and sines among the variables, by their angles.
    pub(super) fn angles(&self, polynomial: &Polynomial) -> Vec<[Option<usize>; 2]> {
        let mut angles: Vec<(Id, [Option<usize>; 2])> = Vec::new();
        for (variable, &id) in polynomial.variables.iter().enumerate() {
            let View::Function(function @ (Function::Cos | Function::Sin), args) = self.view(id) else {
                continue;
            };
            let argument = self.representative(args.get(0));
            let known = angles.iter().position(|(angle, _)| *angle == argument).unwrap_or_else(|| {
                angles.push((argument, [None; 2]));
                angles.len() - 1
            });
            angles[known].1[usize::from(function == Function::Sin)] = Some(variable);
        }
        angles.into_iter().map(|(_, pair)| pair).collect()
    }

    pub(super) fn in_lane(&self, polynomial: &Polynomial, field: FieldId) -> InLane {
        let f = field.field();
        let place = |id: Id| polynomial.places[&id];
        let step = |&id: &Id| match self.view(id) {
            View::Sum(terms) => {
                let terms = terms.iter();
                Step::Sum(terms.map(|(factor, id)| (f.number(self.get_number(factor)), place(id))).collect())
            }
            View::Scale(factor, id) => Step::Sum(vec![(f.number(self.get_number(factor)), place(id))]),
            View::Product(factors) => {
                let powers = factors.iter().map(|(base, exponent)| (base, self.get_number(exponent).clone()));
                let (whole, roots): (Vec<_>, Vec<_>) =
                    powers.partition(|(_, exponent)| exponent.is_integer());
                let powers = whole.into_iter().map(|(base, exponent)| (place(base), exponent)).collect();
                Step::Product(self.product_in(roots.into_iter(), field), powers)
            }
            _ if self.is_unknown(id) => {
                let id = self.representative(id);
                let variable = polynomial.variables.iter().position(|&known| known == id);
                variable.map_or_else(|| Step::Known(self.value_in(id, field)), Step::Variable)
            }
            _ => Step::Known(self.value_in(id, field)),
        };
        let steps = polynomial.order.iter().map(step).collect();
        let point = polynomial.variables.iter().map(|&id| self.value_in(id, field)).collect();
        InLane { f, steps, point }
    }

    /// The variables that are in no other variables and in no roots: x is in sin(x).
    pub(super) fn free_variables(&self, polynomial: &Polynomial) -> Vec<usize> {
        let functions = polynomial.variables.iter().copied().filter(|&id| !self.is_variable(id));
        let roots = polynomial.order.iter().flat_map(|&id| match self.view(id) {
            View::Product(factors) => {
                let roots = factors.iter().filter(|&(_, exponent)| !self.get_number(exponent).is_integer());
                roots.map(|(base, _)| base).collect()
            }
            _ => Vec::new(),
        });
        let fixed = self.variables(&functions.chain(roots).collect::<Vec<_>>());
        (0..polynomial.variables.len())
            .filter(|&place| !fixed.contains(&polynomial.variables[place]))
            .collect()
    }
}

impl InLane {
    /// The value at a point; `None` at a pole.
    pub(super) fn at(&self, point: &[Quadratic]) -> Option<Quadratic> {
        let f = self.f;
        let mut values: Vec<Quadratic> = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            tick();
            values.push(match step {
                Step::Known(value) => value.clone(),
                Step::Variable(variable) => point[*variable].clone(),
                Step::Sum(terms) => terms.iter().fold(self.integer(0), |sum, (factor, place)| {
                    f.add(&sum, &f.mul(factor, &values[*place]))
                }),
                Step::Product(known, powers) => {
                    powers.iter().try_fold(known.clone(), |product, (place, exponent)| {
                        let base = &values[*place];
                        let is_pole = base.is_zero() && exponent.is_negative();
                        (!is_pole).then(|| f.mul(&product, &f.power(base, exponent)))
                    })?
                }
            });
        }
        values.pop()
    }

    /// Variables in which the polynomial has degree 2, each by itself and together.
    pub(super) fn quadratic_variables(&self, variables: &[usize], zero: &[usize]) -> Vec<usize> {
        let base = self.with_zeros(zero);
        let mut chosen: Vec<usize> = Vec::new();
        for &variable in variables.iter().filter(|variable| !zero.contains(variable)) {
            let together: Vec<usize> = chosen.iter().copied().chain([variable]).collect();
            let has_square =
                self.differences(&base, &[variable]).is_some_and(|[second, _]| !second.is_zero());
            let is_quadratic = |variables: &[usize]| {
                self.differences(&base, variables).is_some_and(|[_, third]| third.is_zero())
            };
            if chosen.len() < LARGEST_FORM
                && has_square
                && is_quadratic(&[variable])
                && is_quadratic(&together)
            {
                chosen = together;
            }
        }
        chosen
    }

    /// The second and third differences in a random direction.
    fn differences(&self, base: &[Quadratic], variables: &[usize]) -> Option<[Quadratic; 2]> {
        let f = self.f;
        let direction = |variable: usize| f.draw(&Key::new("direction").word(variable as u64));
        let at = |n: i64| {
            let moves = variables.iter().map(|&variable| {
                let step = f.mul(&self.integer(n), &direction(variable));
                (variable, f.add(&base[variable], &step))
            });
            self.at(&with(base, moves))
        };
        let values = [at(0)?, at(1)?, at(2)?, at(3)?];
        let change = |values: &[Quadratic]| -> Vec<Quadratic> {
            values.windows(2).map(|pair| f.sub(&pair[1], &pair[0])).collect()
        };
        let second = change(&change(&values));
        let third = f.sub(&second[1], &second[0]);
        Some([second[0].clone(), third])
    }

    pub(super) fn with_zeros(&self, zero: &[usize]) -> Vec<Quadratic> {
        with(&self.point, zero.iter().map(|&variable| (variable, self.integer(0))))
    }

    pub(super) fn integer(&self, n: i64) -> Quadratic {
        self.f.number(&Number::integer(n))
    }
}

/// A point with other values of some variables.
pub(super) fn with(
    point: &[Quadratic],
    moves: impl IntoIterator<Item = (usize, Quadratic)>,
) -> Vec<Quadratic> {
    let mut point = point.to_vec();
    for (variable, value) in moves {
        point[variable] = value;
    }
    point
}
