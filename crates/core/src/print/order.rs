//! The reader's order: of factors in a product and of terms in a sum, by names and structure alone.

use std::cmp::Ordering;

use crate::interrupt::tick;
use crate::value::Number;

use super::name;
use super::tree::{Base, Factor, Sum, Term};

/// Where a factor stands in a product: `2*sqrt(3)*pi*m*(a + b)*x*(x + a)*sin(x)*(sin(x) + a)*x'*(x'' + a)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Place {
    Number,
    Pi,
    Parameter,
    ParameterGroup,
    Coordinate,
    CoordinateGroup,
    Function,
    Group,
    Speed,
    Acceleration,
}

impl Base {
    pub(super) fn place(&self) -> Place {
        match self {
            Self::Number(_) => Place::Number,
            Self::Pi => Place::Pi,
            Self::Symbol { .. } => Place::Parameter,
            Self::TimeFunction { order, usage, .. } => match order + u32::from(usage.is_speed) {
                0 => Place::Coordinate,
                1 => Place::Speed,
                _ => Place::Acceleration,
            },
            Self::Time => Place::Coordinate,
            Self::Application { .. } | Self::Function(..) => Place::Function,
            Self::Group(sum) => match sum.place() {
                place if place <= Place::ParameterGroup => Place::ParameterGroup,
                place if place <= Place::CoordinateGroup => Place::CoordinateGroup,
                place => place.max(Place::Group),
            },
        }
    }
}

impl Sum {
    /// The last place among all factors.
    fn place(&self) -> Place {
        self.terms.iter().map(Term::place).max().unwrap_or(Place::Number)
    }
}

impl Term {
    fn place(&self) -> Place {
        self.factors.iter().map(|factor| factor.base.place()).max().unwrap_or(Place::Number)
    }

    /// Whether the term is a parameter, perhaps with a number before it.
    fn is_symbol(&self) -> bool {
        match &self.factors[..] {
            [Factor { base, exponent }] => base.place() == Place::Parameter && exponent.is_one(),
            _ => false,
        }
    }

    /// Whether the term is a parameter times a square over a square, as a moment of inertia behind a gear.
    fn is_transmitted(&self) -> bool {
        let is_square = |factor: &Factor, sign: i64| factor.exponent.to_i64() == Some(sign * 2);
        let has_square = |sign| self.factors.iter().any(|factor| is_square(factor, sign));
        has_square(1) && has_square(-1)
    }

    /// Whether the term is a parameter that differences of the model subtract.
    pub(super) fn is_subtracted(&self) -> bool {
        matches!(&self.factors[..], [Factor { base: Base::Symbol { is_subtracted: true, .. }, .. }])
    }

    /// The factors as written: roots among the functions, `m*l**2` and `(m1 + m2)*l**2` rather than `l**2*m` and
    /// `l**2*(m1 + m2)`.
    pub(super) fn written_factors(&self) -> Vec<&Factor> {
        let mut factors: Vec<&Factor> = self.factors.iter().collect();
        factors.sort_by(|a, b| {
            let place = written_place(a).cmp(&written_place(b));
            place.then_with(|| match written_place(a) {
                Place::Parameter | Place::Coordinate | Place::Speed | Place::Acceleration => {
                    a.exponent.abs().compare(&b.exponent.abs())
                }
                _ => Ordering::Equal,
            })
        });
        factors
    }
}

fn written_place(factor: &Factor) -> Place {
    let place = match &factor.base {
        Base::Group(sum) if sum.terms.iter().all(Term::is_symbol) => Place::Parameter,
        base => base.place(),
    };
    if place > Place::Number && !factor.exponent.is_integer() { Place::Function.max(place) } else { place }
}

/// The first criterion of order in a sum such as `m*x'' + c*x' + k*x + F`: accelerations, then speeds, then
/// powers of coordinates, then the degree, and terms with functions after those without. A moment of inertia stands
/// before masses times squares of lengths: `I + m*l**2`. Of equations, displacements and
/// products of speeds are in the order of the coordinates: `z - a*theta - z1`.
#[derive(Clone, Copy, Debug, Default)]
struct Rank {
    derivative: u32,
    coordinates: f64,
    is_moment: bool,
    motion: Motion,
    degree: f64,
    has_function: bool,
}

/// The places of the functions of time of equations that a term is a multiple of: of its speeds, the first two; or of its
/// coordinate, if parameters alone multiply this. Others are behind all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Motion([usize; 2]);

impl Default for Motion {
    fn default() -> Self {
        Self([usize::MAX; 2])
    }
}

