//! The coordinates of the random points, and the memory of values in them.

use num_bigint::BigInt;
use rustc_hash::FxHashMap;
use std::sync::Arc;

use crate::value::{Element, FieldId, Key, Number, Quadratic, fingerprint};

use super::node::{Assumption, Id, NumberId, View};
use super::real_range::RealRange;

/// Values of nodes in the fields of all lanes, as far as they were asked for.
///
/// Everything here can be found again from the graph, so it is forgotten when it becomes large.
#[derive(Default)]
pub(crate) struct Lanes {
    /// How deep comparisons of parts are nested at the moment.
    pub(crate) depth: usize,
    /// The pairs of nodes whose parts the present comparison has compared.
    pub(crate) compared: FxHashMap<(Id, Id), bool>,
    values: FxHashMap<(Id, FieldId), Quadratic>,
    /// The values in the first fields of all lanes but the hash lanes, which are found together, by point.
    columns: FxHashMap<(Id, u16), Column>,
    /// Roots by their degrees.
    roots: FxHashMap<(Id, i64, FieldId), Quadratic>,
    /// The columns of coefficients.
    numbers: FxHashMap<NumberId, Column>,
    /// The solutions of linear systems.
    solutions: FxHashMap<(Id, FieldId), Arc<[Quadratic]>>,
    /// The signs that nodes depend on.
    signs: FxHashMap<Id, Signs>,
    /// What the signs are in the lanes.
    coins: FxHashMap<u64, Coin>,
    /// The numeric contents, of primes from the least one up.
    contents: FxHashMap<(Combination, u64), Option<Content>>,
    /// The numbers in exponents, such as the 1 in x + 1; in a lane those where signs are the ones of this lane.
    exponents: FxHashMap<(Id, Option<FieldId>), Number>,
    /// Nodes that are a number times powers of positive factors.
    monomials: FxHashMap<Id, Option<Monomial>>,
    /// Those where signs are the ones of a lane.
    monomials_by_signs: FxHashMap<(Id, FieldId), Option<Monomial>>,
    /// How arguments of sines (false) and exponentials (true) are split, see `evaluate::argument`.
    splits: FxHashMap<(Id, bool, Option<FieldId>), Split>,
    /// Whether nodes hold signs and no roots.
    signs_alone: FxHashMap<Id, bool>,
    /// Whether the values of nodes that hold complex symbols depend on these.
    complex: FxHashMap<Id, bool>,
    /// What forms tell of the values of nodes for real variables.
    real_ranges: FxHashMap<Id, RealRange>,
    /// Whether values tell that nodes are nowhere negative.
    semidefinite: FxHashMap<Id, bool>,
}

/// The values of a node in all lanes but the hash lanes.
pub(crate) type Column = Arc<[Quadratic]>;

/// A product of prime numbers with rational exponents, not 0.
pub(crate) type Content = Arc<[(BigInt, Number)]>;

/// What has a content: a node, a difference, or a sum or difference of squares, whether or not it is a node.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Combination {
    first: Id,
    /// The second node and its sign.
    second: Option<(Id, i8)>,
    are_squares: bool,
}

impl Combination {
    pub(crate) fn node(id: Id) -> Self {
        Self { first: id, second: None, are_squares: false }
    }

    pub(crate) fn difference(a: Id, b: Id) -> Self {
        Self { first: a, second: Some((b, -1)), are_squares: false }
    }

    /// a^2 + b^2, or a^2 - b^2 for the sign -1.
    pub(crate) fn squares([a, b]: [Id; 2], sign: i8) -> Self {
        Self { first: a, second: Some((b, sign)), are_squares: true }
    }

    pub(crate) fn nodes(self) -> impl DoubleEndedIterator<Item = Id> {
        [Some(self.first), self.second.map(|(id, _)| id)].into_iter().flatten()
    }

    pub(crate) fn is_node(self) -> bool {
        self.second.is_none()
    }

    /// The value from those of the nodes.
    pub(crate) fn value<T>(
        self,
        value: impl Fn(Id) -> Option<T>,
        square: impl Fn(T) -> T,
        add: impl Fn(T, i64, T) -> T,
    ) -> Option<T> {
        let part = |id: Id| value(id).map(|value| if self.are_squares { square(value) } else { value });
        let first = part(self.first)?;
        match self.second {
            Some((second, sign)) => Some(add(first, sign.into(), part(second)?)),
            None => Some(first),
        }
    }
}

/// A part of an argument that has a known angle or exponential.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Atom {
    Pi,
    /// The arcsine of a node; an arccosine is pi/2 less an arcsine.
    Asin(Id),
    Atan(Id),
    /// `atan2(y, x)`
    Atan2(Id, Id),
    /// The logarithm of a node that is no product of positive powers.
    Log(Id),
    LogOfPrime(BigInt),
    LogOfPi,
}

