//! Exact numbers: integers and rationals of any size; a decimal is a rational that prints as a double.
//!
//! A double stands for the shortest decimal that prints it (0.1 is 1/10), so models with numbers
//! compare as exactly as models with symbols. Arithmetic never rounds; [`Number::to_f64`] does, once.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};
use std::cmp::Ordering;
use std::hash::{Hash, Hasher};

use crate::error::{Error, quoted};

use super::double::{nearest_f64, scientific, shortest_decimal};
use super::gcd::{reduced_product, reduced_sum};

/// An exact rational; `decimal` records that it came from doubles and prints as one.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Number {
    value: Value,
    decimal: bool,
}

/// Invariant: lowest terms, positive denominator; `Big` only when `Small` cannot hold the value.
#[derive(Clone, Debug)]
enum Value {
    Small(i64, i64),
    Big(Box<BigRational>),
}

/// In lowest terms equal numbers have equal parts; ratios in general would be compared by continued fractions.
impl PartialEq for Value {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Small(a, b), Self::Small(c, d)) => (a, b) == (c, d),
            (Self::Big(a), Self::Big(b)) => a.numer() == b.numer() && a.denom() == b.denom(),
            _ => false,
        }
    }
}

impl Eq for Value {}

impl Hash for Value {
    fn hash<H: Hasher>(&self, state: &mut H) {
        match self {
            Self::Small(num, den) => (num, den).hash(state),
            Self::Big(value) => (value.numer(), value.denom()).hash(state),
        }
    }
}

impl Value {
    /// The quotient of two integers, in lowest terms. Those that fit a word are reduced as such, which is much faster.
    fn from_i128(num: i128, den: i128) -> Self {
        match (i64::try_from(num), i64::try_from(den)) {
            (Ok(num), Ok(1)) => Self::Small(num, 1),
            (Ok(num), Ok(den)) if num != i64::MIN && den != i64::MIN => {
                let common = num.gcd(&den) * den.signum();
                Self::Small(num / common, den / common)
            }
            _ => Self::reduced(num, den),
        }
    }

    fn reduced(mut num: i128, mut den: i128) -> Self {
        if den < 0 {
            num = -num;
            den = -den;
        }
        if den != 1 {
            let common = num.gcd(&den);
            num /= common;
            den /= common;
        }
        match (i64::try_from(num), i64::try_from(den)) {
            (Ok(n), Ok(d)) => Self::Small(n, d),
            _ => Self::Big(Box::new(BigRational::new_raw(num.into(), den.into()))),
        }
    }

    fn from_big(value: BigRational) -> Self {
        match (value.numer().to_i64(), value.denom().to_i64()) {
            (Some(n), Some(d)) => Self::Small(n, d),
            _ => Self::Big(Box::new(value)),
        }
    }

    fn to_big(&self) -> BigRational {
        match self {
            Self::Small(n, d) => BigRational::new_raw((*n).into(), (*d).into()),
            Self::Big(value) => (**value).clone(),
        }
    }
}

impl Number {
    /// An integer.
    #[must_use]
    pub const fn integer(value: i64) -> Self {
        Self { value: Value::Small(value, 1), decimal: false }
    }

    /// The rational `num / den`; `den` must not be zero.
    #[must_use]
    pub fn rational(num: i64, den: i64) -> Self {
        Self { value: Value::from_i128(num.into(), den.into()), decimal: false }
    }

    /// The rational `num / den` of big integers.
    ///
    /// # Errors
    /// When `den` is zero.
    pub fn from_big(num: BigInt, den: BigInt) -> Result<Self, Error> {
        if den.is_zero() {
            return Err(Error::DivisionByZero(num.to_string()));
        }
        Ok(Self { value: Value::from_big(BigRational::new(num, den)), decimal: false })
    }

    /// An integer of any size.
    #[must_use]
    pub fn whole(value: BigInt) -> Self {
        Self { value: Value::from_big(BigRational::from(value)), decimal: false }
    }

