//! Exact values at a point of integers where all exponentials are one: additive functions of an expression's value.
//!
//! Variables are small integers there, positive symbols, pi and exponentials are 1, sines are 0, and logarithms and
//! inverse functions are 0. The addition theorems and the laws of roots and signs hold as in any lane, so expressions that are
//! equal by value are equal at this point. Therefore what is read off here does not depend on the form: by how much an
//! argument grows with pi, or the 1 in the exponent of x**(y + 1).

use rustc_hash::FxHashMap;

use crate::graph::{Atom, Combination, Generator, Graph, Id, View};
use crate::value::{Element, Field, FieldId, Key, Number, Quadratic, fingerprint, likely_number};

use super::conjugates::{Conjugation, mean_of_conjugates, norm_of_conjugates, rational};

/// Larger expressions have no value here.
const MOST_NODES: usize = 4096;

/// At points from this one on, sines, exponentials and their like are integers as variables are: at the others sines
/// are zero, and so is what they are factors of.
const DRAWN: u64 = 3;

/// The lanes from whose values a number of many digits is found.
const LANES_FOR_LONG_NUMBERS: usize = 16;

/// Values of nodes in all conjugates are not found if they are more.
const MOST_CONJUGATE_VALUES: usize = 4096;

/// Numbers of more bits may make values of more digits than two lanes hold.
const LONG: u64 = 40;

/// The steps over which the growth with an atom is measured, in this order until nothing has a pole at their ends.
const STEPS: [i64; 3] = [1, 5, 7];

/// The largest power of two that is recognised.
const MOST_DOUBLINGS: i64 = 20_000;

/// The n of the powers 2^n by which generators are larger than at the plain point.
pub(super) type Doublings = FxHashMap<Generator, i64>;

/// Values at the plain point, and by how much generators are larger than there.
#[derive(Clone, Copy)]
pub(super) struct Grown<'a> {
    plain: &'a Values,
    doublings: &'a Doublings,
}

/// What differs from the point of the module's description.
#[derive(Clone, Copy)]
pub(super) struct IntegerPoint<'a> {
    pub(super) grown: Option<Grown<'a>>,
    /// What has another value, and that value.
    pub atom: Option<(&'a Atom, i64)>,
    /// Which of several points.
    pub number: u64,
    /// The lane whose signs are those here, if they are not those of the values at the point.
    pub(super) signs: Option<FieldId>,
    /// Whether poles are zero, so that other terms of a sum have their values.
    pub(super) poles_are_zero: bool,
    /// What roots are multiplied by.
    pub(super) conjugation: Option<&'a Conjugation<'a>>,
}

impl<'a> IntegerPoint<'a> {
    pub(super) const PLAIN: Self = Self::numbered(0);

    pub(super) const fn numbered(number: u64) -> Self {
        Self { grown: None, atom: None, number, signs: None, poles_are_zero: false, conjugation: None }
    }

    /// The plain point with the signs of a lane.
    pub(super) fn with_signs_of(field: FieldId) -> Self {
        Self { signs: Some(field.of_signs()), ..Self::PLAIN }
    }

    fn with_poles_zero(self) -> Self {
        Self { poles_are_zero: true, ..self }
    }

    pub(super) fn is_first(&self) -> bool {
        self.number == 0
    }

    /// Whether functions are drawn here, as variables are.
    pub(super) fn draws_functions(&self) -> bool {
        self.number >= DRAWN
    }

    /// The lane whose signs are those here; where functions are drawn, their values have no relations that make signs.
    pub(super) fn lane(&self) -> Option<FieldId> {
        let of_drawn = || FieldId::other(u16::from(self.number != DRAWN));
        self.signs.or_else(|| self.draws_functions().then(of_drawn))
    }

    /// The integer that is drawn for what has a fingerprint.
    pub(super) fn integer_of(&self, value: Element) -> i64 {
        let [first, second] = value.words();
        2 + i64::from(Key::new("integer").word(first).word(second).draw_word(self.number) % 37)
    }

    fn with(self, atom: &'a Atom, value: i64) -> Self {
        Self { atom: Some((atom, value)), ..self }
    }

    /// The values that generators have times a power of two.
    pub(super) fn grow(&self, generator: Generator, plain: &Quadratic, f: &Field) -> Quadratic {
        let doublings = self.grown.and_then(|grown| grown.doublings.get(&generator).copied()).unwrap_or(0);
        let factor = f.power(&f.number(&Number::integer(2)), &Number::integer(doublings));
        f.mul(&factor, plain)
    }

    /// The value of the atom that has another value, if it is this one.
    pub(super) fn replaced(&self, is_it: impl Fn(&Atom) -> bool) -> Option<i64> {
        self.atom.filter(|(atom, _)| is_it(atom)).map(|(_, value)| value)
    }

