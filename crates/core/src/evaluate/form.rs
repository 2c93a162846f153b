//! Equality that forms show, so that no values in lanes are needed: products of the same factors, sums of the same terms.
//!
//! Numbers and nesting are looked through. What the forms do not show may be equal all the same.

use crate::graph::{Flags, Graph, Id, Kind, NumberId, View};
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
                _ => false,
            },
            Pending::Function(..) => false,
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
                _ => opened.push((base, exponent)),
            }
            if waiting.len() + opened.len() > MOST_PARTS {
                return None;
            }
        }
        opened.sort_unstable_by_key(|&(base, exponent)| (base, exponent.0));
        Some((coefficient, opened))
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
        let mut terms: Vec<(Id, Number)> = terms.map(plain).collect();
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
    use crate::graph::{Assumption, Function};

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
}
