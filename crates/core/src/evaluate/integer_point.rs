//! Exact values at a point of integers where all exponentials are one: additive functions of an expression's value.
//!
//! Variables are small integers there, positive symbols, pi and exponentials are 1, sines are 0, and logarithms and
//! inverse functions are 0. The addition theorems and the laws of roots and signs hold as in any lane, so expressions that are
//! equal by value are equal at this point. Therefore what is read off here does not depend on the form: by how much an
//! argument grows with pi, or the 1 in the exponent of x**(y + 1).

use rustc_hash::FxHashMap;

use crate::graph::{Assumption, Atom, Function, Generator, Graph, Id, Split, View};
use crate::interrupt::tick;
use crate::value::{
    Element, Field, FieldId, Key, Number, Quadratic, fingerprint, likely_number, prime_factors,
};

use super::conjugates::{Conjugation, Radicals};
use super::logarithm_part::Part;

/// Larger expressions have no value here.
const MOST_NODES: usize = 4096;

/// At points from this one on, sines, exponentials and their like are integers as variables are: at the others sines
/// are zero, and so is what they are factors of.
const DRAWN: u64 = 3;

/// The lanes from whose values a number of many digits is found.
const LANES_FOR_LONG_NUMBERS: usize = 16;

/// The largest power of two that is recognised.
const MOST_DOUBLINGS: i64 = 20_000;

/// The n of the powers 2^n by which generators are larger than at the plain point.
pub(super) type Doublings = FxHashMap<Generator, i64>;

/// Values at the plain point, and by how much generators are larger than there.
#[derive(Clone, Copy)]
struct Grown<'a> {
    plain: &'a Values,
    doublings: &'a Doublings,
}

/// What differs from the point of the module's description.
#[derive(Clone, Copy)]
pub(super) struct IntegerPoint<'a> {
    grown: Option<Grown<'a>>,
    /// What has another value, and that value.
    pub atom: Option<(&'a Atom, i64)>,
    /// Which of several points.
    pub number: u64,
    /// The lane whose signs are those here, if they are not those of the values at the point.
    signs: Option<FieldId>,
    /// Whether poles are zero, so that other terms of a sum have their values.
    poles_are_zero: bool,
    /// What roots are multiplied by.
    conjugation: Option<&'a Conjugation<'a>>,
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

    fn is_first(&self) -> bool {
        self.number == 0
    }

    /// Whether functions are drawn here, as variables are.
    fn draws_functions(&self) -> bool {
        self.number >= DRAWN
    }

    /// The lane whose signs are those here; where functions are drawn, their values have no relations that make signs.
    fn lane(&self) -> Option<FieldId> {
        let of_drawn = || FieldId::other(u16::from(self.number != DRAWN));
        self.signs.or_else(|| self.draws_functions().then(of_drawn))
    }

    /// The integer that is drawn for what has a fingerprint.
    fn integer_of(&self, value: Element) -> i64 {
        let [first, second] = value.words();
        2 + i64::from(Key::new("integer").word(first).word(second).draw_word(self.number) % 37)
    }

    fn with(self, atom: &'a Atom, value: i64) -> Self {
        Self { atom: Some((atom, value)), ..self }
    }

    /// The values that generators have times a power of two.
    fn grow(&self, generator: Generator, plain: &Quadratic, f: &Field) -> Quadratic {
        let doublings = self.grown.and_then(|grown| grown.doublings.get(&generator).copied()).unwrap_or(0);
        let factor = f.power(&f.number(&Number::integer(2)), &Number::integer(doublings));
        f.mul(&factor, plain)
    }

    /// The value of the atom that has another value, if it is this one.
    fn replaced(&self, is_it: impl Fn(&Atom) -> bool) -> Option<i64> {
        self.atom.filter(|(atom, _)| is_it(atom)).map(|(_, value)| value)
    }

    /// The value of an inverse function, which is an odd function of its first argument.
    fn inverse(&self, graph: &Graph, atom: &Atom) -> i64 {
        self.atom.and_then(|(known, value)| Some(graph.sign_of_atom(known, atom)? * value)).unwrap_or(0)
    }

    /// The values from which that of a generator is found: those at the plain point if the generator is larger by itself.
    fn values_for<'v>(&self, generator: &Generator, values: &'v Values) -> &'v Values
    where
        'a: 'v,
    {
        self.grown.filter(|_| self.grows(generator)).map_or(values, |grown| grown.plain)
    }

    fn grows(&self, generator: &Generator) -> bool {
        self.grown.is_some_and(|grown| grown.doublings.contains_key(generator))
    }

    fn pi(&self, f: &Field) -> Quadratic {
        let plain = self.replaced(|atom| *atom == Atom::Pi).unwrap_or(1);
        self.grow(Generator::Symbol(Id::PI), &f.number(&Number::integer(plain)), f)
    }
}

