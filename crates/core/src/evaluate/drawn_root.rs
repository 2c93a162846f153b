//! Powers of roots that lanes may draw: (u**(m/n) v**k)**n = u**m v**(k n), also for a sum that such a product represents.
//!
//! These are roots of odd degree, and all roots of what contains units of any order, such as sqrt(x**(1/13) + 1).

use crate::graph::{Flags, Graph, Id, Kind, NumberId, View};
use crate::value::Number;

impl Graph {
    /// Whether a root that lanes may draw is among the factors of a product.
    pub(crate) fn holds_drawn_root(&self, id: Id) -> bool {
        let View::Product(factors) = self.view(id) else { return false };
        factors
            .iter()
            .any(|(base, exponent)| self.flags(base).has(Flags::BRANCH) && self.may_be_drawn(base, exponent))
    }

    fn may_be_drawn(&self, base: Id, exponent: NumberId) -> bool {
        let exponent = self.get_number(exponent);
        makes_units(exponent) || !exponent.is_integer() && self.flags(base).has(Flags::UNITS)
    }

    /// The factors of a power of a product of roots that lanes may draw, if they are powers with integer exponents.
    pub(crate) fn powers_of_drawn_roots(&self, root: Id, exponent: &Number) -> Option<Vec<(Id, Number)>> {
        let View::Product(factors) = self.view(root) else { return None };
        if !factors.iter().any(|(base, exponent)| self.may_be_drawn(base, exponent)) {
            return None;
        }
        let power = |(base, inner): (Id, NumberId)| {
            let power = self.get_number(inner).mul(exponent);
            power.is_integer().then_some((base, power))
        };
        factors.iter().map(power).collect()
    }

    /// The same for a sum that is represented by such a product. The form of its power stays as it was written: only the
    /// value follows from the product.
    pub(super) fn powers_of_represented_roots(&self, id: Id, exponent: &Number) -> Option<Vec<(Id, Number)>> {
        if self.kind(id) != Kind::Sum || !self.flags(id).has(Flags::BRANCH) {
            return None;
        }
        let known = self.representative(id);
        if self.holds_drawn_root(known) { self.powers_of_drawn_roots(known, exponent) } else { None }
    }
}

/// Whether a power may turn by a unit of another order than a power of two: its degree is none.
pub(crate) fn makes_units(exponent: &Number) -> bool {
    let degree = exponent.to_small().map_or(1, |(_, degree)| degree);
    !degree.unsigned_abs().is_power_of_two()
}
