//! The door into the graph: every new row of a sum, product or function passes here.

use crate::evaluate::Pending;
use crate::graph::{Flags, Function, Graph, Id, Kind, NumberId};
use crate::value::{Element, Number};

use super::adopt::Match;

impl Graph {
    /// Enter a row: a value that is a plain number, or that the derivation knows, gives the known node.
    pub(crate) fn finish(&mut self, kind: Kind, flags: Flags, words: &[u32], value: Element) -> Id {
        if kind == Kind::Function(Function::Piecewise) {
            // It may differ from what has its value at the corners, and be written so that it is accurate everywhere.
            let id = self.intern(kind, flags, words, value);
            self.remember(id);
            return id;
        }
        let number = self.number_shown(flags, value);
        if !flags.has(Flags::BRANCH) {
            if let Some(number) = number {
                return self.number_node(number);
            }
            match self.plain_match(value) {
                Match::Known(known, negated) => return if negated { self.opposite(known) } else { known },
                Match::None => {
                    let id = self.intern(kind, flags, words, value);
                    self.remember_new(id, value);
                    return id;
                }
                Match::Branching => {}
            }
        }
        // Only a row has values in other lanes. It stays unused if there is another node of its value.
        let id = self.intern(kind, flags, words, value);
        if let Some(known) = self.classes.as_ref().and_then(|classes| classes.representative(id)) {
            return known;
        }
        let number =
            number.filter(|&number| self.is_number_everywhere(Pending::Node(id), self.get_number(number)));
        if let Some(number) = number {
            return self.number_node(number);
        }
        if let Some(known) = self.known_value(value, Pending::Node(id)) {
            return known;
        }
        self.remember(id);
        id
    }

    /// The number that a fingerprint shows, if it is a simple one.
    ///
    /// Outside of derivations, and for constants, any simple number is recognised.
    fn number_shown(&mut self, flags: Flags, value: Element) -> Option<NumberId> {
        let (unsigned, negated) = value.unsigned();
        if value.is_zero() {
            return Some(self.number_id(&Number::integer(0)));
        }
        if let Some(&number) = self.plain_values.get(&unsigned) {
            return Some(if negated { self.negated(number) } else { number });
        }
        if self.classes.is_some() && !flags.has(Flags::CONSTANT) {
            return None;
        }
        let number = value.to_simple_rational()?;
        Some(self.number_id(&number))
    }

    pub(super) fn joined_flags(&self, ids: impl Iterator<Item = Id>) -> Flags {
        ids.map(|id| self.flags(id)).reduce(Flags::join).unwrap_or_default()
    }

    pub(crate) fn negated(&mut self, number: NumberId) -> NumberId {
        let opposite = self.get_number(number).neg();
        self.number_id(&opposite)
    }

    pub(crate) fn times(&mut self, a: NumberId, b: NumberId) -> NumberId {
        let product = self.get_number(a).mul(self.get_number(b));
        self.number_id(&product)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::graph::Assumption;

    fn symbols(graph: &mut Graph) -> (Id, Id, Id) {
        let mut symbol = |name| graph.symbol(name, Assumption::Real);
        (symbol("a"), symbol("b"), symbol("c"))
    }

    #[test]
    fn zero_is_seen_when_it_is_made() -> Result<(), Error> {
        let g = &mut Graph::new();
        let (a, b, _) = symbols(g);
        let sum = g.add(a, b);
        let back = g.sub(sum, b);
        assert_eq!(back, a);
        assert_eq!(g.sub(back, a), Id::ZERO);
        let (s, c) = (g.apply(Function::Sin, &[a])?, g.apply(Function::Cos, &[a])?);
        let (s2, c2) = (g.mul(s, s)?, g.mul(c, c)?);
        assert_eq!(g.add(s2, c2), Id::ONE);
        Ok(())
    }

    #[test]
    fn division_by_a_hidden_zero_is_an_error() {
        let g = &mut Graph::new();
        let (a, b, _) = symbols(g);
        let sum = g.add(a, b);
        let difference = g.sub(sum, a);
        let zero = g.sub(difference, b);
        assert!(matches!(g.div(a, zero), Err(Error::DivisionByZero(_))));
    }

    #[test]
    fn roots_keep_their_branch() -> Result<(), Error> {
        let g = &mut Graph::new();
        let (a, b, _) = symbols(g);
        let square = g.mul(a, a)?;
        let root = g.sqrt(square)?;
        assert!(!g.equal(root, a));
        assert_eq!(g.mul(root, root)?, square);
        let root = g.sqrt(a)?;
        let product = g.mul(root, b)?;
        let product = g.mul(product, root)?;
        let expected = g.mul(a, b)?;
        assert!(g.equal(product, expected));
        Ok(())
    }

    #[test]
    fn a_derivation_returns_the_node_that_has_the_value() -> Result<(), Error> {
        let g = &mut Graph::new();
        let (a, b, c) = symbols(g);
        g.enter(Box::default());
        let sum = g.add(b, c);
        let short = g.mul(a, sum)?;
        let (ab, ac) = (g.mul(a, b)?, g.mul(a, c)?);
        let long = g.add(ab, ac);
        assert_eq!(short, long);
        let opposite = g.neg(ab);
        let difference = g.sub(opposite, ac);
        assert_eq!(difference, g.neg(short));
        g.leave();
        Ok(())
    }
}
