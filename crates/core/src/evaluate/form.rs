//! Equality that forms show, so that no values in lanes are needed: products of the same factors, sums of the same terms,
//! the same function of the same arguments.
//!
//! Numbers and nesting are looked through, and nodes that are in one class by now are the same. What the forms do not show
//! may be equal all the same.

use crate::graph::{Flags, Function, Graph, Id, Kind, NumberId, View};
use crate::value::Number;

use super::pending::Pending;

/// Longer sums and products are not opened.
const MOST_PARTS: usize = 256;

/// How many levels of sums inside sums are opened.
const DEEPEST: usize = 8;

impl Graph {
    /// Whether the form of something shows that it is the node, or the opposite of the node, that has its fingerprint.
    pub(super) fn shows(&self, pending: Pending<'_>, id: Id, is_opposite: bool) -> bool {
        match pending {
            Pending::Product(factors) => {
                self.opened_product(factors).is_some_and(|(coefficient, factors)| {
                    let other = self.opened_product(&[(id, NumberId::ONE)]);
                    let signed = if is_opposite { coefficient.neg() } else { coefficient };
                    other.is_some_and(|(number, others)| factors == others && signed.same_value(&number))
                })
            }
            Pending::Sum(terms) => {
                let sign = Number::integer(if is_opposite { 1 } else { -1 });
                self.cancels(terms, (id, sign))
            }
            Pending::Node(node) => match self.view(node) {
                View::Sum(_) => self.shows(Pending::Sum(&[(NumberId::ONE, node)]), id, is_opposite),
                View::Product(_) | View::Scale(..) => {
                    self.shows(Pending::Product(&[(node, NumberId::ONE)]), id, is_opposite)
                }
                View::Function(function, args) => {
                    !is_opposite && self.is_function_of_known(function, args.iter(), id)
                }
                View::Application { name, args, orders } => match self.view(id) {
                    View::Application { name: other, args: others, orders: other_orders } => {
                        !is_opposite
                            && name == other
                            && orders == other_orders
                            && self.are_known_equal(args.iter(), others.iter())
                    }
                    _ => false,
                },
                _ => false,
            },
            Pending::Function(function, args) => {
                !is_opposite && self.is_function_of_known(function, args.iter().copied(), id)
            }
        }
    }

    /// Whether a node is this function of arguments that are known to be equal to these: their representatives are the same.
    fn is_function_of_known(&self, function: Function, args: impl Iterator<Item = Id>, id: Id) -> bool {
        match self.view(id) {
            View::Function(other, others) => function == other && self.are_known_equal(args, others.iter()),
            _ => false,
        }
    }

    fn are_known_equal(&self, args: impl Iterator<Item = Id>, others: impl Iterator<Item = Id>) -> bool {
        args.map(|id| self.known_equal(id)).eq(others.map(|id| self.known_equal(id)))
    }

    /// The node that stands for this one, if it is in a class by now, or the node itself.
    fn known_equal(&self, id: Id) -> Id {
        self.representatives.borrow().standing(id).map_or(id, |standing| standing.equal)
    }

    /// The same up to sign.
    fn known_up_to_sign(&self, id: Id) -> (Id, bool) {
        match self.representatives.borrow().standing(id) {
            Some(standing) => (standing.first, standing.is_opposite),
            None => (id, false),
        }
    }

    /// Whether the form of something shows that it is the number that its fingerprint shows.
    pub(super) fn shows_number(&self, pending: Pending<'_>, number: &Number) -> bool {
        match pending {
            Pending::Product(factors) => number.is_zero() && factors.contains(&(Id::ZERO, NumberId::ONE)),
            Pending::Sum(terms) => self.cancels(terms, (Id::ONE, number.neg())),
            Pending::Node(_) | Pending::Function(..) => false,
        }
    }

    /// The coefficient and the other factors of a product, in order, with those of products inside it.
    fn opened_product(&self, factors: &[(Id, NumberId)]) -> Option<(Number, Vec<(Id, NumberId)>)> {
        let mut coefficient = Number::integer(1);
        let (mut waiting, mut opened) = (factors.to_vec(), Vec::new());
        while let Some((base, exponent)) = waiting.pop() {
            match self.view(base) {
                View::Number(number) if exponent == NumberId::ONE => {
                    coefficient = coefficient.mul(self.get_number(number));
                }
                View::Scale(number, child) if exponent == NumberId::ONE => {
                    coefficient = coefficient.mul(self.get_number(number));
                    waiting.push((child, exponent));
                }
                View::Product(inner) if exponent == NumberId::ONE => waiting.extend(inner.iter()),
                _ => match self.known_power(base, exponent) {
                    (known, is_opposite) if known != base || is_opposite => {
                        waiting.push((known, exponent));
                        if is_opposite {
                            coefficient = coefficient.neg();
                        }
                    }
                    _ => opened.push((base, exponent)),
                },
            }
            if waiting.len() + opened.len() > MOST_PARTS {
                return None;
            }
        }
        opened.sort_unstable_by_key(|&(base, exponent)| (base, exponent.0));
        Some((coefficient, opened))
    }