/// The signs and roots below a node: `None` if they are many.
///
/// The degree is that of the node as a polynomial in signs, which are 1 or -1; see `evaluate::sign_degree`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Signs {
    pub(crate) all: Option<Arc<[u64]>>,
    pub(crate) degree: usize,
}

/// What a sign is in the lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Coin {
    /// A bit for each lane but the hash lanes.
    Vector(u64),
    /// Something else that has a key, which is equal for equal signs.
    Other(u64),
}

/// Atoms of an argument with their factors.
pub(crate) type Split = Arc<[(Atom, Number)]>;

impl Atom {
    /// The nodes that an inverse function or a logarithm is applied to.
    pub(crate) fn arguments(&self) -> Vec<Id> {
        match *self {
            Self::Asin(x) | Self::Atan(x) | Self::Log(x) => vec![x],
            Self::Atan2(y, x) => vec![y, x],
            _ => Vec::new(),
        }
    }
}

/// A positive factor that an expression may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Generator {
    /// A positive symbol or pi.
    Symbol(Id),
    /// The exponential of a node.
    Exponential(Id),
    Power {
        base: Id,
        exponent: Id,
    },
}

/// A power of a positive number times powers of generators.
#[derive(Clone, Debug)]
pub(crate) struct Monomial {
    pub(crate) number: Number,
    pub(crate) root: Number,
    pub(crate) powers: Vec<(Generator, Number)>,
}

/// About 200 MB of each.
const MOST_VALUES: usize = 3_000_000;
const MOST_COLUMNS: usize = 120_000;

impl Lanes {
    pub(crate) fn get(&self, id: Id, field: FieldId) -> Option<&Quadratic> {
        self.values.get(&(id, field))
    }

    pub(crate) fn insert(&mut self, id: Id, field: FieldId, value: Quadratic) {
        self.values.insert((id, field), value);
    }

    /// Forget all values if there are too many. Nothing may be under evaluation.
    pub(crate) fn limit(&mut self) {
        if self.values.len() > MOST_VALUES || self.columns.len() > MOST_COLUMNS {
            self.values.clear();
            self.columns.clear();
            self.roots.clear();
            self.solutions.clear();
            self.splits.retain(|(_, _, lane), _| lane.is_none());
            self.exponents.retain(|(_, lane), _| lane.is_none());
            self.monomials_by_signs.clear();
        }
    }

    pub(crate) fn root(&self, id: Id, degree: i64, field: FieldId) -> Option<&Quadratic> {
        self.roots.get(&(id, degree, field))
    }

    pub(crate) fn insert_root(&mut self, id: Id, degree: i64, field: FieldId, value: Quadratic) {
        self.roots.insert((id, degree, field), value);
    }

    pub(crate) fn column(&self, id: Id, point: u16) -> Option<&Column> {
        self.columns.get(&(id, point))
    }

    pub(crate) fn insert_column(&mut self, id: Id, point: u16, values: Column) {
        self.columns.insert((id, point), values);
    }

    /// The images of a coefficient.
    pub(crate) fn images(&mut self, id: NumberId, number: &Number) -> Column {
        let images = || FieldId::others(0).map(|field| field.field().number(number)).collect();
        Arc::clone(self.numbers.entry(id).or_insert_with(images))
    }

    pub(crate) fn solution(&self, id: Id, field: FieldId) -> Option<Arc<[Quadratic]>> {
        self.solutions.get(&(id, field)).cloned()
    }

    pub(crate) fn insert_solution(&mut self, id: Id, field: FieldId, values: Arc<[Quadratic]>) {
        self.solutions.insert((id, field), values);
    }

    pub(crate) fn signs(&self, id: Id) -> Option<&Signs> {
        self.signs.get(&id)
    }

    pub(crate) fn insert_signs(&mut self, id: Id, signs: Signs) {
        self.signs.insert(id, signs);
    }

    pub(crate) fn coin(&self, sign: u64) -> Option<Coin> {
        self.coins.get(&sign).copied()
    }

    pub(crate) fn insert_coin(&mut self, sign: u64, coin: Coin) {
        self.coins.insert(sign, coin);
    }

    pub(crate) fn content(&self, of: Combination, least: u64) -> Option<&Option<Content>> {
        self.contents.get(&(of, least))
    }

    pub(crate) fn insert_content(&mut self, of: Combination, least: u64, content: Option<Content>) {
        self.contents.insert((of, least), content);
    }

    pub(crate) fn exponent(&self, id: Id, lane: Option<FieldId>) -> Option<&Number> {
        self.exponents.get(&(id, lane))
    }

