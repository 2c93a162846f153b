//! Arguments of sines and exponentials: what has a known angle or exponential, and the rest.
//!
//! The sine of an argument is found from the value of the argument in the field of angles. That does not know that the
//! sine of pi is 0, and that of atan(x) is x/sqrt(1 + x^2). So the argument is split: it is n1 a1 + n2 a2 + ... + rest
//! with *atoms* a that have known angles: pi, and inverse functions. In the same way an exponent is split by logarithms.
//!
//! The factor n of an atom is found by value: it is half of the argument's growth from a = -1 to a = 1 at a point
//! of integers (see [`integer_point`](super::integer_point)). Any such choice is right, because it is additive: whatever is
//! not in the factors stays in the rest.

use std::sync::Arc;

use crate::graph::{Atom, Flags, Function, Graph, Id, Ids, Split, View};
use crate::value::{Field, FieldId, Key, Number, Quadratic, needs_large_products};

use super::integer_point::IntegerPoint;
use super::rational_power::{is_large, power_of_complex, power_of_number, power_of_prime};
use super::rotation::{self, multiple, rotate};

/// The most atoms of an argument.
const MOST_ATOMS: usize = 32;

type Point = rotation::Point<Quadratic>;

impl Graph {
    /// The cosine and the sine of an argument.
    pub(super) fn angle_in(&self, argument: Id, field: FieldId) -> Point {
        let f = field.field();
        let split = self.split_in(argument, false, field);
        let start = match field.of_angles() {
            Some(angles) => f.angle(angles.exponent_of(|angles| self.rest_in(argument, &split, angles))),
            None => f.drawn_angle(Key::new("drawn angle"), &self.rest_in(argument, &split, field)),
        };
        self.rotated(start, &split, f, |id| self.value_in(id, field))
    }

    /// The exponential of an argument.
    pub(super) fn exponential_in(&self, argument: Id, field: FieldId) -> Quadratic {
        let f = field.field();
        let Some(exponents) = field.of_exponents() else {
            return f.drawn_exponential(&self.value_in(argument, field));
        };
        let split = self.split_in(argument, true, field);
        let magnitude = exponents.exponent_of(|exponents| self.rest_in(argument, &split, exponents));
        let magnitude = f.exponential(magnitude);
        let start = match self.turn_of_exponential(argument, &split, field) {
            Some(turn) => f.mul(&magnitude, &turn),
            None => magnitude,
        };
        split.iter().fold(start, |product, (atom, factor)| {
            let power = match atom {
                Atom::Log(argument) => self.power_in(*argument, factor, field),
                Atom::LogOfPrime(prime) => power_of_prime(prime, factor, f),
                _ => self.power_in(Id::PI, factor, field),
            };
            f.mul(&product, &power)
        })
    }

    /// What has to be known before the sine or exponential of an argument can be evaluated.
    pub(super) fn push_needed_by_argument(
        &self,
        argument: Id,
        field: FieldId,
        of_exponential: bool,
        out: &mut Vec<(Id, FieldId)>,
    ) {
        let next = if of_exponential { field.of_exponents() } else { field.of_angles() };
        out.extend(field.points_above(next).map(|next| (argument, next)));
        if next.is_none() {
            return;
        }
        for (atom, _) in self.split_argument(argument, of_exponential).iter() {
            if let (Atom::Log(_), Some(angles)) = (atom, field.of_angles()) {
                for angles in field.points_above(Some(angles)) {
                    out.extend(
                        [angles, angles.with_turned_logarithms(field)].map(|angles| (argument, angles)),
                    );
                }
            }
            for id in atom.arguments() {
                out.push((id, field));
                out.extend(field.points_above(next).map(|next| (id, next)));
            }
        }
    }

    /// Whether the sine or exponential of an argument holds roots that its argument does not hold.
    pub(crate) fn makes_roots(&self, argument: Id, of_exponential: bool) -> bool {
        let split = self.split_argument(argument, of_exponential);
        self.has_turns(argument, &split)
            || split.iter().any(|(atom, factor)| match atom {
                Atom::Log(base) => self.is_branching(*base, factor),
                Atom::LogOfPrime(prime) => !factor.is_integer() && is_large(prime),
                Atom::Pi | Atom::LogOfPi => false,
                _ => true,
            })
    }

    /// Whether the exponential of an argument may be negative, because the argument holds a logarithm of something that
    /// is not known to be positive.
    pub(crate) fn may_be_negative(&self, argument: Id) -> bool {
        self.split_argument(argument, true).iter().any(|(atom, _)| matches!(atom, Atom::Log(_)))
    }

    /// The number in an exponent, such as the 1 in x + 1: the value at a point of integers.
    pub(crate) fn number_in(&self, exponent: Id) -> Number {
        let (first, is_opposite) = self.representative_up_to_sign(exponent);
        let number = self.number_in_first(first);
        if is_opposite { number.neg() } else { number }
    }