    /// The base of which this power, or the opposite of this power, is known to be one with the same exponent.
    fn known_power(&self, base: Id, exponent: NumberId) -> (Id, bool) {
        let number = self.get_number(exponent);
        if !self.flags(base).has(Flags::BRANCH) {
            return (base, false);
        }
        if !number.is_integer() {
            return (self.known_equal(base), false);
        }
        let (first, is_opposite) = self.known_up_to_sign(base);
        (first, is_opposite && !number.is_even())
    }

    /// Whether terms and one more, whose sum has the fingerprint of zero, cancel.
    ///
    /// Sums inside are opened, one level after the other, until no signs and roots are left: then the fingerprint decides.
    fn cancels(&self, terms: &[(NumberId, Id)], last: (Id, Number)) -> bool {
        let branches = |id: Id| self.flags(id).has(Flags::BRANCH);
        let opens = |id: Id| branches(id) && self.kind(id) == Kind::Sum;
        let terms = terms.iter().map(|&(factor, id)| (id, self.get_number(factor).clone()));
        let mut terms = self.merged(terms.chain([last]));
        for _ in 0..DEEPEST {
            if terms.len() > MOST_PARTS || !terms.iter().any(|&(id, _)| opens(id)) {
                break;
            }
            let mut opened = Vec::new();
            for (id, factor) in terms {
                match self.view(id) {
                    View::Sum(inner) if opens(id) => {
                        opened.extend(inner.iter().map(|(c, node)| (node, self.get_number(c).mul(&factor))));
                    }
                    _ => opened.push((id, factor)),
                }
            }
            terms = self.merged(opened.into_iter());
        }
        !terms.iter().any(|&(id, _)| branches(id))
    }

    /// The terms as multiples of different nodes; numbers are multiples of the node 1.
    fn merged(&self, terms: impl Iterator<Item = (Id, Number)>) -> Vec<(Id, Number)> {
        let plain = |(id, factor): (Id, Number)| match self.view(id) {
            View::Number(number) => (Id::ONE, self.get_number(number).mul(&factor)),
            View::Scale(number, child) => (child, self.get_number(number).mul(&factor)),
            _ => (id, factor),
        };
        let known = |(id, factor): (Id, Number)| match self.known_up_to_sign(id) {
            (first, true) => plain((first, factor.neg())),
            (first, false) => plain((first, factor)),
        };
        let mut terms: Vec<(Id, Number)> = terms.map(plain).map(known).collect();
        terms.sort_by_key(|&(id, _)| id);
        terms.dedup_by(|(id, factor), (kept, total)| {
            let is_same = id == kept;
            if is_same {
                *total = total.add(factor);
            }
            is_same
        });
        terms.retain(|(_, total)| !total.is_zero());
        terms
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::graph::Assumption;

    #[test]
    fn order_nesting_signs_and_zeros_are_looked_through() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [x, y, z] = ["x", "y", "z"].map(|name| g.symbol(name, Assumption::Real));
        let modulus = g.apply(Function::Abs, &[x])?;
        let one = NumberId::ONE;
        let product = g.mul(modulus, y)?;
        let opposite = g.neg(product);
        let larger = g.mul(product, z)?;
        assert!(g.shows(Pending::Product(&[(z, one), (opposite, one)]), larger, true));
        assert!(!g.shows(Pending::Product(&[(z, one), (opposite, one)]), larger, false));
        assert!(!g.shows(Pending::Product(&[(x, one), (product, one)]), larger, false));
        assert!(g.shows(Pending::Node(opposite), product, true));
        let (sum, nested) = (g.add(product, z), g.add(product, y));
        let nested = g.add(nested, z);
        let terms = [(one, y), (one, Id::ZERO), (one, sum)];
        assert!(g.shows(Pending::Sum(&terms), nested, false));
        assert!(!g.shows(Pending::Sum(&terms), nested, true));
        let zero = Number::integer(0);
        assert!(g.shows_number(Pending::Sum(&[(one, product), (one, opposite)]), &zero));
        assert!(!g.shows_number(Pending::Sum(&[(one, product), (one, product)]), &zero));
        assert!(g.shows_number(Pending::Product(&[(modulus, one), (Id::ZERO, one)]), &zero));
        Ok(())
    }

    #[test]
    fn functions_of_what_is_in_one_class_are_one() -> Result<(), Error> {
        let g = &mut Graph::new();
        let x = g.symbol("x", Assumption::Real);
        let square = |g: &mut Graph, id: Id| g.pow_number(id, &Number::integer(2));
        let modulus = g.apply(Function::Abs, &[x])?;
        let sum = g.add(modulus, Id::ONE);
        let (squared, two, one) = (square(g, x)?, g.number_id(&Number::integer(2)), NumberId::ONE);
        let forms = [square(g, sum)?, g.sum(&[(one, squared), (two, modulus), (one, Id::ONE)])];
        let [first, second] = forms.map(|form| g.apply(Function::Sin, &[form]));
        let (first, second) = (first?, second?);
        assert!(g.shows(Pending::Node(first), second, false));
        assert!(g.shows(Pending::Function(Function::Sin, &[forms[0]]), second, false));
        assert!(!g.shows(Pending::Node(first), second, true));
        let other = g.apply(Function::Sin, &[sum])?;
        assert!(!g.shows(Pending::Node(first), other, false));
        Ok(())
    }
}
