//! Between exact numbers and doubles: the decimal that prints a double, and the double nearest to a rational.

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// The integer n and the exponent e of the shortest decimal n 10^e that prints as this finite double.
pub(super) fn shortest_decimal(value: f64) -> (BigInt, i32) {
    const FORMAT: &str = "a finite double prints as digits, e and an exponent";
    let text = format!("{value:e}");
    let (mantissa, exponent) = text.split_once('e').expect(FORMAT);
    let exponent: i32 = exponent.parse().expect(FORMAT);
    let fraction = mantissa.split_once('.').map_or("", |(_, fraction)| fraction);
    let digits: String = mantissa.chars().filter(|c| *c != '.').collect();
    (digits.parse().expect(FORMAT), exponent - i32::try_from(fraction.len()).expect(FORMAT))
}

/// How many bits an integer has.
fn bits(value: &BigInt) -> i64 {
    i64::try_from(value.bits()).expect("a number in memory has fewer than 2^63 bits")
}

/// How many decimal digits an integer that is not negative has.
fn length(value: &BigInt) -> i64 {
    i64::try_from(value.to_string().len()).expect("a number in memory has fewer than 2^63 digits")
}

/// Round a rational to the nearest double (ties to even) with 64 extra quotient bits.
pub(super) fn nearest_f64(value: &BigRational) -> f64 {
    if value.is_zero() {
        return 0.0;
    }
    let num = value.numer().abs();
    let den = value.denom();
    let shift = 66 + bits(den) - bits(&num);
    let (scaled_num, scaled_den) = if shift >= 0 {
        (num << shift.unsigned_abs(), den.clone())
    } else {
        (num, den << shift.unsigned_abs())
    };
    let (quotient, rest) = scaled_num.div_rem(&scaled_den);
    // A sticky last bit keeps the later rounding of the 66-bit quotient correct.
    let sticky = if rest.is_zero() { quotient } else { quotient | BigInt::one() };
    let magnitude = scale_by_power_of_two(&sticky, -shift);
    if value.numer().sign() == Sign::Minus { -magnitude } else { magnitude }
}

fn scale_by_power_of_two(value: &BigInt, exponent: i64) -> f64 {
    // Subnormal results must be rounded once only: drop the bits below 2^-1074 with a sticky bit first.
    let lowest = -1074 - exponent;
    let (value, exponent) = if lowest > 0 && bits(value) - lowest < 53 {
        let keep = lowest - 2;
        if keep > 0 {
            let kept = value >> keep.unsigned_abs();
            let sticky = if (&kept << keep.unsigned_abs()) == *value { kept } else { kept | BigInt::one() };
            return round_quarter(&sticky);
        }
        (value.clone(), exponent)
    } else {
        (value.clone(), exponent)
    };
    let mantissa = value.to_f64().expect("an integer beyond the doubles rounds to infinity");
    let mut result = mantissa;
    let mut left = exponent;
    while left != 0 && result != 0.0 && result.is_finite() {
        let step = left.clamp(-1000, 1000);
        result *= 2f64.powi(i32::try_from(step).expect("a step is between -1000 and 1000"));
        left -= step;
    }
    result
}

/// A count of quarters of the smallest subnormal, rounded to that subnormal's multiples.
fn round_quarter(quarters: &BigInt) -> f64 {
    let count = quarters.to_u64().expect("what rounds to a multiple of the smallest subnormal has 55 bits");
    let (whole, part) = (count >> 2, count & 3);
    let up = part == 3 || (part == 2 && whole & 1 == 1);
    f64::from_bits(whole + u64::from(up))
}

/// Seventeen significant digits of a number beyond the doubles, and its power of ten.
pub(super) fn scientific(value: &BigRational) -> String {
    const DIGITS: usize = 17;
    let (num, den) = (value.numer().abs(), value.denom());
    // One digit more than is printed, whichever of the two lengths the quotient has.
    let shift = 19 - (length(&num) - length(den));
    let ten = BigInt::from(10)
        .pow(u32::try_from(shift.unsigned_abs()).expect("a number has fewer than 2^32 digits"));
    let quotient = if shift >= 0 { num * ten / den } else { num / (den * ten) };
    let exponent = length(&quotient) - 1 - shift;
    let digits = quotient.to_string();
    let mantissa = digits[..DIGITS.min(digits.len())].trim_end_matches('0');
    let (first, rest) = mantissa.split_at(1);
    let sign = if value.is_negative() { "-" } else { "" };
    let point = if rest.is_empty() { "" } else { "." };
    format!("{sign}{first}{point}{rest}e{exponent}")
}