    fn number_in_first(&self, exponent: Id) -> Number {
        if let Some(number) = self.as_number(exponent) {
            return number.clone();
        }
        if let Some(known) = self.lanes.borrow().exponent(exponent, None) {
            return known.clone();
        }
        let number =
            self.at_integers(exponent, self.plain_point(exponent)).unwrap_or_else(|| Number::integer(0));
        self.lanes.borrow_mut().insert_exponent(exponent, None, number.clone());
        number
    }

    fn rest_in(&self, argument: Id, split: &Split, field: FieldId) -> Quadratic {
        let f = field.field();
        split.iter().fold(self.value_in(argument, field), |rest, (atom, factor)| {
            f.sub(&rest, &f.mul(&f.number(factor), &self.atom_in(atom, field)))
        })
    }

    /// An angle turned by the known angles of atoms, from the values of their arguments.
    pub(super) fn rotated(
        &self,
        start: Point,
        split: &Split,
        f: &Field,
        value: impl Fn(Id) -> Quadratic,
    ) -> Point {
        split
            .iter()
            .fold(start, |sum, (atom, factor)| rotate(f, &sum, &self.known_angle(atom, factor, f, &value)))
    }

    /// A multiple of the angle that an atom is.
    pub(super) fn known_angle(
        &self,
        atom: &Atom,
        factor: &Number,
        f: &Field,
        value: &impl Fn(Id) -> Quadratic,
    ) -> Point {
        let (point, denominator) = match *atom {
            Atom::Asin(argument) => {
                let length = self.length([Id::ONE, argument], -1, f, value);
                ((length, value(argument)), self.denominator_of(argument, f))
            }
            Atom::Atan(argument) => {
                let scale = f.inverse(&self.length([Id::ONE, argument], 1, f, value));
                ((scale.clone(), f.mul(&value(argument), &scale)), Number::integer(1))
            }
            Atom::Atan2(y, x) => (self.unit_vector(y, x, f, value), Number::integer(1)),
            _ => return f.part_of_turn(&factor.mul(&Number::rational(1, 2))), // pi is half a turn
        };
        let is_complex = atom.arguments().iter().any(|&id| self.is_complex(id));
        let root = |square: Quadratic| {
            let half = Number::rational(1, 2);
            if is_complex { power_of_complex(&square, &half, f) } else { f.rational_power(&square, &half) }
        };
        let halved = if factor.is_integer() { point } else { half_angle(f, &point, &denominator, root) };
        let count = if factor.is_integer() { factor.clone() } else { factor.mul(&Number::integer(2)) };
        multiple(f, halved, count.to_i64().unwrap_or(0))
    }

    /// The denominator of the content of a node.
    fn denominator_of(&self, id: Id, f: &Field) -> Number {
        Number::whole(self.rational_content(id, f).denominator())
    }

    /// The atoms of an argument with their factors.
    pub(super) fn split_argument(&self, argument: Id, of_exponential: bool) -> Split {
        let (first, is_opposite) = self.representative_up_to_sign(argument);
        let split = self.split_first(first, of_exponential);
        if !is_opposite || split.is_empty() {
            return split;
        }
        opposite(&split)
    }

    /// The atoms of an argument that stands for its class.
    pub(super) fn split_first(&self, argument: Id, of_exponential: bool) -> Split {
        if !self.flags(argument).has(Flags::INVERSE) {
            return Arc::new([]);
        }
        if let Some(known) = self.lanes.borrow().split(argument, of_exponential, None) {
            return known;
        }
        let point = self.plain_point(argument);
        let factors = self.atoms(argument, of_exponential).into_iter().filter_map(|atom| {
            let factor = self.factor_in(argument, &atom, point);
            if let Atom::Log(_) = atom {
                let factor = factor.unwrap_or_else(|| Number::integer(0));
                let is_there = !factor.is_zero() || self.depends_on_logarithm(argument, &atom);
                return is_there.then_some((atom, factor));
            }
            let factor = factor.filter(|factor| !factor.is_zero())?;
            let is_known =
                of_exponential || atom == Atom::Pi || factor.mul(&Number::integer(2)).to_i64().is_some();
            is_known.then_some((atom, factor))
        });
        let split: Split = factors.collect();
        self.lanes.borrow_mut().insert_split(argument, of_exponential, None, Arc::clone(&split));
        split
    }

    /// The factor of an atom in an argument, read off at a point of integers.
    ///
    /// One such as -1/299 of a logarithm comes from what holds no multiple of it, such as 1/(4*y + log(x)), and needs units
    /// that are too large.
    pub(super) fn factor_in(&self, argument: Id, atom: &Atom, point: IntegerPoint<'_>) -> Option<Number> {
        let factor = self.growth_at_integers(argument, atom, point)?;
        let is_drawn = matches!(atom, Atom::Log(_)) && needs_large_products(&factor.denominator());
        (!is_drawn).then_some(factor)
    }