    /// The value of an inverse function, which is an odd function of its first argument.
    pub(super) fn inverse(&self, graph: &Graph, atom: &Atom) -> i64 {
        self.atom.and_then(|(known, value)| Some(graph.sign_of_atom(known, atom)? * value)).unwrap_or(0)
    }

    /// The values from which that of a generator is found: those at the plain point if the generator is larger by itself.
    pub(super) fn values_for<'v>(&self, generator: &Generator, values: &'v Values) -> &'v Values
    where
        'a: 'v,
    {
        self.grown.filter(|_| self.grows(generator)).map_or(values, |grown| grown.plain)
    }

    pub(super) fn grows(&self, generator: &Generator) -> bool {
        self.grown.is_some_and(|grown| grown.doublings.contains_key(generator))
    }

    pub(super) fn pi(&self, f: &Field) -> Quadratic {
        let plain = self.replaced(|atom| *atom == Atom::Pi).unwrap_or(1);
        self.grow(Generator::Symbol(Id::PI), &f.number(&Number::integer(plain)), f)
    }
}

pub(super) type Values = FxHashMap<Id, Quadratic>;

/// The values of nodes at an integer point in both hash lanes, and in further ones where there are long numbers.
pub(super) struct Rationals {
    hash: [Values; 2],
    others: Vec<(FieldId, Values)>,
}

impl Rationals {
    /// The value of a node if it is a rational number that is not too large.
    pub(super) fn get(&self, id: Id) -> Option<Number> {
        rational(self.element(id)?)
    }

    /// The value of a node if it is rational, and any number if it is not.
    pub(super) fn guess(&self, id: Id) -> Option<Number> {
        let element = self.element(id)?;
        let number = element.to_simple_rational().or_else(|| self.long_number(id));
        number.or_else(|| element.to_rational_of_short_form())
    }

    /// The value of a node if it is rational, with up to 430 bits above and below the line.
    fn long_number(&self, id: Id) -> Option<Number> {
        let values: Option<Vec<_>> =
            self.others.iter().map(|(field, values)| Some((*field, values.get(&id)?.clone()))).collect();
        likely_number(values?.into_iter())
    }

    fn element(&self, id: Id) -> Option<Element> {
        let [first, second] = &self.hash;
        Some(fingerprint([first.get(&id)?, second.get(&id)?]))
    }
}

/// Whether values made of a number may have more digits than two lanes hold.
pub(super) fn is_long(number: &Number) -> bool {
    number.numerator().bits() > LONG || number.denominator().bits() > LONG
}

impl Graph {
    /// The value of a node at an integer point, if it is a rational number there.
    pub(super) fn at_integers(&self, root: Id, point: IntegerPoint<'_>) -> Option<Number> {
        if let View::Scale(factor, child) = self.view(root) {
            return Some(self.get_number(factor).mul(&self.at_integers(child, point)?));
        }
        let order = self.short_order(&[root])?;
        let mut values = self.rationals(&order, point);
        let mut point = point;
        if values.element(root).is_none() {
            point = point.with_poles_zero();
            values = self.rationals(&order, point);
        }
        let found = values.get(root).or_else(|| {
            let radicals = self.radicals(&order, |id| values.get(id))?;
            mean_of_conjugates(&radicals, |conjugation, field| {
                let point = IntegerPoint { conjugation: Some(conjugation), ..point };
                self.values_at(&order, point, field).remove(&root)
            })
        });
        found.or_else(|| {
            self.long_number_of(&order, |field| self.values_at(&order, point, field).remove(&root))
        })
    }

    /// The values of nodes and of what is below them at two points of integers, and at two more where functions are drawn.
    pub(super) fn at_pairs_of_points(&self, roots: &[Id], are_long: bool) -> Option<[[Rationals; 2]; 2]> {
        let order = self.short_order(roots)?;
        let at = |number| {
            let point = IntegerPoint::numbered(number);
            let lanes = if are_long { LANES_FOR_LONG_NUMBERS } else { 0 };
            let others = FieldId::others(0).take(lanes);
            let others = others.map(|field| (field, self.values_at(&order, point, field))).collect();
            Rationals { others, ..self.rationals(&order, point) }
        };
        Some([[at(1), at(2)], [at(DRAWN), at(DRAWN + 1)]])
    }

    /// The norms of a combination at two points of integers, where it is not rational: a prime that is in its content divides
    /// both.
    pub(super) fn norms_at_pair_of_points(&self, of: Combination) -> Option<[Number; 2]> {
        let roots: Vec<Id> = of.nodes().collect();
        let order = self.short_order(&roots)?;
        let at = |number| self.norm_at(of, &order, IntegerPoint::numbered(number));
        Some([at(1)?, at(2)?])
    }

