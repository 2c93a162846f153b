//! Decimals that stand for rational multiples of pi, such as `math.pi/2` and `math.radians(30)`.
//!
//! No double is a multiple of pi. A double that is as near to k pi/n as rounding allows, with n up to 360 (fractions
//! with small denominators, and all half degrees), stands for k pi/n where it is a term of an angle. Such fractions
//! are at least 1/360^2 apart, so an unrelated number of 16 digits is taken for one with a probability of 1e-11.

use num_bigint::BigInt;
use rustc_hash::FxHashMap;
use std::f64::consts::PI;

use crate::graph::{Graph, Id, NumberId, View};
use crate::value::Number;

/// The largest denominator: half a degree is pi/360.
const LARGEST_DENOMINATOR: i64 = 360;

/// Angles above the first bound are taken for multiples of common fractions of pi only, and angles above the second one
/// for none: the larger the angles are, the farther apart are their doubles.
const LARGEST_ANGLES: (f64, f64) = (1e3, 1e6);

/// The largest denominator of a common fraction: 15 degrees are pi/12.
const LARGEST_COMMON: i64 = 12;

/// The relative rounding error of a product and a quotient of doubles: `math.radians(1)*45` is off by two or three
/// doubles.
const ROUNDING: f64 = 2.0 * f64::EPSILON;

/// The most terms of an angle that are searched for numbers.
const SEARCH: usize = 64;

/// The multiple k/n of pi with the least n up to 360 that is within a tolerance of an angle, and not zero.
#[must_use]
pub fn multiple_of_pi(angle: f64, tolerance: f64) -> Option<(i64, i64)> {
    if angle.is_nan() || angle.abs() > LARGEST_ANGLES.1 {
        return None;
    }
    let largest = if angle.abs() > LARGEST_ANGLES.0 { LARGEST_COMMON } else { LARGEST_DENOMINATOR };
    convergents(angle.abs() / PI)
        .take_while(|&(_, n)| n <= largest)
        .find(|&(k, n)| k > 0 && (angle.abs() - times_pi(k, n)).abs() <= tolerance)
        .map(|(k, n)| if angle < 0.0 { (-k, n) } else { (k, n) })
}

/// The convergents of the continued fraction of a positive number: all that are nearer than 1/(2 n^2) are among them.
#[expect(clippy::cast_possible_truncation, reason = "the largest angle is small")]
fn convergents(ratio: f64) -> impl Iterator<Item = (i64, i64)> {
    let (mut rest, mut last, mut current) = (Some(ratio), (0, 1), (1, 0));
    std::iter::from_fn(move || {
        let value = rest?;
        let whole = value.floor();
        rest = Some((value - whole).recip()).filter(|next| *next < f64::from(1 << 20));
        let next = (whole as i64 * current.0 + last.0, whole as i64 * current.1 + last.1);
        (last, current) = (current, next);
        Some(next)
    })
}

/// The double nearest to k pi/n.
fn times_pi(k: i64, n: i64) -> f64 {
    // pi to 40 digits
    const DIGITS: (i128, u32) = (31_415_926_535_897_932_384_626_433_832_795_028_842, 37);
    let numerator = BigInt::from(DIGITS.0) * k;
    let denominator = BigInt::from(10).pow(DIGITS.1) * n;
    let product = Number::from_big(numerator, denominator);
    product.expect("the denominators of convergents are positive").to_f64()
}

impl Number {
    /// The multiple of pi for which a decimal stands in an angle, if it does.
    #[must_use]
    pub fn multiple_of_pi(&self) -> Option<Self> {
        if !self.is_decimal() {
            return None;
        }
        let angle = self.to_f64();
        multiple_of_pi(angle, ROUNDING * angle.abs()).map(|(k, n)| Self::rational(k, n))
    }
}

