//! Powers of negative bases with exponents that are no numbers: the logarithm of a negative u is log |u| + i pi.
//!
//! The exponential of an argument u + i v is e^u times the unit cos v + i sin v, its *turn*. The imaginary part v is the
//! difference of two values of the argument in the field of angles: one with logarithms that are larger by pi where their
//! bases are negative, and one without. So the sign of a power with a symbolic exponent is not known, unless the base
//! is known to be positive.

use crate::graph::{Atom, Graph, Id, Split};
use crate::value::{FieldId, Key, Quadratic};

/// At how many points it is tried whether the base of a power is negative.
const TRIALS: u16 = 16;

impl Graph {
    /// The unit e^(i v) for the imaginary part v of an argument, without the multiples of logarithms that are split off.
    pub(super) fn turn_of_exponential(
        &self,
        argument: Id,
        split: &Split,
        field: FieldId,
    ) -> Option<Quadratic> {
        let angles = field.of_angles()?;
        if !split.iter().any(|(atom, _)| matches!(atom, Atom::Log(_))) {
            return None; // imaginary parts are those of logarithms of what is negative
        }
        let exponent = angles.exponent_of(|angles| self.imaginary_rest(argument, split, angles, field));
        let f = field.field();
        Some(f.unit_of_angle(&f.angle(exponent)))
    }

    /// The imaginary part of an argument in the field of angles, without the logarithms that are split off.
    fn imaginary_rest(&self, argument: Id, split: &Split, angles: FieldId, field: FieldId) -> Quadratic {
        let a = angles.field();
        let negative = split
            .iter()
            .filter(|(atom, _)| matches!(atom, Atom::Log(base) if self.is_negative_in(*base, field)));
        negative.fold(self.imaginary_in(argument, angles, field), |rest, (_, factor)| {
            a.sub(&rest, &a.mul(&a.number(factor), &self.value_in(Id::PI, angles)))
        })
    }

    /// The imaginary part that an argument has by logarithms of what is negative in a field.
    fn imaginary_in(&self, argument: Id, angles: FieldId, field: FieldId) -> Quadratic {
        let turned = self.value_in(argument, angles.with_turned_logarithms(field));
        angles.field().sub(&turned, &self.value_in(argument, angles))
    }

    /// Whether the exponential of an argument holds powers of what may be negative with exponents that are no numbers.
    pub(super) fn has_turns(&self, argument: Id, split: &Split) -> bool {
        split
            .iter()
            .filter_map(|(atom, _)| self.where_negative(atom))
            .filter_map(|field| Some((field.of_angles()?, field)))
            .any(|(angles, field)| !self.imaginary_rest(argument, split, angles, field).is_zero())
    }

    /// Whether the value of an argument depends on the logarithm that an atom is, if that may be one of what is negative.
    pub(super) fn depends_on_logarithm(&self, argument: Id, atom: &Atom) -> bool {
        self.where_negative(atom).is_some_and(|field| {
            field.of_angles().is_some_and(|angles| !self.imaginary_in(argument, angles, field).is_zero())
        })
    }

    /// A random point at which an atom is the logarithm of what is negative, if there is one among several.
    fn where_negative(&self, atom: &Atom) -> Option<FieldId> {
        let Atom::Log(base) = *atom else { return None };
        (0..TRIALS).map(|point| FieldId::HASH[0].at(point)).find(|&field| self.is_negative_in(base, field))
    }

    /// base ** exponent, as exp(exponent * log(base)): base ** n for the number n in the exponent, and the rest.
    pub(super) fn general_power_in(&self, base: Id, exponent: Id, field: FieldId) -> Quadratic {
        let f = field.field();
        let (Some(angles), Some(exponents)) = (field.of_angles(), field.of_exponents()) else {
            let value = self.value_in(exponent, field);
            return match self.logarithm_parts(base) {
                Some(_) => f.drawn_exponential(&f.mul(&value, &self.logarithm_in(base, field))),
                None => f.opaque(Key::new("power of"), &[&self.value_in(base, field), &value]),
            };
        };
        if base == Id::ZERO {
            let value = self.value_in(exponent, field);
            return f.opaque(Key::new("power of zero"), &[&value]);
        }
        let number = self.number_in_lane(exponent, field);
        let rest = |above: FieldId| {
            let a = above.field();
            a.sub(&self.value_in(exponent, above), &a.number(&number))
        };
        let product = |above: FieldId, factor: Quadratic| above.field().mul(&rest(above), &factor);
        let magnitude =
            exponents.exponent_of(|exponents| product(exponents, self.logarithm_in(base, exponents)));
        let power = f.mul(&self.power_in(base, &number, field), &f.exponential(magnitude));
        if self.logarithm_parts(base).is_some() || !self.is_negative_in(base, field) {
            return power;
        }
        let turn = f.angle(angles.exponent_of(|angles| product(angles, self.value_in(Id::PI, angles))));
        f.mul(&power, &f.unit_of_angle(&turn))
    }
}
