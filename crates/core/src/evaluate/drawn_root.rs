//! Powers of roots that lanes may draw: (u**(m/n) v**k)**n = u**m v**(k n), also for a sum that such a product represents.
//!
//! These are roots of odd degree, and all roots of what contains units of any order, such as sqrt(x**(1/13) + 1).

use crate::graph::{Flags, Graph, Id, Kind};
use crate::value::Number;

impl Graph {
    /// Whether a root that lanes may draw is among the factors of a product.
    pub(crate) fn holds_drawn_root(&self, id: Id) -> bool {
        self.powers_in(id).iter().any(|(base, exponent)| {
            self.flags(*base).has(Flags::BRANCH) && self.may_be_drawn(*base, exponent)
        })
    }

    fn may_be_drawn(&self, base: Id, exponent: &Number) -> bool {
        makes_units(exponent) || !exponent.is_integer() && self.flags(base).has(Flags::UNITS)
    }

    /// The powers that a product with roots is made of, also where each is a node of its own; none of other nodes.
    fn powers_in(&self, id: Id) -> Vec<(Id, Number)> {
        if self.kind(id) == Kind::Product && self.flags(id).has(Flags::ROOT) {
            self.opened(&[(id, Number::integer(1))])
        } else {
            Vec::new()
        }
    }

    /// The factors of an integer power of a product of roots that lanes may draw, or such a root; `None` of other powers.
    pub(crate) fn powers_of_drawn_roots(&self, root: Id, exponent: &Number) -> Option<Vec<(Id, Number)>> {
        if !exponent.is_integer() {
            return self.may_be_drawn(root, exponent).then(|| vec![(root, exponent.clone())]);
        }
        let factors = self.powers_in(root);
        let holds_drawn = factors.iter().any(|(base, inner)| self.may_be_drawn(*base, inner));
        holds_drawn.then(|| factors.into_iter().map(|(base, inner)| (base, inner.mul(exponent))).collect())
    }

    /// The same for a sum that is represented by such a product, if all exponents are integers. The form of its power stays as it was written: only the
    /// value follows from the product.
    pub(super) fn powers_of_represented_roots(&self, id: Id, exponent: &Number) -> Option<Vec<(Id, Number)>> {
        if self.kind(id) != Kind::Sum || !self.flags(id).has(Flags::BRANCH) {
            return None;
        }
        let known = self.representative(id);
        let powers =
            if self.holds_drawn_root(known) { self.powers_of_drawn_roots(known, exponent) } else { None };
        powers.filter(|powers| powers.iter().all(|(_, power)| power.is_integer()))
    }
}

/// Whether a power may turn by a unit of another order than a power of two: its degree is none.
pub(crate) fn makes_units(exponent: &Number) -> bool {
    let degree = exponent.to_small().map_or(1, |(_, degree)| degree);
    !degree.unsigned_abs().is_power_of_two()
}