    /// The atoms below an argument.
    pub(super) fn atoms(&self, argument: Id, of_exponential: bool) -> Vec<Atom> {
        let mut atoms: Vec<Atom> = Vec::new();
        let enter = |id| self.flags(id).has(Flags::INVERSE);
        for id in self.parts_first(&[argument], enter) {
            let mut found = Vec::new();
            let argument = |args: Ids<'_>, place| self.representative(args.get(place));
            match self.view(id) {
                View::Pi if !of_exponential => found.push(Atom::Pi),
                View::Function(Function::Log, args) if of_exponential => {
                    self.push_atoms_of_logarithm(argument(args, 0), &mut found);
                }
                View::Function(Function::Atan2, _) if self.is_complex(id) => {}
                View::Function(function, args) if !of_exponential => match function {
                    Function::Asin => found.push(Atom::Asin(argument(args, 0))),
                    Function::Acos => found.extend([Atom::Pi, Atom::Asin(argument(args, 0))]),
                    Function::Atan => found.push(Atom::Atan(argument(args, 0))),
                    Function::Atan2 => found.push(Atom::Atan2(argument(args, 0), argument(args, 1))),
                    _ => {}
                },
                _ => {}
            }
            for atom in found {
                if atoms.len() < MOST_ATOMS
                    && !atoms.iter().any(|known| self.sign_of_atom(known, &atom).is_some())
                {
                    atoms.push(atom);
                }
            }
        }
        atoms
    }

    /// 1 if two atoms are equal, and -1 if they are opposite.
    pub(super) fn sign_of_atom(&self, a: &Atom, b: &Atom) -> Option<i64> {
        let of_odd = |a: Id, b: Id| match (self.same(a, b), self.opposite_values(a, b)) {
            (true, _) => Some(1),
            (_, true) => Some(-1),
            _ => None,
        };
        match (a, b) {
            (Atom::Asin(a), Atom::Asin(b)) | (Atom::Atan(a), Atom::Atan(b)) => of_odd(*a, *b),
            (Atom::Atan2(y, x), Atom::Atan2(v, u)) => of_odd(*y, *v).filter(|_| self.same(*x, *u)),
            (Atom::Log(a), Atom::Log(b)) => self.same(*a, *b).then_some(1),
            _ => (a == b).then_some(1),
        }
    }
}

/// The split of the opposite argument.
pub(super) fn opposite(split: &Split) -> Split {
    split.iter().map(|(atom, factor)| (atom.clone(), factor.neg())).collect()
}

/// Half of an angle between -pi and pi: the cosine is sqrt((1 + cos)/2), where 1/`denominator` is taken out of the root.
fn half_angle(
    f: &Field,
    point: &Point,
    denominator: &Number,
    root: impl Fn(Quadratic) -> Quadratic,
) -> Point {
    let square = f.mul(&f.number(denominator), &f.half(&f.add(&f.one(), &point.0)));
    let scale = power_of_number(denominator, &Number::rational(-1, 2), f);
    let cos = f.mul(&scale, &root(square));
    let sin = f.div(&f.half(&point.1), &cos);
    (cos, sin)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::graph::Assumption;

    /// log(a) = (L**2 - (a + 1)**2)/(L + a + 1) + a + 1 - log(12) for L = log(12*a), with 2 for a + 1 at a point of integers.
    #[test]
    fn a_logarithm_is_found_beside_what_has_a_pole_at_the_point_of_integers() -> Result<(), Error> {
        let g = &mut Graph::new();
        let (a, twelve, two) = (g.symbol("a", Assumption::Positive), g.integer(12), Number::integer(2));
        let (number, more) = (g.apply(Function::Log, &[twelve])?, g.add(a, Id::ONE));
        let product = g.mul(twelve, a)?;
        let logarithm = g.apply(Function::Log, &[product])?;
        let (square, other) = (g.pow_number(logarithm, &two)?, g.pow_number(more, &two)?);
        let (difference, sum) = (g.sub(square, other), g.add(logarithm, more));
        let quotient = g.div(difference, sum)?;
        let whole = g.add(quotient, more);
        let argument = g.sub(whole, number);
        let exponential = g.apply(Function::Exp, &[argument])?;
        assert!(g.same(exponential, a));
        Ok(())
    }

    /// cosh(sqrt(u v)/sqrt(u)) for u = b + 1, whose sign no lane knows, and cosh(sqrt(v)).
    #[test]
    fn an_even_function_does_not_hide_the_sign_of_a_root() -> Result<(), Error> {
        let g = &mut Graph::new();
        let (b, v) = (g.symbol("b", Assumption::Positive), g.symbol("v", Assumption::Real));
        let u = g.add(b, Id::ONE);
        let half = Number::rational(1, 2);
        let product = g.mul(u, v)?;
        let (both, one) = (g.pow_number(product, &half)?, g.pow_number(u, &half.neg())?);
        let root = g.pow_number(v, &half)?;
        let argument = g.mul(both, one)?;
        let [cosh, other] = [g.apply(Function::Cosh, &[argument])?, g.apply(Function::Cosh, &[root])?];
        assert_eq!(g.value(cosh), g.value(other));
        assert!(!g.same(cosh, other));
        let opposite = g.neg(argument);
        let even = g.apply(Function::Cosh, &[opposite])?;
        assert!(g.same(cosh, even));
        Ok(())
    }
}