type Values = FxHashMap<Id, Quadratic>;

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

impl Graph {
    /// The value of a node at an integer point, if it is a rational number there.
    pub(super) fn at_integers(&self, root: Id, point: IntegerPoint<'_>) -> Option<Number> {
        let order = self.short_order(&[root])?;
        let mut values = self.rationals(&order, point);
        let mut point = point;
        if values.element(root).is_none() {
            point = point.with_poles_zero();
            values = self.rationals(&order, point);
        }
        values.get(root).or_else(|| {
            let radicals = self.radicals(&order, |id| values.get(id))?;
            mean_of_conjugates(&radicals, |conjugation, field| {
                let point = IntegerPoint { conjugation: Some(conjugation), ..point };
                self.values_at(&order, point, field).remove(&root)
            })
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
    /// It is u(2) - u(1) for pi, which is positive, and (u(1) - u(-1))/2 for others, which may be odd functions. What has a
    /// pole at the point adds nothing.
    pub(super) fn growth_at_integers(
        &self,
        root: Id,
        atom: &Atom,
        point: IntegerPoint<'_>,
    ) -> Option<Number> {
        let order = self.short_order(&[root])?;
        let growth = |field: FieldId, point: IntegerPoint<'_>| {
            let at = |value| self.values_at(&order, point.with(atom, value), field).remove(&root);
            let f = field.field();
            Some(match atom {
                Atom::Pi => f.sub(&at(2)?, &at(1)?),
                _ => f.half(&f.sub(&at(1)?, &at(-1)?)),
            })
        };
        let somehow = |field: FieldId, point: IntegerPoint<'_>| {
            growth(field, point).or_else(|| growth(field, point.with_poles_zero()))
        };
        let [first, second] = FieldId::HASH.map(|field| somehow(field, point));
        rational(fingerprint([&first?, &second?])).or_else(|| {
            let values = self.rationals(&order, point.with_poles_zero());
            let radicals = self.radicals(&order, |id| values.get(id))?;
            mean_of_conjugates(&radicals, |conjugation, field| {
                somehow(field, IntegerPoint { conjugation: Some(conjugation), ..point })
            })
        })
    }

    /// The nodes below a node and itself, children first, if they are not many.
    pub(super) fn short_order(&self, roots: &[Id]) -> Option<Vec<Id>> {
        let order = self.parts_first(roots, |_| true);
        (order.len() <= MOST_NODES).then_some(order)
    }

    /// The values of nodes in the first field of a lane, but of those that have a pole.
    fn values_at(&self, order: &[Id], point: IntegerPoint<'_>, field: FieldId) -> Values {
        let mut values = Values::default();
        for &id in order {
            tick();
            // A pole does no harm inside functions that do not ask for its value.
            if let Some(value) = self.value_at(id, point, &values, field) {
                values.insert(id, value);
            }
        }
        values
    }

    fn value_at(
        &self,
        id: Id,
        point: IntegerPoint<'_>,
        values: &Values,
        field: FieldId,
    ) -> Option<Quadratic> {
        let f = field.field();
        let integer = |n: i64| f.number(&Number::integer(n));
        match self.view(id) {
            View::Number(number) => Some(f.number(self.get_number(number))),
            View::Pi => Some(point.pi(f)),
            View::Symbol(_, Assumption::Positive) => Some(point.grow(Generator::Symbol(id), &f.one(), f)),
            View::Time | View::Symbol(..) | View::TimeFunction(..) | View::Application { .. } => {
                Some(integer(point.integer_of(self.value(id))))
            }
            View::Function(function, _) if point.draws_functions() && !function.is_choice() => {
                let (unsigned, negated) = self.value(id).unsigned();
                let drawn = point.integer_of(unsigned);
                Some(integer(if negated { -drawn } else { drawn }))
            }
            View::Scale(number, child) => {
                Some(f.mul(&f.number(self.get_number(number)), values.get(&child)?))
            }
            View::Sum(terms) => {
                terms.iter().try_fold(f.number(&Number::integer(0)), |sum, (number, node)| {
                    Some(f.add(&sum, &f.mul(&f.number(self.get_number(number)), values.get(&node)?)))
                })
            }
            View::Product(factors) => factors.iter().try_fold(f.one(), |product, (base, exponent)| {
                let exponent = self.get_number(exponent);
                let base = if exponent.is_integer() { base } else { self.representative(base) };
                let value = values.get(&base)?;
                if value.is_zero() && exponent.is_negative() {
                    return point.poles_are_zero.then(|| value.clone());
                }
                let power = self.power_of(base, value, exponent, f);
                let product = f.mul(&product, &power);
                Some(match point.conjugation {
                    Some(conjugation) if !exponent.is_integer() => {
                        f.mul(&product, &f.unit(&conjugation.turn_of(base, exponent)))
                    }
                    _ => product,
                })
            }),
            View::Function(function, args) => {
                let args: Vec<Id> = self.represented(args).collect();
                self.function_at(function, &args, point, values, field)
            }
            View::LinearSystem { .. } | View::Solution(..) => None,
        }
    }

    fn function_at(
        &self,
        function: Function,
        args: &[Id],
        point: IntegerPoint<'_>,
        values: &Values,
        field: FieldId,
    ) -> Option<Quadratic> {
        let f = field.field();
        let of = |id: Id| values.get(&id);
        let integer = |n: i64| f.number(&Number::integer(n));
        Some(match function {
            Function::Sin => self.angle_at(args[0], point, values, field)?.1,
            Function::Cos => self.angle_at(args[0], point, values, field)?.0,
            Function::Tan => {
                let (cos, sin) = self.angle_at(args[0], point, values, field)?;
                f.div(&sin, &cos)
            }
            Function::Exp => self.exponential_at(args[0], point, values, field)?,
            Function::Sinh | Function::Cosh | Function::Tanh => {
                let exponential = self.exponential_at(args[0], point, values, field)?;
                let inverse = f.inverse(&exponential);
                let (sinh, cosh) =
                    (f.half(&f.sub(&exponential, &inverse)), f.half(&f.add(&exponential, &inverse)));
                match function {
                    Function::Sinh => sinh,
                    Function::Cosh => cosh,
                    _ => f.div(&sinh, &cosh),
                }
            }
            Function::Log => self.logarithm_at(args[0], point, values, field)?,
            Function::Asin => integer(point.inverse(self, &Atom::Asin(args[0]))),
            Function::Acos => {
                let asin = integer(point.inverse(self, &Atom::Asin(args[0])));
                f.sub(&f.half(&point.pi(f)), &asin)
            }
            Function::Atan => integer(point.inverse(self, &Atom::Atan(args[0]))),
            Function::Atan2 => integer(point.inverse(self, &Atom::Atan2(args[0], args[1]))),
            Function::Abs if self.has_modulus_at(args[0], of(args[0])?) => f.absolute_value(of(args[0])?),
            Function::Abs => f.mul(of(args[0])?, &self.sign_at(args[0], of(args[0])?, point, f)),
            Function::Sign if self.has_modulus_at(args[0], of(args[0])?) => {
                f.div(of(args[0])?, &f.absolute_value(of(args[0])?))
            }
            Function::Sign => self.sign_at(args[0], of(args[0])?, point, f),
            Function::Min | Function::Max => {
                args.iter().try_for_each(|&arg| of(arg).map(drop))?;
                let chosen = match point.lane() {
                    Some(lane) => {
                        self.extremum_in(function, args, |arg| self.value_in(arg, lane), lane.field())
                    }
                    None => self.extremum_in(function, args, |arg| values[&arg].clone(), f),
                };
                values[&chosen].clone()
            }
            Function::Power => {
                let generator = Generator::Power { base: args[0], exponent: args[1] };
                let values = point.values_for(&generator, values);
                let base = values.get(&args[0])?;
                point.grow(generator, &power(base, &self.number_in_at(args[1], point), f)?, f)
            }
            Function::Piecewise => {
                let all: Option<Vec<&Quadratic>> = args.iter().map(|&arg| of(arg)).collect();
                let all: Vec<Quadratic> = all?.into_iter().cloned().collect();
                let signs: Vec<Quadratic> =
                    args.iter().zip(&all).map(|(&arg, value)| self.sign_at(arg, value, point, f)).collect();
                f.piecewise(&all, &signs)
            }
        })
    }

    /// Whether a node that has this value has no sign there.
    fn has_modulus_at(&self, id: Id, value: &Quadratic) -> bool {
        !value.is_real() && !self.has_real_values(id)
    }

    /// The sign of a node that has this value, or that in the lane of the point.
    fn sign_at(&self, id: Id, value: &Quadratic, point: IntegerPoint<'_>, f: &Field) -> Quadratic {
        match point.lane() {
            Some(lane) if self.is_negative_in(id, lane) => f.neg(&f.one()),
            Some(_) => f.one(),
            None => self.sign_of(id, value, f),
        }
    }

    /// The cosine and the sine of the known angles in an argument.
    fn angle_at(
        &self,
        argument: Id,
        point: IntegerPoint<'_>,
        values: &Values,
        field: FieldId,
    ) -> Option<(Quadratic, Quadratic)> {
        let f = field.field();
        let split = self.split_at(argument, false, point);
        let needed = split.iter().flat_map(|(atom, _)| atom.arguments());
        let is_known = needed.into_iter().all(|id| values.contains_key(&id));
        let start = (f.one(), f.number(&Number::integer(0)));
        is_known.then(|| self.rotated(start, &split, f, |id| values[&id].clone()))
    }

    fn split_at(&self, argument: Id, of_exponential: bool, point: IntegerPoint<'_>) -> Split {
        match point.lane() {
            Some(lane) => self.split_in(argument, of_exponential, lane),
            None => self.split_argument(argument, of_exponential),
        }
    }

    /// The exponential of the logarithms in an argument.
    fn exponential_at(
        &self,
        argument: Id,
        point: IntegerPoint<'_>,
        values: &Values,
        field: FieldId,
    ) -> Option<Quadratic> {
        let f = field.field();
        let generator = Generator::Exponential(argument);
        let is_generator = point.grows(&generator);
        let values = point.values_for(&generator, values);
        let split = self.split_at(argument, true, point);
        let plain = split.iter().try_fold(f.one(), |product, (atom, factor)| {
            let base = match atom {
                Atom::Log(argument) => values.get(argument)?.clone(),
                Atom::LogOfPrime(prime) => f.number(&Number::whole(prime.clone())),
                _ if is_generator => f.one(),
                _ => point.pi(f),
            };
            Some(f.mul(&product, &power(&base, &self.factor_at(argument, atom, factor, point), f)?))
        });
        Some(point.grow(generator, &plain?, f))
    }

    /// The number in an exponent at one of several points: what 2^y - 7 is at all of them is no multiple of a prime.
    fn number_in_at(&self, exponent: Id, point: IntegerPoint<'_>) -> Number {
        let own =
            (!point.is_first()).then(|| self.at_integers(exponent, IntegerPoint::numbered(point.number)));
        own.flatten().unwrap_or_else(|| match point.lane() {
            Some(lane) => self.number_in_lane(exponent, lane),
            None => self.number_in(exponent),
        })
    }

    /// The factor of an atom in an argument, likewise.
    fn factor_at(&self, argument: Id, atom: &Atom, plain: &Number, point: IntegerPoint<'_>) -> Number {
        let own = (!point.is_first())
            .then(|| self.growth_at_integers(argument, atom, IntegerPoint::numbered(point.number)));
        own.flatten().unwrap_or_else(|| plain.clone())
    }

    /// The sum of the parts of a logarithm: those of positive symbols are zero.
    fn logarithm_at(
        &self,
        argument: Id,
        point: IntegerPoint<'_>,
        values: &Values,
        field: FieldId,
    ) -> Option<Quadratic> {
        let f = field.field();
        let Some(parts) = self.logarithm_parts(argument) else {
            let is_it = |atom: &Atom| matches!(atom, Atom::Log(known) if self.same(*known, argument));
            return Some(f.number(&Number::integer(point.replaced(is_it).unwrap_or(0))));
        };
        let of_prime = |number: &Number| match point.atom {
            Some((Atom::LogOfPrime(prime), value)) => {
                value * prime_factors(number).get(prime).copied().unwrap_or(0)
            }
            _ => 0,
        };
        let of_base = |base: Id| match base {
            Id::PI => point.replaced(|atom| *atom == Atom::LogOfPi).unwrap_or(0),
            _ => 0,
        };
        let integer = |n: i64| f.number(&Number::integer(n));
        parts.iter().try_fold(integer(0), |sum, part| {
            let (coefficient, value) = match part {
                Part::Exponent(coefficient, node) => (coefficient, values.get(node)?.clone()),
                Part::Logarithm(coefficient, node) => (coefficient, integer(of_base(*node))),
                Part::Number(coefficient, number) => (coefficient, integer(of_prime(number))),
                Part::Power(coefficient, exponent, base) => {
                    let logarithm = self.logarithm_at(*base, point, values, field)?;
                    if logarithm.is_zero() {
                        return Some(sum); // whatever the exponent is
                    }
                    (coefficient, f.mul(values.get(exponent)?, &logarithm))
                }
            };
            Some(f.add(&sum, &f.mul(&f.number(coefficient), &value)))
        })
    }
}

/// The mean of the conjugates of a value that a point of integers has in a field, if that is rational.
fn mean_of_conjugates(
    radicals: &Radicals,
    value: impl Fn(&Conjugation<'_>, FieldId) -> Option<Quadratic>,
) -> Option<Number> {
    let mean = |field: FieldId| {
        let f = field.field();
        let (mut sum, mut count) = (f.number(&Number::integer(0)), 0);
        for conjugation in radicals.conjugations() {
            sum = f.add(&sum, &value(&conjugation, field)?);
            count += 1;
        }
        Some(f.mul(&f.number(&Number::rational(1, count)), &sum))
    };
    let [first, second] = FieldId::HASH.map(mean);
    rational(fingerprint([&first?, &second?]))
}

/// The rational number that has a value, if that is not too large.
fn rational(element: Element) -> Option<Number> {
    element.to_simple_rational().or_else(|| element.to_likely_rational())
}

/// A rational power; `None` at a pole.
fn power(base: &Quadratic, exponent: &Number, f: &Field) -> Option<Quadratic> {
    if base.is_zero() && exponent.is_negative() {
        return None;
    }
    Some(f.rational_power(base, exponent))
}
