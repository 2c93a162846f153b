//! Roots of numbers: their square and exact parts, and the values of those that are irrational.

use super::field::{Circle, Element, Key, TORSION};
use super::number::Number;

const POSITIVE: &str = "the denominator of a number is positive";

/// number = outside^2 * inside, where the integer inside is square-free as far as trial division shows.
pub(crate) fn square_part(number: &Number) -> (Number, Number) {
    let decimal = number.is_decimal();
    let mut inside = number.numerator() * number.denominator();
    let mut outside = num_bigint::BigInt::from(1);
    for q in 2u32..2000 {
        let square = num_bigint::BigInt::from(q) * q;
        if square > inside {
            break;
        }
        while (&inside % &square).bits() == 0 {
            inside /= &square;
            outside *= q;
        }
    }
    let root = inside.sqrt();
    if &root * &root == inside {
        outside *= root;
        inside = num_bigint::BigInt::from(1);
    }
    let outside = Number::from_big(outside, number.denominator()).expect(POSITIVE);
    (outside.with_decimal(decimal), Number::whole(inside))
}

/// The exact root of a number, if it has one.
pub(crate) fn exact_root(number: &Number, degree: i64) -> Option<Number> {
    let degree = u32::try_from(degree).ok()?;
    let (num, den) = (number.numerator().nth_root(degree), number.denominator().nth_root(degree));
    let root = Number::from_big(num, den).ok()?.with_decimal(number.is_decimal());
    root.powi(i64::from(degree)).ok()?.same_value(number).then_some(root)
}

/// The value of sqrt(number): the product of the roots of its primes.
pub(crate) fn radical_value(number: &Number) -> Element {
    if number.is_zero() {
        return Element::ZERO; // which every prime divides, as often as one tries
    }
    let mut rest = number.numerator() * number.denominator();
    let mut value = Element::from_number(&Number::from_big(1.into(), number.denominator()).expect(POSITIVE));
    for q in 2u32..2000 {
        while (&rest % q).bits() == 0 {
            rest /= q;
            value = value * prime_root(q);
        }
    }
    if rest == num_bigint::BigInt::from(1) {
        return value;
    }
    value * free_root(&Number::whole(rest))
}

/// The value of the square root of a prime, in agreement with the values of trigonometric functions.
///
/// sqrt 2 = 2 cos(pi/4), sqrt 3 = 2 cos(pi/6), sqrt 5 = 4 cos(pi/5) - 1; sqrt 7 and sqrt 11 are Gauss sums:
/// for a prime q = 3 mod 4, sqrt q is the sum over k of (k/q) sin(2 pi k/q). Others are free.
fn prime_root(q: u32) -> Element {
    let cos = |k: u64| Circle::torsion(k).cos;
    match q {
        2 => cos(TORSION / 8) * Element::from_i64(2),
        3 => cos(TORSION / 12) * Element::from_i64(2),
        5 => cos(TORSION / 10) * Element::from_i64(4) - Element::ONE,
        7 => gauss_sum(7, &[1, 2, 4]),
        11 => gauss_sum(11, &[1, 3, 4, 5, 9]),
        _ => free_root(&Number::integer(q.into())),
    }
}

fn gauss_sum(q: u64, residues: &[u64]) -> Element {
    (1..q).fold(Element::ZERO, |sum, k| {
        let sine = Circle::torsion(TORSION / q * k).sin;
        if residues.contains(&k) { sum + sine } else { sum - sine }
    })
}

/// The value of a square root that no identity ties to an angle.
fn free_root(radicand: &Number) -> Element {
    let value = Element::from_number(radicand);
    let opaque = || Element::draw(&Key::new("radical").text(&radicand.with_decimal(false).to_string()));
    value.sqrt().unwrap_or_else(opaque)
}