impl Graph {
    /// The angle with each decimal that stands for a multiple of pi replaced by that multiple.
    pub fn angle(&mut self, angle: Id) -> Id {
        if !self.holds_decimal_multiple(angle) {
            return angle;
        }
        let is_linear = |id| matches!(self.view(id), View::Number(_) | View::Scale(..) | View::Sum(_));
        let mut exact: FxHashMap<Id, Id> = FxHashMap::default();
        for id in self.post_order_where(&[angle], is_linear) {
            let replaced = match self.view(id) {
                View::Number(number) => {
                    let (factor, unit) = self.in_multiples(number);
                    self.scale(factor, unit)
                }
                View::Scale(factor, child) => self.scale(factor, exact.get(&child).copied().unwrap_or(child)),
                View::Sum(terms) => {
                    let terms: Vec<_> = terms.iter().collect();
                    let terms: Vec<_> = terms.into_iter().map(|term| self.exact_term(term, &exact)).collect();
                    self.sum(&terms)
                }
                _ => id,
            };
            exact.insert(id, replaced);
        }
        exact[&angle]
    }

    /// The argument of a sine: like [`Self::angle`], but a single number stays that number, because its sine is data.
    pub fn angle_beside_others(&mut self, argument: Id) -> Id {
        if self.as_number(argument).is_some() { argument } else { self.angle(argument) }
    }

    fn exact_term(&mut self, (factor, node): (NumberId, Id), exact: &FxHashMap<Id, Id>) -> (NumberId, Id) {
        if node == Id::ONE {
            return self.in_multiples(factor);
        }
        (factor, exact.get(&node).copied().unwrap_or(node))
    }

    /// A number as a multiple of pi if it stands for one, and otherwise as a multiple of 1.
    fn in_multiples(&mut self, number: NumberId) -> (NumberId, Id) {
        match self.get_number(number).multiple_of_pi() {
            Some(multiple) => (self.number_id(&multiple), self.pi()),
            None => (number, Id::ONE),
        }
    }

    /// Whether one of the first terms of an angle is a decimal that stands for a multiple of pi.
    fn holds_decimal_multiple(&self, angle: Id) -> bool {
        let is_multiple = |number| self.get_number(number).multiple_of_pi().is_some();
        let mut stack = vec![angle];
        for _ in 0..SEARCH {
            let Some(id) = stack.pop() else { return false };
            match self.view(id) {
                View::Number(number) if is_multiple(number) => return true,
                View::Scale(_, child) => stack.push(child),
                View::Sum(terms) => {
                    for (factor, node) in terms.iter().take(SEARCH) {
                        if node == Id::ONE && is_multiple(factor) {
                            return true;
                        }
                        stack.push(node);
                    }
                }
                _ => {}
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_floating_point_leaves_of_multiples_of_pi_is_found() {
        for n in 1..=LARGEST_DENOMINATOR {
            for k in [1, 2, 3, 5, 7, 11, 25, 299] {
                let exact = Number::rational(k, n);
                #[expect(clippy::cast_precision_loss, reason = "small")]
                let (k, n) = (k as f64, n as f64);
                for angle in [k * PI / n, k * (PI / n), k / n * PI, PI / n * k, (180.0 * k / n).to_radians()]
                {
                    let number = Number::from_f64(-angle).unwrap_or(Number::integer(0));
                    assert_eq!(number.multiple_of_pi(), Some(exact.neg()), "{k} pi/{n}");
                }
            }
        }
    }

    #[test]
    #[expect(clippy::approx_constant, reason = "constants with digits left out are the point")]
    fn other_numbers_are_none() {
        for angle in [0.0, 1.0, 1.5, 1.57, 1.5708, 3.141_592_7, 1.570_796_326_794_9, 355.0, 1e300, 1e-300] {
            let number = Number::from_f64(angle).unwrap_or(Number::integer(0));
            assert_eq!(number.multiple_of_pi(), None, "{angle}");
        }
        assert_eq!(Number::rational(355, 113).multiple_of_pi(), None);
    }

    #[test]
    fn large_angles_are_multiples_of_common_fractions() {
        for (k, n) in [(1000, 1), (721, 2), (100_001, 12), (300_000, 1)] {
            #[expect(clippy::cast_precision_loss, reason = "small")]
            let angle = Number::from_f64(k as f64 * PI / n as f64).expect("a finite double");
            assert_eq!(angle.multiple_of_pi(), Some(Number::rational(k, n)), "{k} pi/{n}");
        }
        for angle in [2000.0 * PI / 7.0 / 11.0 * 13.0, 1e6 * PI] {
            let angle = Number::from_f64(angle).expect("a finite double");
            assert_eq!(angle.multiple_of_pi(), None);
        }
    }
}
