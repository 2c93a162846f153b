//! Differences of squares of sines and cosines as sums: `1 - sin(x)**2 cos(y)**2 = sin(y)**2 + cos(x)**2 cos(y)**2`.
//! A moment of inertia about an axis is a sum of squares of distances from it.

use crate::error::Error;
use crate::graph::Function;
use crate::polynomial::{Monomial, Polynomial};
use crate::value::Number;

use crate::rewrite::ring::Ring;

/// The most differences that are resolved.
const STEPS: usize = 12;

impl Ring<'_> {
    /// The polynomial in which no square of a wave is subtracted from the term that it is a part of. None if there is no
    /// such difference.
    pub(super) fn with_squares_only(&mut self, polynomial: &Polynomial) -> Result<Option<Polynomial>, Error> {
        let mut made = polynomial.clone();
        for _ in 0..STEPS {
            let Some(sum) = self.difference_as_sum(&made)? else { break };
            made = sum;
        }
        Ok((made != *polynomial).then_some(made))
    }

    /// The polynomial without its first difference of squares.
    fn difference_as_sum(&mut self, polynomial: &Polynomial) -> Result<Option<Polynomial>, Error> {
        let negatives: Vec<(Monomial, Number)> = polynomial
            .iter()
            .filter(|(_, coefficient)| coefficient.is_negative())
            .map(|(monomial, coefficient)| (monomial.clone(), coefficient.neg()))
            .collect();
        for (monomial, size) in negatives {
            let squares = self.squares_in(&monomial);
            for chosen in selections(&squares) {
                let whole =
                    chosen.iter().fold(monomial.clone(), |m, &atom| m.over(&Monomial::power(atom, 2)));
                if polynomial.coefficient(&whole).is_some_and(|c| !c.sub(&size).is_negative()) {
                    return Ok(Some(self.split(polynomial, whole, &chosen, &size)?));
                }
            }
        }
        Ok(None)
    }

    /// Write k P for k P (1 - a**2 b**2) as k P (a'**2 + a**2 b'**2), where a' is the other wave of the angle of a.
    fn split(
        &mut self,
        polynomial: &Polynomial,
        whole: Monomial,
        squares: &[u32],
        size: &Number,
    ) -> Result<Polynomial, Error> {
        let mut made = polynomial.clone();
        made.add_term(whole.clone(), &size.neg());
        let mut product = whole;
        for &atom in squares {
            made.add_term(product.times(&Monomial::power(self.other_wave(atom)?, 2)), size);
            product = product.times(&Monomial::power(atom, 2));
        }
        made.add_term(product, size);
        Ok(made)
    }

    /// The waves whose squares are factors.
    fn squares_in(&self, monomial: &Monomial) -> Vec<u32> {
        let is_square = |&&(atom, exponent): &&(u32, i64)| exponent == 2 && self.wave(atom).is_some();
        monomial.factors().iter().filter(is_square).map(|&(atom, _)| atom).collect()
    }

    /// The cosine of the angle of a sine, and the sine of that of a cosine.
    fn other_wave(&mut self, atom: u32) -> Result<u32, Error> {
        let (shape, angle) = self.wave(atom).expect("the atom is a sine or cosine");
        let other = if shape == Function::Sin { Function::Cos } else { Function::Sin };
        let node = self.graph.apply(other, &[angle])?;
        Ok(self.atom(node).0)
    }
}

/// Each atom, then each pair in both orders.
fn selections(atoms: &[u32]) -> Vec<Vec<u32>> {
    let single = atoms.iter().map(|&atom| vec![atom]);
    let pairs = atoms.iter().flat_map(|&a| atoms.iter().filter(move |&&b| a != b).map(move |&b| vec![a, b]));
    single.chain(pairs).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Assumption, Graph, NumberId};
    use crate::polynomial::Budget;
    use crate::rewrite::expand::Opening;

    #[test]
    fn a_difference_of_squares_is_a_sum() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [x, y] = ["x", "y"].map(|name| g.symbol(name, Assumption::Real));
        let (sin, cos) = (g.apply(Function::Sin, &[x])?, g.apply(Function::Cos, &[y])?);
        let two = g.number_id(&Number::integer(2));
        let product = g.product(&[(sin, two), (cos, two)])?;
        let one = g.number(&Number::integer(1));
        let difference = g.sum(&[(NumberId::ONE, one), (NumberId::MINUS_ONE, product)]);
        let mut ring = Ring::new(g, Budget::new(100, 1000));
        let polynomial = ring.polynomial(difference, Opening::Products)?;
        let sum = ring.with_squares_only(&polynomial)?.expect("there is a difference");
        assert!(sum.len() == 2 && sum.iter().all(|(_, coefficient)| !coefficient.is_negative()));
        let node = ring.node_of(&sum)?;
        assert!(g.equal(node, difference));
        Ok(())
    }
}