    /// The shortest decimal that prints as this double.
    ///
    /// # Errors
    /// When the double is infinite or not a number.
    pub fn from_f64(value: f64) -> Result<Self, Error> {
        if !value.is_finite() {
            return Err(Error::NotFinite(value));
        }
        let (num, power) = shortest_decimal(value);
        let scale = BigInt::from(10).pow(power.unsigned_abs());
        let exact = if power >= 0 { BigRational::from(num * scale) } else { BigRational::new(num, scale) };
        Ok(Self { value: Value::from_big(exact), decimal: true })
    }

    /// Whether the number is 0.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        matches!(self.value, Value::Small(0, _))
    }

    /// Whether the number is 1.
    #[must_use]
    pub fn is_one(&self) -> bool {
        matches!(self.value, Value::Small(1, 1))
    }

    /// Whether the number is -1.
    #[must_use]
    pub fn is_minus_one(&self) -> bool {
        matches!(self.value, Value::Small(-1, 1))
    }

    /// Whether the number is below 0.
    #[must_use]
    pub fn is_negative(&self) -> bool {
        match &self.value {
            Value::Small(n, _) => *n < 0,
            Value::Big(value) => value.is_negative(),
        }
    }

    /// Whether the number is an integer.
    #[must_use]
    pub fn is_integer(&self) -> bool {
        match &self.value {
            Value::Small(_, d) => *d == 1,
            Value::Big(value) => value.is_integer(),
        }
    }

    /// Whether the number is an even integer.
    #[must_use]
    pub fn is_even(&self) -> bool {
        self.is_integer() && self.numerator().is_even()
    }

    /// Whether the number prints as a double.
    #[must_use]
    pub const fn is_decimal(&self) -> bool {
        self.decimal
    }

    /// The same value, printed as a fraction (`decimal` false) or as a double.
    #[must_use]
    pub fn with_decimal(&self, decimal: bool) -> Self {
        Self { value: self.value.clone(), decimal }
    }

    /// The numerator and the denominator of a decimal that no double prints, such as 0.1 and 7 for 0.1/7: a decimal and
    /// an integer. There are none if they are longer than the nearest double.
    #[must_use]
    pub fn decimal_over_integer(&self) -> Option<(Self, Self)> {
        if !self.decimal {
            return None;
        }
        let mut rest = self.denominator();
        for prime in [2, 5].map(BigInt::from) {
            while rest.is_multiple_of(&prime) {
                rest /= &prime;
            }
        }
        let integer = Self::whole(rest);
        let numerator = self.mul(&integer);
        let is_printed = Self::from_f64(numerator.to_f64()).is_ok_and(|shown| shown.same_value(&numerator));
        let length = numerator.to_string().len() + integer.to_string().len();
        (is_printed && !integer.is_one() && length < self.to_string().len()).then_some((numerator, integer))
    }

    /// The value as a machine integer, if it is one.
    #[must_use]
    pub fn to_i64(&self) -> Option<i64> {
        match self.value {
            Value::Small(n, 1) => Some(n),
            _ => None,
        }
    }

    /// Numerator and denominator, when both fit a machine word.
    #[must_use]
    pub const fn to_small(&self) -> Option<(i64, i64)> {
        match self.value {
            Value::Small(n, d) => Some((n, d)),
            Value::Big(_) => None,
        }
    }

    /// The numerator in lowest terms.
    #[must_use]
    pub fn numerator(&self) -> BigInt {
        match &self.value {
            Value::Small(n, _) => (*n).into(),
            Value::Big(value) => value.numer().clone(),
        }
    }

    /// The positive denominator in lowest terms.
    #[must_use]
    pub fn denominator(&self) -> BigInt {
        match &self.value {
            Value::Small(_, d) => (*d).into(),
            Value::Big(value) => value.denom().clone(),
        }
    }

    /// The nearest double.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "both are below 2^53, so exact")]
    pub fn to_f64(&self) -> f64 {
        match &self.value {
            // Both exact in a double: one correctly rounded division.
            Value::Small(n, d) if n.unsigned_abs() < (1 << 53) && *d < (1 << 53) => *n as f64 / *d as f64,
            _ => nearest_f64(&self.value.to_big()),
        }
    }

    /// Whether two numbers have the same value, however they print.
    #[must_use]
    pub fn same_value(&self, other: &Self) -> bool {
        self.value == other.value
    }

    /// The sum.
    #[must_use]
    pub fn add(&self, other: &Self) -> Self {
        let decimal = self.decimal || other.decimal;
        let value = match (&self.value, &other.value) {
            (Value::Small(a, 1), Value::Small(b, 1)) => match a.checked_add(*b) {
                Some(sum) => Value::Small(sum, 1),
                None => Value::from_i128(i128::from(*a) + i128::from(*b), 1),
            },
            (Value::Small(a, b), Value::Small(c, d)) => {
                let (a, b, c, d) = (i128::from(*a), i128::from(*b), i128::from(*c), i128::from(*d));
                match (a * d).checked_add(c * b) {
                    Some(num) => Value::from_i128(num, b * d),
                    None => self.big_sum(other),
                }
            }
            _ => self.big_sum(other),
        };
        Self { value, decimal }
    }

    fn big_sum(&self, other: &Self) -> Value {
        Value::from_big(reduced_sum(&self.value.to_big(), &other.value.to_big()))
    }

    /// The opposite.
    #[must_use]
    pub fn neg(&self) -> Self {
        let value = match &self.value {
            Value::Small(n, d) => Value::from_i128(-i128::from(*n), i128::from(*d)),
            Value::Big(value) => Value::from_big(-(**value).clone()),
        };
        Self { value, decimal: self.decimal }
    }

    /// The absolute value.
    #[must_use]
    pub fn abs(&self) -> Self {
        if self.is_negative() { self.neg() } else { self.clone() }
    }

    /// The difference.
    #[must_use]
    pub fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }

    /// The product.
    #[must_use]
    pub fn mul(&self, other: &Self) -> Self {
        let decimal = self.decimal || other.decimal;
        let value = match (&self.value, &other.value) {
            (Value::Small(a, 1), Value::Small(c, 1)) => match a.checked_mul(*c) {
                Some(product) => Value::Small(product, 1),
                None => Value::from_i128(i128::from(*a) * i128::from(*c), 1),
            },
            (Value::Small(a, b), Value::Small(c, d)) => {
                Value::from_i128(i128::from(*a) * i128::from(*c), i128::from(*b) * i128::from(*d))
            }
            _ => self.big_product(other),
        };
        Self { value, decimal }
    }

    fn big_product(&self, other: &Self) -> Value {
        Value::from_big(reduced_product(&self.value.to_big(), &other.value.to_big()))
    }

    /// The reciprocal.
    ///
    /// # Errors
    /// When the number is zero.
    pub fn recip(&self) -> Result<Self, Error> {
        let value = match &self.value {
            Value::Small(0, _) => return Err(Error::DivisionByZero("0".into())),
            Value::Small(n, d) => Value::from_i128(i128::from(*d), i128::from(*n)),
            Value::Big(value) => Value::from_big(value.recip()),
        };
        Ok(Self { value, decimal: self.decimal })
    }

    /// An integer power.
    ///
    /// # Errors
    /// When zero is raised to a negative power, or the result has more than a million digits.
    pub fn powi(&self, exponent: i64) -> Result<Self, Error> {
        const BITS: u64 = 3_000_000;
        if exponent < 0 {
            return self
                .recip()?
                .powi(exponent.checked_neg().ok_or_else(|| Error::NumberTooLarge(exponent.to_string()))?);
        }
        if self.is_one() || exponent == 0 {
            return Ok(Self::integer(1).with_decimal(self.decimal));
        }
        let bits = self.numerator().bits().max(self.denominator().bits());
        let too_large = || Error::NumberTooLarge(quoted(&format!("({self})**{exponent}")));
        if bits > 1 && bits.saturating_mul(exponent.unsigned_abs()) > BITS {
            return Err(too_large());
        }
        if self.is_zero() || bits == 1 {
            let odd = exponent % 2 != 0;
            return Ok(if odd { self.clone() } else { self.abs() });
        }
        let exponent = i32::try_from(exponent).map_err(|_| too_large())?;
        Ok(Self { value: Value::from_big(self.value.to_big().pow(exponent)), decimal: self.decimal })
    }

    /// The largest integer not above the number.
    #[must_use]
    pub fn floor(&self) -> Self {
        let value = match &self.value {
            Value::Small(n, d) => Value::Small(n.div_floor(d), 1),
            Value::Big(value) => Value::from_big(value.floor()),
        };
        Self { value, decimal: self.decimal }
    }

    /// The order of two numbers.
    #[must_use]
    pub fn compare(&self, other: &Self) -> Ordering {
        match (&self.value, &other.value) {
            (Value::Small(a, b), Value::Small(c, d)) => {
                (i128::from(*a) * i128::from(*d)).cmp(&(i128::from(*c) * i128::from(*b)))
            }
            _ => self.value.to_big().cmp(&other.value.to_big()),
        }
    }
}

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.decimal {
            let value = self.to_f64();
            let magnitude = value.abs();
            if magnitude.is_infinite() || (magnitude == 0.0 && !self.is_zero()) {
                return f.write_str(&scientific(&self.value.to_big()));
            }
            if magnitude != 0.0 && !(1e-4..1e16).contains(&magnitude) {
                return write!(f, "{value:e}");
            }
            return write!(f, "{value:?}");
        }
        match &self.value {
            Value::Small(n, 1) => write!(f, "{n}"),
            Value::Small(n, d) => write!(f, "{n}/{d}"),
            Value::Big(value) => write!(f, "{value}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_double_is_the_decimal_that_prints_it() -> Result<(), Error> {
        let sum = Number::from_f64(0.1)?.add(&Number::from_f64(0.2)?);
        assert!(sum.same_value(&Number::from_f64(0.3)?));
        assert!(!sum.same_value(&Number::from_f64(0.1 + 0.2)?));
        assert_eq!(sum.to_string(), "0.3");
        Ok(())
    }

    #[test]
    fn a_decimal_over_an_integer_is_exact() -> Result<(), Error> {
        let tenth = Number::from_f64(0.1)?;
        let texts =
            |number: &Number| number.decimal_over_integer().map(|(n, d)| (n.to_string(), d.to_string()));
        let seventh = tenth.mul(&Number::rational(1, 7));
        assert_eq!(texts(&seventh), Some(("0.1".to_owned(), "7".to_owned())));
        assert_eq!(texts(&tenth.mul(&Number::rational(1, 8))), None); // 0.0125
        assert_eq!(texts(&Number::rational(1, 7)), None);
        Ok(())
    }

    #[test]
    fn doubles_survive_the_round_trip() -> Result<(), Error> {
        for value in [1.0, -0.3, 1e300, 2.5e-308, 5e-324, 1.797e308, 123_456_789.125, 1.0 / 3.0] {
            assert_eq!(Number::from_f64(value)?.to_f64().to_bits(), value.to_bits(), "{value}");
        }
        Ok(())
    }

    #[test]
    fn small_and_big_agree() -> Result<(), Error> {
        let big = Number::integer(i64::MAX).add(&Number::integer(1));
        assert_eq!(big.sub(&Number::integer(1)), Number::integer(i64::MAX));
        assert_eq!(Number::integer(10).powi(30)?.mul(&Number::integer(10).powi(-30)?), Number::integer(1));
        Ok(())
    }
}