    pub(crate) fn insert_exponent(&mut self, id: Id, lane: Option<FieldId>, number: Number) {
        self.exponents.insert((id, lane), number);
    }

    pub(crate) fn monomial(&self, id: Id) -> Option<&Option<Monomial>> {
        self.monomials.get(&id)
    }

    pub(crate) fn insert_monomial(&mut self, id: Id, monomial: Option<Monomial>) {
        self.monomials.insert(id, monomial);
    }

    pub(crate) fn monomial_in(&self, id: Id, lane: FieldId) -> Option<&Option<Monomial>> {
        self.monomials_by_signs.get(&(id, lane))
    }

    pub(crate) fn insert_monomial_in(&mut self, id: Id, lane: FieldId, monomial: Option<Monomial>) {
        self.monomials_by_signs.insert((id, lane), monomial);
    }

    pub(crate) fn complex(&self, id: Id) -> Option<bool> {
        self.complex.get(&id).copied()
    }

    pub(crate) fn insert_complex(&mut self, id: Id, is_complex: bool) {
        self.complex.insert(id, is_complex);
    }

    pub(crate) fn real_range(&self, id: Id) -> Option<RealRange> {
        self.real_ranges.get(&id).copied()
    }

    pub(crate) fn insert_real_range(&mut self, id: Id, range: RealRange) {
        self.real_ranges.insert(id, range);
    }

    pub(crate) fn is_semidefinite(&self, id: Id) -> Option<bool> {
        self.semidefinite.get(&id).copied()
    }

    pub(crate) fn insert_semidefinite(&mut self, id: Id, is_semidefinite: bool) {
        self.semidefinite.insert(id, is_semidefinite);
    }

    pub(crate) fn split(&self, id: Id, of_exponential: bool, lane: Option<FieldId>) -> Option<Split> {
        self.splits.get(&(id, of_exponential, lane)).cloned()
    }

    pub(crate) fn insert_split(&mut self, id: Id, of_exponential: bool, lane: Option<FieldId>, parts: Split) {
        self.splits.insert((id, of_exponential, lane), parts);
    }

    pub(crate) fn has_signs_alone(&self, id: Id) -> Option<bool> {
        self.signs_alone.get(&id).copied()
    }

    pub(crate) fn insert_has_signs_alone(&mut self, id: Id, are_alone: bool) {
        self.signs_alone.insert(id, are_alone);
    }
}

/// The value of a number or variable in a field; `None` for a node that has children.
pub(crate) fn leaf_in(view: View<'_>, number: impl Fn() -> Number, field: FieldId) -> Option<Quadratic> {
    Some(match view {
        View::Number(_) => field.field().number(&number()),
        View::Pi => draw_pi(field),
        View::Time => draw_time(field),
        View::Symbol(name, assumption) => draw_symbol(field, name, assumption),
        View::TimeFunction(name, order, assumption) => draw_time_function(field, name, order, assumption),
        _ => return None,
    })
}

/// The fingerprint of what is drawn in both hash lanes.
pub(crate) fn drawn(draw: impl Fn(FieldId) -> Quadratic) -> Element {
    let [first, second] = FieldId::HASH.map(draw);
    fingerprint([&first, &second])
}

pub(super) fn draw_pi(field: FieldId) -> Quadratic {
    field.draw_positive(&Key::new("pi"))
}

pub(super) fn draw_time(field: FieldId) -> Quadratic {
    field.draw(&Key::new("time"))
}

/// A positive symbol is the exponential of a logarithm that is drawn.
pub(super) fn draw_symbol(field: FieldId, name: &str, assumption: Assumption) -> Quadratic {
    let key = Key::new("symbol").text(name).word(assumption as u64);
    match (assumption, field.of_exponents()) {
        (Assumption::Positive, Some(exponents)) => {
            field.field().exponential(exponents.exponent_of(|exponents| draw_logarithm(exponents, name)))
        }
        (Assumption::Positive, None) => field.draw_positive(&key),
        (Assumption::None, _) => field.draw_complex(&key),
        (Assumption::Real | Assumption::Small, _) => field.draw(&key),
    }
}

/// The value of the logarithm of a positive symbol.
pub(crate) fn draw_logarithm(field: FieldId, name: &str) -> Quadratic {
    field.draw(&Key::new("logarithm").text(name))
}

pub(super) fn draw_time_function(
    field: FieldId,
    name: &str,
    order: u32,
    assumption: Assumption,
) -> Quadratic {
    let kind = if assumption == Assumption::Small { "small time function" } else { "time function" };
    field.draw(&Key::new(kind).text(name).word(order.into()))
}
