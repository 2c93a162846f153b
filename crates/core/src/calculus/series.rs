//! Arithmetic of truncated power series.
//!
//! A series is the list of its parts of degree 0, 1, ..., n. With the deviation `d = a - a_0` of a series a from its part
//! of degree 0,
//!
//! ```text
//!     (a b)_k = sum_j a_j b_(k-j)          f(a) = sum_m f^(m)(a_0) d^m / m!
//! ```
//!
//! Products, powers, sines and cosines are here; [`super::expansion`] has Taylor's formula in several arguments.

use crate::error::Error;
use crate::graph::{Function, Graph, Id, NumberId};
use crate::value::Number;

impl Graph {
    /// The product of two series.
    pub(super) fn product_of_series(&mut self, a: &[Id], b: &[Id]) -> Result<Vec<Id>, Error> {
        let mut product = Vec::with_capacity(a.len());
        for k in 0..a.len() {
            let mut terms = Vec::new();
            for j in 0..=k {
                if a[j] != Id::ZERO && b[k - j] != Id::ZERO {
                    terms.push((NumberId::ONE, self.mul(a[j], b[k - j])?));
                }
            }
            product.push(self.sum(&terms));
        }
        Ok(product)
    }

    /// Newton's binomial series, `sum_m r (r-1) ... (r-m+1)/m! a_0^(r-m) d^m`; `None` if it is singular, where `a_0` is 0.
    pub(super) fn power_of_series(
        &mut self,
        base: &[Id],
        exponent: &Number,
    ) -> Result<Option<Vec<Id>>, Error> {
        if self.equal(base[0], Id::ZERO) {
            let natural = exponent.to_i64().filter(|&n| n > 0 && exponent.is_integer());
            return natural.map(|n| self.repeated_product(base, n)).transpose();
        }
        let mut coefficient = Number::integer(1);
        let mut slopes = Vec::with_capacity(base.len());
        for m in (0_i64..).take(base.len()) {
            if m > 0 {
                let next = exponent.sub(&Number::integer(m - 1)).mul(&Number::rational(1, m));
                coefficient = coefficient.mul(&next);
            }
            if coefficient.is_zero() {
                break;
            }
            let power = self.pow_number(base[0], &exponent.sub(&Number::integer(m)))?;
            let factor = self.number_id(&coefficient);
            slopes.push(self.scale(factor, power));
        }
        self.composed_series(&slopes, base).map(Some)
    }

    /// The power of a series that begins with degree 1 or higher: from its length on, all parts of the power are zero.
    fn repeated_product(&mut self, base: &[Id], exponent: i64) -> Result<Vec<Id>, Error> {
        let mut power = constant_series(Id::ONE, base.len() - 1);
        for _ in 0..usize::try_from(exponent).map_or(base.len(), |n| n.min(base.len())) {
            power = self.product_of_series(&power, base)?;
        }
        Ok(power)
    }

    /// The sine or cosine of a series: their derivatives are sines and cosines in turn.
    pub(super) fn wave_of_series(&mut self, function: Function, argument: &[Id]) -> Result<Vec<Id>, Error> {
        let (sine, cosine) =
            (self.apply(Function::Sin, &argument[..1])?, self.apply(Function::Cos, &argument[..1])?);
        let turns = [sine, cosine, self.neg(sine), self.neg(cosine)];
        let first = usize::from(function == Function::Cos);
        let mut factorial = Number::integer(1);
        let mut slopes = Vec::with_capacity(argument.len());
        for (m, divisor) in (0..argument.len()).zip(0_i64..) {
            if m > 0 {
                factorial = factorial.mul(&Number::rational(1, divisor));
            }
            let factor = self.number_id(&factorial);
            slopes.push(self.scale(factor, turns[(first + m) % 4]));
        }
        self.composed_series(&slopes, argument)
    }

    /// `sum_m slopes[m] d^m`, where d is the argument without its part of degree 0.
    fn composed_series(&mut self, slopes: &[Id], argument: &[Id]) -> Result<Vec<Id>, Error> {
        let deviation = without_constant(argument);
        let mut power = constant_series(Id::ONE, argument.len() - 1);
        let mut terms = vec![Vec::new(); argument.len()];
        for (m, &slope) in slopes.iter().enumerate() {
            if m > 0 {
                power = self.product_of_series(&power, &deviation)?;
            }
            for (k, &part) in power.iter().enumerate() {
                if part != Id::ZERO && slope != Id::ZERO {
                    terms[k].push((NumberId::ONE, self.mul(slope, part)?));
                }
            }
        }
        Ok(terms.iter().map(|terms| self.sum(terms)).collect())
    }
}

/// The series of a constant.
pub(super) fn constant_series(value: Id, order: usize) -> Vec<Id> {
    let mut series = vec![Id::ZERO; order + 1];
    series[0] = value;
    series
}

/// A series without its part of degree 0.
pub(super) fn without_constant(parts: &[Id]) -> Vec<Id> {
    let mut deviation = parts.to_vec();
    deviation[0] = Id::ZERO;
    deviation
}
