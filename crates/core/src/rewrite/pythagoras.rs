//! The identity sin(u)**2 + cos(u)**2 = 1, applied in either direction.

use crate::error::Error;
use crate::polynomial::{Monomial, Polynomial};
use crate::value::Number;

use super::ring::Ring;

/// Higher powers stay unchanged.
const LARGEST_POWER: i64 = 32;

/// The sine and the cosine of one angle, as atoms.
pub(crate) type Pair = (u32, u32);

impl Ring<'_> {
    /// Replace `from`**2 by 1 - `to`**2 wherever it occurs.
    pub(crate) fn eliminate(&mut self, p: &Polynomial, from: u32, to: u32) -> Result<Polynomial, Error> {
        let mut square = Polynomial::constant(Number::integer(1));
        square.add_term(Monomial::power(to, 2), &Number::integer(-1));
        let mut result = Polynomial::default();
        for (monomial, coefficient) in p.iter() {
            let exponent = monomial.exponent(from);
            let term = Polynomial::term(monomial.clone(), coefficient.clone());
            if !(2..=LARGEST_POWER).contains(&exponent) {
                result.add_scaled(&term, &Number::integer(1));
                continue;
            }
            let half = exponent / 2;
            let power = self.power(&square, half.unsigned_abs())?;
            let lowered = term.shifted(&Monomial::power(from, -2 * half), &Number::integer(1));
            result.add_scaled(&self.times(&lowered, &power)?, &Number::integer(1));
        }
        Ok(result)
    }

    /// Eliminate the squares of all sines (or of all cosines): a normal form of the angles present.
    pub(super) fn eliminate_all(
        &mut self,
        p: &Polynomial,
        choose: impl Fn(Pair) -> (u32, u32),
    ) -> Result<Polynomial, Error> {
        let mut result = p.clone();
        for pair in self.angles_in(p)? {
            let (from, to) = choose(pair);
            result = self.eliminate(&result, from, to)?;
        }
        Ok(result)
    }

    /// Apply the identity wherever it leaves fewer terms.
    ///
    /// M, M s^2 and M c^2 with coefficients k0, k1, k2 equal those with k0 + d, k1 - d, k2 - d for any d.
    pub(super) fn shorten(&mut self, p: &Polynomial) -> Result<Polynomial, Error> {
        let mut result = p.clone();
        let pairs = self.angles_in(p)?;
        loop {
            let before = result.len();
            for &pair in &pairs {
                self.shorten_angle(&mut result, pair)?;
            }
            if result.len() == before {
                return Ok(result);
            }
        }
    }

    fn shorten_angle(&mut self, p: &mut Polynomial, (sin, cos): Pair) -> Result<(), Error> {
        self.budget.spend(p.len())?;
        let squares = [Monomial::power(sin, 2), Monomial::power(cos, 2)];
        let mut bases: Vec<Monomial> = Vec::new();
        for (monomial, _) in p.iter() {
            for (atom, square) in [sin, cos].iter().zip(&squares) {
                if monomial.exponent(*atom) >= 2 {
                    bases.push(monomial.over(square));
                }
            }
        }
        bases.sort_unstable();
        bases.dedup();
        for base in bases {
            let family = [base.clone(), base.times(&squares[0]), base.times(&squares[1])];
            shift_family(p, &family);
        }
        Ok(())
    }
}

/// Apply the shift d of a family that leaves fewest terms, if any shift leaves fewer.
fn shift_family(p: &mut Polynomial, family: &[Monomial; 3]) {
    let zero = Number::integer(0);
    let known = family.each_ref().map(|m| p.coefficient(m).cloned().unwrap_or_else(|| zero.clone()));
    let shifted = |d: &Number| [known[0].add(d), known[1].sub(d), known[2].sub(d)];
    let terms = |k: &[Number; 3]| k.iter().filter(|c| !c.is_zero()).count();
    let mut best = (terms(&known), None);
    for shift in [known[1].clone(), known[2].clone(), known[0].neg()] {
        let count = terms(&shifted(&shift));
        if count < best.0 {
            best = (count, Some(shift));
        }
    }
    if let Some(shift) = best.1 {
        p.add_term(family[0].clone(), &shift);
        p.add_term(family[1].clone(), &shift.neg());
        p.add_term(family[2].clone(), &shift.neg());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Assumption, Function, Graph, Id, NumberId};
    use crate::polynomial::Budget;
    use crate::rewrite::expand::Opening;

    /// a sin(x)^2 + (a + b) cos(x)^2 + b cos(x)^2 tan(x)^2 - c cos(x)^2 + c, multiplied out
    #[test]
    fn terms_join_across_coefficients() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, c, x] = ["a", "b", "c", "x"].map(|name| g.symbol(name, Assumption::Real));
        let (sin, cos) = (g.apply(Function::Sin, &[x])?, g.apply(Function::Cos, &[x])?);
        let two = g.number_id(&Number::integer(2));
        let term = |g: &mut Graph, k: Id, f: Id| g.product(&[(k, NumberId::ONE), (f, two)]);
        let terms =
            [term(g, a, sin)?, term(g, a, cos)?, term(g, b, cos)?, term(g, b, sin)?, term(g, c, cos)?, c];
        let mut ring = Ring::new(g, Budget::new(100, 1000));
        let mut polynomial = Polynomial::default();
        for (index, id) in terms.into_iter().enumerate() {
            let sign = Number::integer(if index == 4 { -1 } else { 1 });
            polynomial.add_scaled(&ring.polynomial(id, Opening::Products)?, &sign);
        }
        let short = ring.shorten(&polynomial)?;
        let node = ring.node_of(&short)?;
        let square = g.product(&[(c, NumberId::ONE), (sin, two)])?;
        let expected = g.sum(&[(NumberId::ONE, a), (NumberId::ONE, b), (NumberId::ONE, square)]);
        assert_eq!(node, expected);
        Ok(())
    }

    #[test]
    fn elimination_is_exact_in_both_directions() -> Result<(), Error> {
        let g = &mut Graph::new();
        let x = g.symbol("x", Assumption::Real);
        let (sin, cos) = (g.apply(Function::Sin, &[x])?, g.apply(Function::Cos, &[x])?);
        let (five, two) = (g.number_id(&Number::integer(5)), g.number_id(&Number::integer(2)));
        let product = g.product(&[(sin, five), (cos, two)])?;
        let mut ring = Ring::new(g, Budget::new(100, 1000));
        let polynomial = ring.polynomial(product, Opening::Products)?;
        for choose in [|(s, c): Pair| (s, c), |(s, c): Pair| (c, s)] {
            let other = ring.eliminate_all(&polynomial, choose)?;
            assert_ne!(other, polynomial);
            let node = ring.node_of(&other)?;
            assert!(ring.graph.equal(node, product));
        }
        Ok(())
    }
}