    fn norm_at(&self, of: Combination, order: &[Id], point: IntegerPoint<'_>) -> Option<Number> {
        let values = self.rationals(order, point);
        let radicals = self.radicals(order, |id| values.get(id))?;
        if radicals.count() * order.len() > MOST_CONJUGATE_VALUES {
            return None;
        }
        norm_of_conjugates(&radicals, |conjugation, field| {
            let f = field.field();
            let values =
                self.values_at(order, IntegerPoint { conjugation: Some(conjugation), ..point }, field);
            of.value(
                |id| values.get(&id).cloned(),
                |value| f.mul(&value, &value),
                |a, sign, b| f.add(&a, &f.mul(&f.number(&Number::integer(sign)), &b)),
            )
        })
    }

    fn rationals(&self, order: &[Id], point: IntegerPoint<'_>) -> Rationals {
        let hash = FieldId::HASH.map(|field| self.values_at(order, point, field));
        Rationals { hash, others: Vec::new() }
    }

    /// The n for which the value of a node is 2^n times as large if generators are larger than at the plain point.
    pub(super) fn doublings_at_integers(
        &self,
        root: Id,
        doublings: &Doublings,
        at: IntegerPoint<'_>,
    ) -> Option<i64> {
        let order = self.short_order(&[root])?;
        let [first, second] = FieldId::HASH.map(|field| {
            let plain = self.values_at(&order, at, field);
            let point = IntegerPoint { grown: Some(Grown { plain: &plain, doublings }), ..at };
            let grown = self.values_at(&order, point, field);
            let ratio = field.field().div(grown.get(&root)?, plain.get(&root)?);
            field.field().power_of_two(&ratio, MOST_DOUBLINGS)
        });
        first.filter(|_| first == second)
    }

    /// The growth of a node's value at an integer point with an atom, if that is rational.
    ///
    /// It is u(2) - u(1) for pi, which is positive, and (u(1) - u(-1))/2 for others, which may be odd functions. Where a part
    /// has a pole there, it is the growth over longer steps. What has a pole in all of them adds nothing.
    pub(super) fn growth_at_integers(
        &self,
        root: Id,
        atom: &Atom,
        point: IntegerPoint<'_>,
    ) -> Option<Number> {
        if let View::Scale(factor, child) = self.view(root) {
            return Some(self.get_number(factor).mul(&self.growth_at_integers(child, atom, point)?));
        }
        let order = self.short_order(&[root])?;
        let growth = |field: FieldId, point: IntegerPoint<'_>, step: i64| {
            let at = |value| self.values_at(&order, point.with(atom, value), field).remove(&root);
            let f = field.field();
            let (from, to) = if *atom == Atom::Pi { (1, 1 + step) } else { (-step, step) };
            let per_unit = f.number(&Number::rational(1, to - from));
            Some(f.mul(&per_unit, &f.sub(&at(to)?, &at(from)?)))
        };
        let somehow = |field: FieldId, point: IntegerPoint<'_>| {
            let [first, ..] = STEPS;
            let found = STEPS.into_iter().find_map(|step| growth(field, point, step));
            found.or_else(|| growth(field, point.with_poles_zero(), first))
        };
        let [first, second] = FieldId::HASH.map(|field| somehow(field, point));
        let found = rational(fingerprint([&first?, &second?])).or_else(|| {
            let values = self.rationals(&order, point.with_poles_zero());
            let radicals = self.radicals(&order, |id| values.get(id))?;
            mean_of_conjugates(&radicals, |conjugation, field| {
                somehow(field, IntegerPoint { conjugation: Some(conjugation), ..point })
            })
        });
        found.or_else(|| self.long_number_of(&order, |field| somehow(field, point)))
    }

    /// The number of many digits that has these values in lanes, if one of these nodes holds such a number.
    fn long_number_of(&self, order: &[Id], value: impl Fn(FieldId) -> Option<Quadratic>) -> Option<Number> {
        if !order.iter().any(|&id| self.holds_long_number(id)) {
            return None;
        }
        let fields = FieldId::others(0).take(LANES_FOR_LONG_NUMBERS);
        let values: Option<Vec<_>> = fields.map(|field| Some((field, value(field)?))).collect();
        likely_number(values?.into_iter())
    }

    /// Whether a node holds a number of many digits itself.
    fn holds_long_number(&self, id: Id) -> bool {
        let is_long = |number| is_long(self.get_number(number));
        match self.view(id) {
            View::Number(number) | View::Scale(number, _) => is_long(number),
            View::Sum(terms) => terms.iter().any(|(number, _)| is_long(number)),
            _ => false,
        }
    }

    /// The nodes below a node and itself, children first, if they are not many.
    pub(super) fn short_order(&self, roots: &[Id]) -> Option<Vec<Id>> {
        let order = self.parts_first(roots, |_| true);
        (order.len() <= MOST_NODES).then_some(order)
    }
}
