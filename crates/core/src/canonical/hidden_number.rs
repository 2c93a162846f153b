//! Numbers that a form hides: a piecewise function with one value in all its branches, a sum in which the variables cancel.
//!
//! A number decides whether a function is defined and which value it has, so what is equal to a number is replaced by it
//! where a function is decided by numbers.

use crate::graph::{Function, Graph, Id, Kind};
use crate::value::{FieldId, Number, likely_number};

impl Graph {
    /// The number that a piecewise function is in all its branches, or that a node is whose fingerprint does not show it,
    /// or the node itself.
    pub(super) fn settled(&mut self, id: Id) -> Id {
        if self.kind(id) != Kind::Function(Function::Piecewise) {
            let hides_number = self.has_large_numbers
                && self.as_number(id).is_none() // 0.4 stays a decimal where 2/5 was met before
                && self.as_number(self.representative(id)).is_some();
            return if hides_number { self.representative(id) } else { id };
        }
        self.hidden_number(id).map_or(id, |number| self.number(&number))
    }

    /// The argument of a function or root that is decided by numbers: the number that a sum or a product hides, which
    /// a derivation does not look for, or a function where it has many digits, or the node itself.
    pub(super) fn decided(&mut self, id: Id) -> Id {
        let settled = self.settled(id);
        let may_hide_number = match self.kind(settled) {
            Kind::Sum | Kind::Product | Kind::Scale => true,
            Kind::Function(_) => self.has_large_numbers,
            _ => false,
        };
        if !may_hide_number {
            return settled;
        }
        self.hidden_number(settled).map_or(settled, |number| self.number(&number))
    }

    /// The number that a node is in all lanes, if it has less than 46 bits above and below the line; where large numbers
    /// have been met, up to 850 bits.
    fn hidden_number(&self, id: Id) -> Option<Number> {
        let value = self.value(id);
        let number = value.to_simple_rational().or_else(|| value.to_likely_rational());
        number.or_else(|| self.large_number(id)).filter(|number| self.has_value_of_number(id, number))
    }

    /// The number, with many digits, that a node has as its value in many lanes. Most nodes are no number, which shows at a
    /// second point of the first lane.
    fn large_number(&self, id: Id) -> Option<Number> {
        const LANES: usize = 32;
        let [first, _] = FieldId::HASH;
        if !self.has_large_numbers || self.value_in(id, first) != self.value_in(id, first.at(1)) {
            return None;
        }
        likely_number(FieldId::others(0).take(LANES).map(|field| (field, self.value_in(id, field))))
    }
}