impl Motion {
    fn of_term(term: &Term) -> Self {
        let known = |factor: &Factor, is_rate: bool| match factor.base {
            Base::TimeFunction { order, usage, .. } if (order > 0 || usage.is_speed) == is_rate => factor
                .exponent
                .to_i64()
                .filter(|&e| e > 0 && usage.index < usize::MAX)
                .map(|e| (usage.index, e)),
            _ => None,
        };
        let rates = term.factors.iter().filter_map(|factor| known(factor, true));
        let mut places: Vec<usize> =
            rates.flat_map(|(index, e)| std::iter::repeat_n(index, if e > 1 { 2 } else { 1 })).collect();
        if places.is_empty() && term.factors.iter().any(|factor| known(factor, false).is_some()) {
            let (moving, others): (Vec<&Factor>, Vec<&Factor>) =
                term.factors.iter().partition(|factor| known(factor, false).is_some_and(|(_, e)| e == 1));
            if let [factor] = moving[..]
                && others.iter().all(|factor| factor.base.place() <= Place::ParameterGroup)
            {
                places.extend(known(factor, false).map(|(index, _)| index));
            }
        }
        places.sort_unstable();
        let at = |position: usize| places.get(position).copied().unwrap_or(usize::MAX);
        Self([at(0), at(1)])
    }
}

/// The degree of t in the coordinates: what is given stands behind them, as in `q - omega*t`.
const TIME: f64 = 0.5;

/// The degree of a mass times the square of a length.
const MOMENT: f64 = 3.0;
/// The degree in coordinates of the square of a length.
const SQUARE: f64 = 2.0;

impl Rank {
    fn compare(&self, other: &Self) -> Ordering {
        let by_derivative = other.derivative.cmp(&self.derivative);
        let is_linear = |rank: &Self| rank.motion.0[1] == usize::MAX;
        let by_rates = match self.derivative {
            0 => Ordering::Equal,
            _ => is_linear(self).cmp(&is_linear(other)).then(self.motion.cmp(&other.motion)),
        };
        by_derivative
            .then(other.is_moment.cmp(&self.is_moment))
            .then(by_rates)
            .then(other.coordinates.total_cmp(&self.coordinates))
            .then(self.motion.cmp(&other.motion))
            .then(other.degree.total_cmp(&self.degree))
            .then(self.has_function.cmp(&other.has_function))
    }

    fn of_term(term: &Term) -> Self {
        let start = Self { motion: Motion::of_term(term), ..Self::default() };
        term.factors.iter().fold(start, |rank, factor| {
            let base = Self::of_base(&factor.base);
            let exponent = factor.exponent.to_f64();
            Self {
                derivative: rank.derivative.max(base.derivative),
                coordinates: rank.coordinates + exponent * base.coordinates,
                is_moment: false,
                motion: rank.motion,
                degree: rank.degree + exponent * base.degree,
                has_function: rank.has_function || base.has_function,
            }
        })
    }

    fn of_base(base: &Base) -> Self {
        let none = Self::default();
        match base {
            Base::Number(_) | Base::Pi => none,
            Base::Symbol { .. } => Self { degree: 1.0, ..none },
            Base::Time => Self { degree: 1.0, coordinates: TIME, ..none },
            Base::TimeFunction { order, usage, .. } => {
                Self { derivative: order + u32::from(usage.is_speed), coordinates: 1.0, degree: 1.0, ..none }
            }
            Base::Application { .. } => Self { degree: 1.0, has_function: true, ..none },
            Base::Function(..) => Self { has_function: true, ..none },
            Base::Group(sum) => sum.terms.iter().map(Self::of_term).fold(none, |a, b| Self {
                derivative: a.derivative.max(b.derivative),
                coordinates: a.coordinates.max(b.coordinates),
                is_moment: false,
                motion: none.motion,
                degree: a.degree.max(b.degree),
                has_function: a.has_function || b.has_function,
            }),
        }
    }
}

/// The reader's order of two terms, apart from moments of inertia.
pub(super) fn compare_terms(a: &Term, b: &Term) -> Ordering {
    Rank::of_term(a).compare(&Rank::of_term(b)).then_with(|| compare_factors(&a.factors, &b.factors))
}

/// Whether neither of two terms stands first for the speeds or coordinates that it holds.
pub(super) fn are_of_one_kind(a: &Term, b: &Term) -> bool {
    let (a, b) = (Rank::of_term(a), Rank::of_term(b));
    a.derivative == b.derivative && a.coordinates.total_cmp(&b.coordinates).is_eq()
}

/// Whether a term is a multiple of a coordinate or speed of equations, by parameters alone.
pub(super) fn is_displacement(term: &Term) -> bool {
    let rank = Rank::of_term(term);
    let is_one = rank.motion.0[0] < usize::MAX && rank.motion.0[1] == usize::MAX;
    is_one && !rank.has_function && rank.coordinates.total_cmp(&1.0).is_eq()
}

/// Whether two terms differ in the coordinates that they hold, or one has a function, and none has a speed.
pub(super) fn are_of_different_kinds(a: &Term, b: &Term) -> bool {
    let (a, b) = (Rank::of_term(a), Rank::of_term(b));
    let is_alike = a.coordinates.total_cmp(&b.coordinates).is_eq() && a.has_function == b.has_function;
    !is_alike && a.derivative == b.derivative
}

