//! Powers of roots of odd degree, which lanes may draw: (u**(m/n) v**k)**n = u**m v**(k n), also for a sum that such a
//! product represents.

use crate::graph::{Flags, Graph, Id, Kind, NumberId, View};
use crate::value::Number;

impl Graph {
    /// Whether a root of odd degree is among the factors of a product, which lanes may draw.
    pub(crate) fn holds_odd_root(&self, id: Id) -> bool {
        let View::Product(factors) = self.view(id) else { return false };
        factors
            .iter()
            .any(|(base, exponent)| self.flags(base).has(Flags::BRANCH) && self.is_odd_root(exponent))
    }

    fn is_odd_root(&self, exponent: NumberId) -> bool {
        let degree = self.get_number(exponent).to_small().map_or(1, |(_, degree)| degree);
        degree > 1 && degree % 2 == 1
    }

    /// The factors of a power of a product of roots of odd degree, if they are powers with integer exponents.
    pub(crate) fn powers_of_odd_roots(&self, root: Id, exponent: &Number) -> Option<Vec<(Id, Number)>> {
        let View::Product(factors) = self.view(root) else { return None };
        if !factors.iter().any(|(_, exponent)| self.is_odd_root(exponent)) {
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
        if self.holds_odd_root(known) { self.powers_of_odd_roots(known, exponent) } else { None }
    }
}
