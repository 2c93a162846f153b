//! Signs in exponents and angles: 2**sign(x) is 2 or 1/2, and pi sign(x)/3 a known angle, where signs are those of a lane.
//!
//! The number in an exponent, and the factors of the atoms in an argument, are read off at the point of integers at which
//! signs are those of the lane. So what is left in an argument without its atoms holds no multiples of these that signs make.

use std::sync::Arc;

use crate::graph::{Atom, Flags, Graph, Id, Split, View};
use crate::value::{FieldId, Number};

use super::argument::opposite;
use super::integer_point::IntegerPoint;

impl Graph {
    /// The number in an exponent where signs are those of a lane.
    pub(super) fn number_in_lane(&self, exponent: Id, field: FieldId) -> Number {
        let (first, is_opposite) = self.representative_up_to_sign(exponent);
        if !self.has_signs_alone(first) {
            return self.number_in(exponent);
        }
        let lane = field.of_signs();
        let known = self.lanes.borrow().exponent(first, Some(lane)).cloned();
        let number = known.unwrap_or_else(|| {
            let found = self.at_integers(first, IntegerPoint::with_signs_of(lane));
            let number = found.unwrap_or_else(|| Number::integer(0));
            self.lanes.borrow_mut().insert_exponent(first, Some(lane), number.clone());
            number
        });
        if is_opposite { number.neg() } else { number }
    }

    /// The atoms of an argument with their factors where signs are those of a lane: 2**sign(x) is 2 or 1/2 there.
    pub(super) fn split_in(&self, argument: Id, of_exponential: bool, field: FieldId) -> Split {
        let (first, is_opposite) = self.representative_up_to_sign(argument);
        if !self.flags(first).has(Flags::INVERSE) || !self.has_signs_alone(first) {
            return self.split_argument(argument, of_exponential);
        }
        let lane = field.of_signs();
        let known = self.lanes.borrow().split(first, of_exponential, Some(lane));
        let split = known.unwrap_or_else(|| {
            let split = self.split_first_in(first, of_exponential, lane);
            self.lanes.borrow_mut().insert_split(first, of_exponential, Some(lane), Arc::clone(&split));
            split
        });
        if is_opposite { opposite(&split) } else { split }
    }

    fn split_first_in(&self, argument: Id, of_exponential: bool, lane: FieldId) -> Split {
        let plain = self.split_first(argument, of_exponential);
        let at_signs = |atom: Atom| {
            let known = plain.iter().find(|(other, _)| *other == atom).map(|(_, factor)| factor);
            let factor = self.factor_in(argument, &atom, IntegerPoint::with_signs_of(lane));
            let factor = factor.unwrap_or_else(|| Number::integer(0));
            let factor = match atom {
                Atom::Pi | Atom::LogOfPi | Atom::LogOfPrime(_) => {
                    Some(factor).filter(|factor| !factor.is_zero())
                }
                Atom::Log(_) => Some(factor).filter(|factor| known.is_some() || !factor.is_zero()),
                // The roots in halves of an angle are among the signs of the plain split.
                _ if known.is_some_and(|known| known.abs() == factor.abs()) => Some(factor),
                _ => known.cloned(),
            };
            Some((atom, factor?))
        };
        self.atoms(argument, of_exponential).into_iter().filter_map(at_signs).collect()
    }

    /// The point of integers for what all lanes share. The sign of an integer with a large prime factor may differ between
    /// the lanes from whose values a number is found, so signs are those of one lane if they can be.
    pub(super) fn plain_point(&self, id: Id) -> IntegerPoint<'static> {
        if self.has_signs_alone(id) {
            IntegerPoint::with_signs_of(FieldId::HASH[0])
        } else {
            IntegerPoint::PLAIN
        }
    }

    /// Whether a node holds signs, but no roots that have signs: a root at a point of integers has none of a lane.
    pub(super) fn has_signs_alone(&self, id: Id) -> bool {
        if !self.flags(id).has(Flags::BRANCH) {
            return false;
        }
        if let Some(known) = self.lanes.borrow().has_signs_alone(id) {
            return known;
        }
        let parts = self.parts_first(&[id], |id| self.flags(id).has(Flags::BRANCH));
        let has_roots = parts.into_iter().any(|id| match self.view(id) {
            View::Product(factors) => {
                factors.iter().any(|(_, exponent)| !self.get_number(exponent).is_integer())
            }
            _ => false,
        });
        self.lanes.borrow_mut().insert_has_signs_alone(id, !has_roots);
        !has_roots
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::graph::{Assumption, Function};

    #[test]
    fn the_factor_of_an_atom_is_a_sign_whatever_is_inside() -> Result<(), Error> {
        let g = &mut Graph::new();
        let y = g.symbol("y", Assumption::Real);
        let atan = g.apply(Function::Atan, &[y])?;
        for name in ["x", "u", "v", "w", "q", "z", "stranger", "alien"] {
            let symbol = g.symbol(name, Assumption::Real);
            for (factor, summand) in [(2, -1), (2, -7), (7, -11), (14, 5), (14, 1)] {
                let (factor, summand) = (g.number_id(&Number::integer(factor)), Number::integer(summand));
                let (multiple, summand) = (g.scale(factor, symbol), g.number(&summand));
                let sum = g.add(multiple, summand);
                let sign = g.apply(Function::Sign, &[sum])?;
                let argument = g.mul(sign, atan)?;
                let factors: Vec<Number> =
                    g.split_argument(argument, false).iter().map(|(_, factor)| factor.abs()).collect();
                assert_eq!(factors, [Number::integer(1)], "{name}");
            }
        }
        Ok(())
    }
}
