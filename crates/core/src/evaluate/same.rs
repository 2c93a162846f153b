//! Equality of nodes by their values in the lanes.

use std::cmp::Ordering;

use crate::graph::{ByValue, Column, Flags, Function, Graph, Id, NumberId, View};
use crate::value::{Element, FieldId, Key, Number, Quadratic};

use super::node::in_hash_lanes;
use super::pending::Pending;

/// How deep comparisons of parts are nested.
const DEEPEST: usize = 200;

/// One level of comparisons of parts, which ends also if the comparison is interrupted.
struct Deeper<'g>(&'g Graph);

impl<'g> Deeper<'g> {
    fn new(graph: &'g Graph) -> Self {
        graph.lanes.borrow_mut().depth += 1;
        Self(graph)
    }
}

impl Drop for Deeper<'_> {
    fn drop(&mut self) {
        let mut lanes = self.0.lanes.borrow_mut();
        lanes.depth -= 1;
        if lanes.depth == 0 {
            lanes.compared.clear();
        }
    }
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
    #[inline]
    pub(crate) fn same(&self, a: Id, b: Id) -> bool {
        a == b || self.value(a) == self.value(b) && self.agrees(Pending::Node(a), b, false)
    }

    /// Whether two nodes have opposite values in all lanes.
    #[inline]
    pub(crate) fn opposite_values(&self, a: Id, b: Id) -> bool {
        self.value(a) == -self.value(b) && self.agrees(Pending::Node(a), b, true)
    }

    /// The entry of a table that has the value of a node.
    pub(crate) fn find<'t, T>(&self, table: &'t ByValue<T>, id: Id) -> Option<&'t T> {
        let mut candidates = table.candidates(self.value(id));
        candidates.find(|(known, _)| self.is_found(*known, id, false)).map(|(_, item)| item)
    }

    /// The entry of a table that has the value of a node up to sign, and whether it has the opposite value.
    pub(crate) fn find_up_to_sign<'t, T>(&self, table: &'t ByValue<T>, id: Id) -> Option<(&'t T, bool)> {
        let mut candidates = table.candidates(self.value(id));
        candidates.find_map(|(known, item)| {
            if self.is_found(*known, id, false) {
                return Some((item, false));
            }
            self.is_found(*known, id, true).then_some((item, true))
        })
    }

    /// Whether an entry has the value of a node, or the opposite one.
    ///
    /// A table may have many entries of one fingerprint: all multiples of `Max(0, x)` vanish in the hash lanes if one does.
    /// They are told apart in the lanes in which they have been evaluated, before it is asked how many lanes a comparison
    /// needs.
    #[inline]
    fn is_found(&self, known: Id, id: Id, is_opposite: bool) -> bool {
        if self.flags(id).has(Flags::BRANCH) && self.differ_in_known_lanes(known, id, is_opposite) {
            return false;
        }
        if is_opposite { self.opposite_values(known, id) } else { self.same(known, id) }
    }

    /// Whether two nodes do not have equal, or opposite, values in lanes in which both have been evaluated.
    fn differ_in_known_lanes(&self, a: Id, b: Id, are_opposite: bool) -> bool {
        let lanes = self.lanes.borrow();
        let (Some(column), Some(other)) = (lanes.column(a, 0), lanes.column(b, 0)) else { return false };
        let mut values = FieldId::others(0).zip(column.iter().zip(other.iter()));
        values.any(|(field, (value, other))| *value != signed(field, other, are_opposite))
    }

    /// Whether two nodes have the same value up to the sign.
    #[inline]
    pub(crate) fn same_up_to_sign(&self, a: Id, b: Id) -> bool {
        self.same(a, b) || self.opposite_values(a, b)
    }

    /// Whether what has the fingerprint of a node, or its opposite, has its value in the other lanes as well.
    ///
    /// Where the signs are too many for the lanes, equality is that of the parts.
    #[inline]
    pub(crate) fn agrees(&self, pending: Pending<'_>, id: Id, is_opposite: bool) -> bool {
        !self.flags(id).has(Flags::BRANCH) && !self.branches(pending)
            || self.agrees_in_all_lanes(pending, id, is_opposite)
    }

    fn agrees_in_all_lanes(&self, pending: Pending<'_>, id: Id, is_opposite: bool) -> bool {
        if matches!(pending, Pending::Node(node) if node == id) {
            return !is_opposite;
        }
        if self.shows(pending, id, is_opposite) {
            return true;
        }
        match self.points_for(&self.signs_of_both(pending, id), &[pending.nodes(), vec![id]].concat()) {
            Some(points) => self.has_values_of(pending, id, is_opposite, points),
            None => !is_opposite && self.has_equal_parts_once(pending, id),
        }
    }

    /// Whether something is made of equal parts in the same way as a node. Within one comparison, each pair of nodes is
    /// compared once: conditions that are nested k deep have k^2 pairs.
    fn has_equal_parts_once(&self, pending: Pending<'_>, id: Id) -> bool {
        let Pending::Node(node) = pending else {
            return self.deeper(|| self.has_equal_parts(pending, id));
        };
        if let Some(known) = self.lanes.borrow().compared.get(&(node, id)) {
            return *known;
        }
        self.deeper(|| {
            let verdict = self.has_equal_parts(pending, id);
            self.lanes.borrow_mut().compared.insert((node, id), verdict);
            verdict
        })
    }

    /// The result of a comparison of parts, which is false where they are nested too deep for the stack.
    fn deeper(&self, compare: impl FnOnce() -> bool) -> bool {
        if self.lanes.borrow().depth >= DEEPEST {
            return false;
        }
        let _one_deeper = Deeper::new(self);
        compare()
    }

    /// Whether something is made of equal parts in the same way as a node.
    fn has_equal_parts(&self, pending: Pending<'_>, id: Id) -> bool {
        let equal = |a: Id, b: Id| self.value(a) == self.value(b) && self.same(a, b);
        let every_branch = |args: &[Id], other: Id| {
            args.iter().enumerate().all(|(k, &arg)| (k % 2 == 1 && k + 1 < args.len()) || equal(arg, other))
        };
        match (pending, self.view(id)) {
            (Pending::Function(Function::Piecewise, args), _) if every_branch(args, id) => true,
            (Pending::Node(node), View::Function(Function::Piecewise, args))
                if every_branch(&args.iter().collect::<Vec<_>>(), node) =>
            {
                true
            }
            (Pending::Node(node), view) => match (self.view(node), view) {
                (View::Scale(a, x), View::Scale(b, y)) => a == b && equal(x, y),
                (View::Sum(terms), View::Sum(_)) => {
                    self.has_equal_parts(Pending::Sum(&terms.iter().collect::<Vec<_>>()), id)
                }
                (View::Product(factors), View::Product(_)) => {
                    self.has_equal_parts(Pending::Product(&factors.iter().collect::<Vec<_>>()), id)
                }
                (View::Function(f, args), _) => {
                    self.has_equal_parts(Pending::Function(f, &args.iter().collect::<Vec<_>>()), id)
                }
                (
                    View::Application { name, args, orders },
                    View::Application { name: other, args: others, orders: other_orders },
                ) => {
                    name == other
                        && orders == other_orders
                        && args.len() == others.len()
                        && args.iter().zip(others.iter()).all(|(x, y)| equal(x, y))
                }
                _ => false,
            },
            (Pending::Sum(terms), View::Sum(others)) => {
                terms.len() == others.len()
                    && terms.iter().zip(others.iter()).all(|(&(a, x), (b, y))| a == b && equal(x, y))
            }
            (Pending::Product(factors), View::Product(others)) => {
                factors.len() == others.len()
                    && factors.iter().zip(others.iter()).all(|(&(x, a), (y, b))| a == b && equal(x, y))
            }
            (Pending::Function(f, args), View::Function(g, others)) => {
                f == g
                    && args.len() == others.len()
                    && args.iter().zip(others.iter()).all(|(&x, y)| equal(x, y))
            }
            _ => false,
        }
    }

    /// Whether a node has a value in all lanes.
    pub(super) fn is_everywhere(&self, id: Id, value: impl Fn(FieldId) -> Quadratic) -> bool {
        if !self.branches(Pending::Node(id)) {
            return true;
        }
        let points = self.points_for(&self.signs(id), &[id]);
        points.is_some_and(|points| {
            self.everywhere(Pending::Node(id), points, |field, found| *found == value(field))
        })
    }

    /// Whether something is the number that its fingerprint shows.
    pub(crate) fn is_number_everywhere(&self, pending: Pending<'_>, number: &Number) -> bool {
        if !self.branches(pending) || self.shows_number(pending, number) {
            return true;
        }
        let points = self.points_for(&self.signs_of(pending), &pending.nodes());
        points.is_some_and(|points| {
            self.everywhere(pending, points, |field, value| field.field().is_number(value, number))
        })
    }

    /// Whether a node is a number in all lanes, also if it holds no signs and roots.
    pub(crate) fn has_value_of_number(&self, id: Id, number: &Number) -> bool {
        if self.flags(id).has(Flags::BRANCH) {
            return self.is_number_everywhere(Pending::Node(id), number);
        }
        self.everywhere(Pending::Node(id), 1, |field, value| field.field().is_number(value, number))
    }

    fn everywhere(
        &self,
        pending: Pending<'_>,
        points: u16,
        test: impl Fn(FieldId, &Quadratic) -> bool,
    ) -> bool {
        let agrees = FieldId::HASH.into_iter().all(|field| test(field, &self.pending_in(pending, field)))
            && (0..points).all(|point| {
                let column = self.pending_column(pending, point);
                FieldId::others(point).zip(column.iter()).all(|(field, value)| test(field, value))
            });
        self.lanes.borrow_mut().limit();
        agrees
    }

    /// Whether something has the values of a node, or the opposite ones, in the hash lanes and at some points of the others.
    fn has_values_of(&self, pending: Pending<'_>, id: Id, is_opposite: bool, points: u16) -> bool {
        let agree = |field: FieldId, value: &Quadratic, other: &Quadratic| {
            *value == signed(field, other, is_opposite)
        };
        let agrees = FieldId::HASH
            .into_iter()
            .all(|field| agree(field, &self.pending_in(pending, field), &self.value_in(id, field)))
            && (0..points).all(|point| {
                let (column, other) = (self.pending_column(pending, point), self.column(id, point));
                let values = column.iter().zip(other.iter());
                FieldId::others(point).zip(values).all(|(field, (value, other))| agree(field, value, other))
            });
        self.lanes.borrow_mut().limit();
        agrees
    }

    fn pending_column(&self, pending: Pending<'_>, point: u16) -> Column {
        match pending {
            Pending::Node(id) => self.column(id, point),
            Pending::Sum(terms) => self.column_of_sum(terms.iter().copied(), point),
            Pending::Function(function, args) => {
                FieldId::others(point).map(|field| self.function_in(function, args, field)).collect()
            }
            Pending::Product(factors) => {
                let factors = factors.iter().map(|&(base, e)| (base, self.get_number(e).clone()));
                self.column_of_product(factors, point)
            }
        }
    }

    #[inline]
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

    /// Two words that tell nodes of different values apart: the fingerprint, or a digest of the values in all lanes for what
    /// holds signs or roots.
    ///
    /// Equal nodes have equal words, unless one of them holds signs or roots that cancel.
    #[must_use]
    pub fn digest(&self, id: Id) -> [u64; 2] {
        let words = self.value(id).words();
        if !self.flags(id).has(Flags::BRANCH) {
            return words;
        }
        let start = Key::new("digest").word(words[0]).word(words[1]);
        let key = self
            .column(id, 0)
            .iter()
            .fold(start, |key, value| value.words().iter().fold(key, |key, &word| key.word(word)));
        self.lanes.borrow_mut().limit();
        [key.draw(0), key.draw(1)]
    }

    /// The fingerprint of a product, before its node is made.
    pub(crate) fn product_fingerprint(&self, factors: &[(Id, NumberId)]) -> Element {
        self.rational_fingerprint(factors)
            .unwrap_or_else(|| in_hash_lanes(|field| self.pending_in(Pending::Product(factors), field)))
    }

    /// The product of fingerprints, if it is that of the product: of integer powers of what holds no signs and roots.
    fn rational_fingerprint(&self, factors: &[(Id, NumberId)]) -> Option<Element> {
        factors.iter().try_fold(Element::ONE, |product, &(base, exponent)| {
            if self.flags(base).has(Flags::BRANCH) {
                return None;
            }
            let value = self.value(base);
            let is_plain = exponent == NumberId::ONE;
            Some(product * if is_plain { value } else { value.powi(self.get_number(exponent).to_i64()?) })
        })
    }

    /// A canonical order by value up to sign: equal and opposite values are equal in it, and seldom others.
    pub(crate) fn compare_values(&self, a: Id, b: Id) -> Ordering {
        let ((key_a, negated_a), (key_b, negated_b)) = (self.value(a).unsigned(), self.value(b).unsigned());
        let by_fingerprint = key_a.cmp(&key_b);
        let branches = |id: Id| self.flags(id).has(Flags::BRANCH);
        if by_fingerprint.is_ne() || a == b || !branches(a) && !branches(b) {
            return by_fingerprint;
        }
        let signed = |id: Id, negated: bool, field: FieldId| {
            let value = self.value_in(id, field);
            if negated { field.field().neg(&value) } else { value }
        };
        FieldId::HASH
            .into_iter()
            .chain(FieldId::others(0))
            .map(|field| signed(a, negated_a, field).words().cmp(&signed(b, negated_b, field).words()))
            .find(|order| order.is_ne())
            .unwrap_or(Ordering::Equal)
    }
}

/// A value, or the opposite one.
fn signed(field: FieldId, value: &Quadratic, is_opposite: bool) -> Quadratic {
    if is_opposite { field.field().neg(value) } else { value.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::graph::{Assumption, Function};

    #[test]
    fn signs_differ_from_lane_to_lane() -> Result<(), Error> {
        let g = &mut Graph::new();
        let x = g.symbol("x", Assumption::Real);
        let sign = g.apply(Function::Sign, &[x])?;
        let positive =
            FieldId::others(0).filter(|&field| g.value_in(sign, field) == field.field().one()).count();
        assert!((16..48).contains(&positive), "{positive} of 62");
        for sign in [sign, g.neg(sign)] {
            let sum = g.add(sign, Id::ONE);
            assert!(g.as_number(sum).is_none(), "{:?}", g.flags(sign));
        }
        Ok(())
    }
}
