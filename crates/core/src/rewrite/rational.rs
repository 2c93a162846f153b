//! Common denominators, and divisors that cancel exactly.

use crate::error::Error;
use crate::graph::{Id, View};
use crate::polynomial::{Monomial, Polynomial};
use crate::value::Number;

use super::expand::Opening;
use super::ring::Ring;

impl Ring<'_> {
    /// Numerator and denominator of a polynomial with negative exponents, divisors of the numerator cancelled.
    ///
    /// `None` if there are no fractions.
    pub(crate) fn fraction(&mut self, sum: &Polynomial) -> Result<Option<(Id, Id)>, Error> {
        let floor = sum.lowest_powers();
        let (divisors, _) = floor.split(|atom| floor.exponent(atom) < 0);
        if divisors.is_one() || sum.len() < 2 {
            return Ok(None);
        }
        let numerator = sum.shifted(&divisors.pow(-1), &Number::integer(1));
        let numerator = self.node_of(&numerator)?;
        let mut numerator = self.polynomial(numerator, Opening::Products)?;
        let mut denominator = Monomial::default();
        for &(atom, exponent) in divisors.factors() {
            let left = self.cancel(&mut numerator, atom, -exponent)?;
            denominator = denominator.times(&Monomial::power(atom, left));
        }
        let denominator = self.node_of(&Polynomial::term(denominator, Number::integer(1)))?;
        Ok(Some((self.node_of(&numerator)?, denominator)))
    }

    /// Divide by a closed sum as often as possible; return the remaining exponent.
    fn cancel(&mut self, numerator: &mut Polynomial, atom: u32, mut exponent: i64) -> Result<i64, Error> {
        let node = self.node(atom);
        if !matches!(self.graph.view(node), View::Sum(_)) {
            return Ok(exponent);
        }
        let divisor = self.polynomial(node, Opening::Products)?;
        let normal_divisor = self.eliminate_all(&divisor, |(sin, cos)| (sin, cos))?;
        while exponent > 0 {
            let normal = self.eliminate_all(numerator, |(sin, cos)| (sin, cos))?;
            let quotient = numerator
                .divide_exactly(&divisor, &mut self.budget)
                .or_else(|| normal.divide_exactly(&normal_divisor, &mut self.budget));
            let Some(quotient) = quotient else { break };
            *numerator = quotient;
            exponent -= 1;
        }
        Ok(exponent)
    }
}
