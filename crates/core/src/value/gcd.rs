//! Greatest common divisors of large integers: Lehmer's algorithm [Knuth 1998, sec. 4.5.2, algorithm L].
//!
//! Exact numbers are reduced after every sum and product, so this algorithm dominates their cost.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

use crate::interrupt::tick;

/// Leading bits on which Euclid's steps are tried: sums of two such numbers fit an `i64`.
const LEADING: u64 = 62;

/// Divisors of numbers with more bits take so long that the work may be interrupted meanwhile.
const LONG: u64 = 20_000;

/// The quotient num / den in lowest terms; `den` must be positive.
pub(crate) fn reduced(num: BigInt, den: BigInt) -> BigRational {
    let (num, den) = without_common(num, den);
    BigRational::new_raw(num, den)
}

/// The sum of two quotients in lowest terms, in lowest terms [Knuth 1998, sec. 4.5.1].
pub(super) fn reduced_sum(a: &BigRational, b: &BigRational) -> BigRational {
    if a.denom() == b.denom() {
        return reduced(a.numer() + b.numer(), a.denom().clone());
    }
    let common = gcd(a.denom().clone(), b.denom().clone());
    let (rest_of_a, rest_of_b) = (a.denom() / &common, b.denom() / &common);
    let num = a.numer() * &rest_of_b + b.numer() * &rest_of_a;
    // What the sum shares with the denominator divides the common part.
    let (num, common) = without_common(num, common);
    BigRational::new_raw(num, rest_of_a * rest_of_b * common)
}

/// The product of two quotients in lowest terms, in lowest terms [Knuth 1998, sec. 4.5.1].
pub(super) fn reduced_product(a: &BigRational, b: &BigRational) -> BigRational {
    let (num_of_a, den_of_b) = without_common(a.numer().clone(), b.denom().clone());
    let (num_of_b, den_of_a) = without_common(b.numer().clone(), a.denom().clone());
    BigRational::new_raw(num_of_a * num_of_b, den_of_a * den_of_b)
}

/// An integer and a positive one, divided by their greatest common divisor.
fn without_common(a: BigInt, b: BigInt) -> (BigInt, BigInt) {
    let divisor = gcd(a.abs(), b.clone());
    if divisor == BigInt::from(1) { (a, b) } else { (a / &divisor, b / &divisor) }
}

/// The greatest common divisor of two integers that are not negative.
pub(super) fn gcd(mut a: BigInt, mut b: BigInt) -> BigInt {
    if a < b {
        std::mem::swap(&mut a, &mut b);
    }
    while b.bits() > LEADING {
        if b.bits() > LONG {
            tick();
        }
        let shift = a.bits() - LEADING;
        let leading = |value: &BigInt| (value >> shift).to_i64().expect("both have at most 62 leading bits");
        (a, b) = match steps(leading(&a), leading(&b)) {
            [_, 0, _, _] => {
                let rest = &a % &b;
                (b, rest)
            }
            [p, q, r, s] => (&a * p + &b * q, &a * r + &b * s),
        };
    }
    match b.to_i64() {
        Some(small) if !b.is_zero() => {
            let rest = (a % b).to_i64().expect("a remainder is below its divisor, which fits");
            BigInt::from(rest.gcd(&small))
        }
        _ => a,
    }
}

/// The matrix of as many of Euclid's steps as the leading digits determine.
fn steps(mut x: i64, mut y: i64) -> [i64; 4] {
    let [mut p, mut q, mut r, mut s] = [1i64, 0, 0, 1];
    while y + r != 0 && y + s != 0 {
        let quotient = (x + p) / (y + r);
        if quotient != (x + q) / (y + s) {
            break;
        }
        (p, r) = (r, p - quotient * r);
        (q, s) = (s, q - quotient * s);
        (x, y) = (y, x - quotient * y);
    }
    [p, q, r, s]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_binary_algorithm() {
        let mut seed = BigInt::from(88_172_645_463_325_252_i64);
        let modulus = (BigInt::from(1) << 521) - 1;
        let mut draw = |bits: u64| {
            seed = (&seed * &seed + 12_345) % &modulus;
            &seed >> (521 - bits)
        };
        for bits in [1, 5, 61, 62, 63, 64, 65, 100, 127, 128, 200, 400, 520] {
            for _ in 0..50 {
                let (a, b, common) = (draw(bits), draw(bits / 2 + 1), draw(bits / 3 + 1));
                for (a, b) in [(&a * &common, &b * &common), (a.clone(), b.clone()), (b.clone(), a.clone())] {
                    assert_eq!(gcd(a.clone(), b.clone()), a.gcd(&b), "{a} {b}");
                }
                assert_eq!(gcd(a.clone(), BigInt::from(0)), a);
            }
        }
    }

    #[test]
    fn sums_and_products_are_in_lowest_terms() {
        let large = BigInt::from(10).pow(30) + 57;
        let parts = [1i64, -6, 35, 12].map(BigInt::from);
        let mut quotients = vec![BigRational::from(BigInt::from(1))];
        for num in &parts {
            for den in [&large * 6, &large * 35, &large * &large, BigInt::from(10)] {
                quotients.push(BigRational::new(num.clone(), den));
            }
        }
        for a in &quotients {
            for b in &quotients {
                let same = |found: &BigRational, expected: &BigRational| {
                    assert_eq!(
                        (found.numer(), found.denom()),
                        (expected.numer(), expected.denom()),
                        "{a} {b}"
                    );
                };
                same(&reduced_sum(a, b), &(a + b));
                same(&reduced_product(a, b), &(a * b));
                same(&reduced_sum(a, &-b), &(a - b));
            }
        }
    }

    #[test]
    fn agrees_on_fibonacci_numbers_whose_quotients_are_all_one() {
        let (mut a, mut b) = (BigInt::from(0), BigInt::from(1));
        for _ in 0..700 {
            (a, b) = (b.clone(), a + b);
            assert_eq!(gcd(b.clone(), a.clone()), BigInt::from(1));
        }
    }
}
