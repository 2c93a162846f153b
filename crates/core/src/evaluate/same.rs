//! Equality of nodes by their values in the lanes.

use std::cmp::Ordering;

use crate::graph::{Column, Flags, Function, Graph, Id, NumberId};
use crate::value::{Element, FieldId, Number, Quadratic};

use super::node::in_hash_lanes;

/// Something with a value: a node, or a sum or product of nodes that has none yet.
#[derive(Clone, Copy)]
pub(crate) enum Pending<'a> {
    Node(Id),
    Sum(&'a [(NumberId, Id)]),
    Product(&'a [(Id, NumberId)]),
    Function(Function, &'a [Id]),
}

impl Graph {
    /// Whether two nodes are equal as mathematics. Numbers are compared digit by digit.
    #[must_use]
    pub fn equal(&self, a: Id, b: Id) -> bool {
        match (self.as_number(a), self.as_number(b)) {
            (Some(x), Some(y)) => x.same_value(y),
            _ => self.same(a, b),
        }
    }

    /// Whether something equal to `part` is below the node (or is the node).
    #[must_use]
    pub fn has(&self, id: Id, part: Id) -> bool {
        self.post_order(&[id]).into_iter().any(|node| self.same(node, part))
    }

    /// Whether two nodes have the same value in all lanes.
    pub(crate) fn same(&self, a: Id, b: Id) -> bool {
        a == b || self.value(a) == self.value(b) && self.agrees(Pending::Node(a), b, false)
    }

    /// Whether two nodes have opposite values in all lanes.
    pub(crate) fn opposite_values(&self, a: Id, b: Id) -> bool {
        self.value(a) == -self.value(b) && self.agrees(Pending::Node(a), b, true)
    }

    /// Whether two nodes have the same value up to the sign.
    pub(crate) fn same_up_to_sign(&self, a: Id, b: Id) -> bool {
        self.same(a, b) || self.opposite_values(a, b)
    }

    /// Whether what has the fingerprint of a node, or its opposite, has its value in the other lanes as well.
    pub(crate) fn agrees(&self, pending: Pending<'_>, id: Id, is_opposite: bool) -> bool {
        if !self.branches(pending) && !self.flags(id).has(Flags::BRANCH) {
            return true;
        }
        if matches!(pending, Pending::Node(node) if node == id) {
            return !is_opposite;
        }
        self.everywhere(pending, |field, value| {
            let other = self.value_in(id, field);
            *value == if is_opposite { field.field().neg(&other) } else { other }
        })
    }

    /// Whether a node has a value in all lanes.
    pub(super) fn is_everywhere(&self, id: Id, value: impl Fn(FieldId) -> Quadratic) -> bool {
        !self.branches(Pending::Node(id))
            || self.everywhere(Pending::Node(id), |field, found| *found == value(field))
    }

    /// The number that something is, given the number that its fingerprint shows.
    pub(crate) fn is_number_everywhere(&self, pending: Pending<'_>, number: &Number) -> bool {
        !self.branches(pending)
            || self.everywhere(pending, |field, value| field.field().is_number(value, number))
    }

    fn everywhere(&self, pending: Pending<'_>, test: impl Fn(FieldId, &Quadratic) -> bool) -> bool {
        let agrees = FieldId::HASH.into_iter().all(|field| test(field, &self.pending_in(pending, field)))
            && {
                let column = self.pending_column(pending);
                FieldId::others().zip(column.iter()).all(|(field, value)| test(field, value))
            };
        self.lanes.borrow_mut().limit();
        agrees
    }

    fn pending_column(&self, pending: Pending<'_>) -> Column {
        match pending {
            Pending::Node(id) => self.column(id),
            Pending::Sum(terms) => self.column_of_sum(terms.iter().copied()),
            Pending::Function(function, args) => {
                FieldId::others().map(|field| self.function_in(function, args, field)).collect()
            }
            Pending::Product(factors) => self.column_of_product(
                factors.iter().map(|&(base, exponent)| (base, self.get_number(exponent).clone())),
            ),
        }
    }

    fn branches(&self, pending: Pending<'_>) -> bool {
        let branches = |id: Id| self.flags(id).has(Flags::BRANCH);
        match pending {
            Pending::Node(id) => branches(id),
            Pending::Sum(terms) => terms.iter().any(|&(_, id)| branches(id)),
            Pending::Function(_, args) => args.iter().any(|&arg| branches(arg)),
            Pending::Product(factors) => factors.iter().any(|&(base, exponent)| {
                branches(base) || self.is_branching(base, self.get_number(exponent))
            }),
        }
    }

    fn pending_in(&self, pending: Pending<'_>, field: FieldId) -> Quadratic {
        match pending {
            Pending::Node(id) => self.value_in(id, field),
            Pending::Sum(terms) => self.sum_in(terms.iter().copied(), field),
            Pending::Function(function, args) => self.function_in(function, args, field),
            Pending::Product(factors) => self.product_in(
                factors.iter().map(|&(base, exponent)| (base, self.get_number(exponent).clone())),
                field,
            ),
        }
    }

    /// The fingerprint of a product, before its node is made.
    pub(crate) fn product_fingerprint(&self, factors: &[(Id, NumberId)]) -> Element {
        let is_rational = |&(base, exponent): &(Id, NumberId)| {
            self.get_number(exponent).is_integer() && !self.flags(base).has(Flags::BRANCH)
        };
        if factors.iter().all(is_rational)
            && let Some(value) = self.rational_fingerprint(factors)
        {
            return value;
        }
        in_hash_lanes(|field| self.pending_in(Pending::Product(factors), field))
    }

    fn rational_fingerprint(&self, factors: &[(Id, NumberId)]) -> Option<Element> {
        factors.iter().try_fold(Element::ONE, |product, &(base, exponent)| {
            Some(product * self.value(base).powi(self.get_number(exponent).to_i64()?))
        })
    }

    /// A canonical order by value up to sign: equal and opposite values are equal in it.
    pub(crate) fn compare_values(&self, a: Id, b: Id) -> Ordering {
        let ((key_a, negated_a), (key_b, negated_b)) = (self.value(a).unsigned(), self.value(b).unsigned());
        let plain = !self.flags(a).has(Flags::BRANCH) && !self.flags(b).has(Flags::BRANCH);
        let by_fingerprint = key_a.cmp(&key_b);
        if by_fingerprint.is_ne() || plain || a == b {
            return by_fingerprint;
        }
        let signed = |id: Id, negated: bool, field: FieldId| {
            let value = self.value_in(id, field);
            if negated { field.field().neg(&value) } else { value }
        };
        FieldId::HASH
            .into_iter()
            .chain(FieldId::others())
            .map(|field| signed(a, negated_a, field).words().cmp(signed(b, negated_b, field).words()))
            .find(|order| order.is_ne())
            .unwrap_or(Ordering::Equal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::graph::Assumption;

    #[test]
    fn signs_differ_from_lane_to_lane() -> Result<(), Error> {
        let g = &mut Graph::new();
        let x = g.symbol("x", Assumption::Real);
        let sign = g.apply(Function::Sign, &[x])?;
        let positive =
            FieldId::others().filter(|&field| g.value_in(sign, field) == field.field().one()).count();
        assert!((16..48).contains(&positive), "{positive} of 62");
        for sign in [sign, g.neg(sign)] {
            let sum = g.add(sign, Id::ONE);
            assert!(g.as_number(sum).is_none(), "{:?}", g.flags(sign));
        }
        Ok(())
    }
}