/// Terms in the reader's order; like terms are neighbours.
pub(super) fn sorted_terms(terms: Vec<Term>) -> Vec<Term> {
    let rank = |term: Term| {
        tick();
        (Rank::of_term(&term), term)
    };
    let mut ranked: Vec<(Rank, Term)> = terms.into_iter().map(rank).collect();
    let is_constant = ranked.iter().all(|(rank, _)| rank.coordinates == 0.0);
    let is_mass_by_square = |(rank, term): &&(Rank, Term)| {
        let is_moment = rank.coordinates <= SQUARE && rank.degree >= MOMENT;
        term.factors.len() > 1 && (is_moment || is_constant && term.is_transmitted())
    };
    let has_rates = ranked.iter().any(|(rank, _)| rank.derivative > 0);
    let products = ranked
        .iter()
        .filter(|each| !has_rates && is_mass_by_square(each))
        .flat_map(|(_, term)| &term.factors);
    let bases: Vec<Base> = products.map(|factor| factor.base.clone()).collect();
    if !bases.is_empty() {
        for (rank, term) in &mut ranked {
            rank.is_moment = term.is_symbol() && !bases.contains(&term.factors[0].base);
        }
    }
    ranked.sort_by(|(rank_a, a), (rank_b, b)| {
        tick();
        rank_a.compare(rank_b).then_with(|| compare_factors(&a.factors, &b.factors))
    });
    ranked.into_iter().map(|(_, term)| term).collect()
}

/// Factor by factor, as in a dictionary; of one base the higher power first: a**2, a*b, b**2.
pub(super) fn compare_factors(a: &[Factor], b: &[Factor]) -> Ordering {
    for (x, y) in a.iter().zip(b) {
        let order = compare_bases(&x.base, &y.base).then_with(|| compare_numbers(&y.exponent, &x.exponent));
        if order.is_ne() {
            return order;
        }
    }
    a.len().cmp(&b.len())
}

fn compare_sums(a: &Sum, b: &Sum) -> Ordering {
    for (x, y) in a.terms.iter().zip(&b.terms) {
        let order = compare_factors(&x.factors, &y.factors)
            .then_with(|| compare_numbers(&x.coefficient, &y.coefficient));
        if order.is_ne() {
            return order;
        }
    }
    a.terms.len().cmp(&b.terms.len())
}

/// Arguments whose order doesn't matter, numbers first.
pub(super) fn sort_sums(sums: &mut [Sum]) {
    sums.sort_by(compare_sums);
}

fn compare_args(a: &[Sum], b: &[Sum]) -> Ordering {
    for (x, y) in a.iter().zip(b) {
        let order = compare_sums(x, y);
        if order.is_ne() {
            return order;
        }
    }
    a.len().cmp(&b.len())
}

/// Bases by place, then by name or argument: `sin(a)*cos(b)` and `cos(a)*sin(b)`.
pub(super) fn compare_bases(a: &Base, b: &Base) -> Ordering {
    let place = a.place().cmp(&b.place());
    place.then_with(|| match (a, b) {
        (Base::Number(x), Base::Number(y)) => compare_numbers(x, y),
        (Base::Symbol { name: x, assumption: p, .. }, Base::Symbol { name: y, assumption: q, .. }) => {
            name::compare(x, y).then((*p as u8).cmp(&(*q as u8)))
        }
        (
            Base::TimeFunction { name: x, order: m, usage: p, mark: k, .. },
            Base::TimeFunction { name: y, order: n, usage: q, mark: l, .. },
        ) => {
            let place = p.index.cmp(&q.index).then_with(|| name::compare(x, y));
            place.then(m.cmp(n)).then_with(|| k.cmp(l))
        }
        (Base::Function(f, x), Base::Function(g, y)) => compare_args(x, y).then(f.cmp(g)),
        (
            Base::Application { name: f, args: x, orders: m },
            Base::Application { name: g, args: y, orders: n },
        ) => name::compare(f, g).then_with(|| compare_args(x, y)).then_with(|| m.cmp(n)),
        (Base::Group(x), Base::Group(y)) => compare_sums(x, y),
        _ => variant(a).cmp(&variant(b)),
    })
}

/// The order of different kinds at one place: t before the coordinates, undefined functions before sines.
fn variant(base: &Base) -> u8 {
    match base {
        Base::Time | Base::Application { .. } => 0,
        _ => 1,
    }
}

/// Whether a number is written with a fraction bar.
pub(super) fn is_fraction(number: &Number) -> bool {
    !number.is_integer() && !number.is_decimal()
}

/// Numbers in order of size; of two equal ones the exact one first.
fn compare_numbers(a: &Number, b: &Number) -> Ordering {
    a.compare(b).then(a.is_decimal().cmp(&b.is_decimal()))
}
