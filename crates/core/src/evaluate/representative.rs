//! Representatives: of all nodes of one value, functions are evaluated for the one that was met first.
//!
//! The law says that f(A) = f(B) if A = B. But the value of f(u) takes more than the value of u in the first field of a
//! lane: the values of u in the fields of the tower above it, its content, the multiple of pi in it. Most of these are
//! functions of the value, whatever the form, but the towers end, and some roots are drawn. So all nodes that are
//! equal form a class, and the first one for which a value was asked stands for the class from then on: f(A) and f(B) are
//! f(R), at every depth, because the functions inside R are built on representatives as well. R is equal to A as
//! mathematics, so nothing false can come of it. Where forms of a class disagree in a field above the first, the value
//! of f(u) depends on which form was met first in the process, and addition theorems may be missed.
//!
//! A node enters its class after all nodes below it, so a representative never is evaluated by way of itself.

use crate::graph::{Graph, Id, Ids, Standing, View, children_first};

impl Graph {
    /// The node that stands for all nodes of the value of this one.
    pub(crate) fn representative(&self, id: Id) -> Id {
        self.standing(id).equal
    }

    /// The node that stands for all nodes of the value of this one, or of the opposite value, and whether its value is
    /// the opposite one.
    pub(super) fn representative_up_to_sign(&self, id: Id) -> (Id, bool) {
        let Standing { first, is_opposite, .. } = self.standing(id);
        (first, is_opposite)
    }

    /// The nodes from whose values that of a node is found: those that stand for the arguments of functions and for the
    /// bases of roots, and other children.
    pub(super) fn push_parts(&self, id: Id, out: &mut Vec<Id>) {
        match self.view(id) {
            View::Application { args, .. } | View::Function(_, args) => out.extend(self.represented(args)),
            View::Product(factors) => out.extend(factors.iter().map(|(base, exponent)| {
                if self.get_number(exponent).is_integer() { base } else { self.representative(base) }
            })),
            _ => self.push_children(id, out),
        }
    }

    /// The parts below the roots, parts before what is made of them, each once, without nodes that fail the test.
    pub(super) fn parts_first(&self, roots: &[Id], enter: impl Fn(Id) -> bool) -> Vec<Id> {
        children_first(roots, |id, out| self.push_parts(id, out), enter)
    }

    /// The nodes that stand for the arguments of a function.
    pub(super) fn represented(&self, args: Ids<'_>) -> impl Iterator<Item = Id> {
        args.iter().map(|arg| self.representative(arg))
    }

    fn standing(&self, id: Id) -> Standing {
        let known = |id: Id| self.representatives.borrow().standing(id);
        if let Some(standing) = known(id) {
            return standing;
        }
        for node in self.post_order_where(&[id], |id| known(id).is_none()) {
            if known(node).is_none() {
                self.enter_class(node);
            }
        }
        known(id).expect("the node has just entered a class")
    }

    fn enter_class(&self, id: Id) {
        let value = self.value(id);
        let candidates = self.representatives.borrow().candidates(value);
        let found = candidates.into_iter().find_map(|first| {
            if self.equal(first, id) {
                return Some((first, false));
            }
            self.opposite_numbers_or_nodes(first, id).then_some((first, true))
        });
        let mut representatives = self.representatives.borrow_mut();
        match found {
            Some((first, is_opposite)) => representatives.join(id, first, is_opposite),
            None => representatives.begin(id, value),
        }
    }

    fn opposite_numbers_or_nodes(&self, a: Id, b: Id) -> bool {
        match (self.as_number(a), self.as_number(b)) {
            (Some(x), Some(y)) => x.neg().same_value(y),
            _ => self.opposite_values(a, b),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::graph::{Assumption, Function, NumberId};
    use crate::value::Number;

    /// sin(2 x) and 2 sin(x) cos(x).
    fn double_angle(g: &mut Graph) -> Result<[Id; 2], Error> {
        let x = g.symbol("x", Assumption::Real);
        let two = g.number_id(&Number::integer(2));
        let twice = g.scale(two, x);
        let one = g.apply(Function::Sin, &[twice])?;
        let [sin, cos] = [g.apply(Function::Sin, &[x])?, g.apply(Function::Cos, &[x])?];
        let product = g.mul(sin, cos)?;
        Ok([one, g.scale(two, product)])
    }

    #[test]
    fn equal_nodes_stay_equal_at_every_depth() -> Result<(), Error> {
        for order in [[0, 1], [1, 0]] {
            let g = &mut Graph::new();
            let forms = double_angle(g)?;
            let mut nested = order.map(|k| forms[k]);
            for function in [Function::Sin, Function::Exp, Function::Abs, Function::Cos, Function::Tanh] {
                nested = [g.apply(function, &[nested[0]])?, g.apply(function, &[nested[1]])?];
                assert!(g.equal(nested[0], nested[1]), "{function:?}");
            }
        }
        Ok(())
    }

    #[test]
    fn opposite_nodes_are_of_one_class() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [one, two] = double_angle(g)?;
        let opposite = g.scale(NumberId::MINUS_ONE, two);
        assert_eq!(g.representative_up_to_sign(opposite), (opposite, false));
        assert_eq!(g.representative_up_to_sign(one), (opposite, true));
        assert_eq!(g.representative(one), g.representative(two));
        Ok(())
    }
}
