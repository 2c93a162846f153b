//! Prime factors of numbers: the canonical form of their rational powers.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};
use rustc_hash::FxHashMap;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, LazyLock, Mutex};

use crate::interrupt::{long_tick, tick};

use super::gcd::gcd;
use super::number::Number;
use super::prime::mul_mod;

/// Primes below this are found by trial division.
const TRIALS: u64 = 2000;

/// The prime factors of large integers that were asked for, which take long to find. Values do not depend on it.
static KNOWN: LazyLock<Mutex<FxHashMap<BigInt, Arc<Powers>>>> = LazyLock::new(Mutex::default);

/// The table of known factors begins anew after this many numbers.
const MOST_KNOWN: usize = 10_000;

/// Numbers with more bits are not divided by Pollard's method, which would take seconds.
const MOST_BITS_FOR_STEPS: u64 = 8192;

type Powers = [(BigInt, i64)];

/// The prime factors of a positive number, with exponents that are negative for those of the denominator.
///
/// Factors beyond 64 bits stay as they are, if they are not powers, and no prime factor is found in few steps.
pub(crate) fn prime_factors(number: &Number) -> BTreeMap<BigInt, i64> {
    let mut factors = BTreeMap::new();
    for (part, sign) in [(number.numerator(), 1), (number.denominator(), -1)] {
        match part.to_u64() {
            Some(word) => split_word(word, sign, &mut factors),
            None => factors_of_large(part).iter().for_each(|(prime, exponent)| {
                *factors.entry(prime.clone()).or_default() += sign * exponent;
            }),
        }
    }
    factors.retain(|_, exponent| *exponent != 0);
    factors
}

/// The factors of a number of more than 64 bits, found once.
fn factors_of_large(number: BigInt) -> Arc<Powers> {
    let table = || KNOWN.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    if let Some(known) = table().get(&number) {
        return Arc::clone(known);
    }
    let mut factors = BTreeMap::new();
    split(number.clone(), 1, &mut factors);
    let factors: Arc<Powers> = factors.into_iter().collect();
    let mut known = table();
    if known.len() >= MOST_KNOWN {
        known.clear();
    }
    known.insert(number, Arc::clone(&factors));
    factors
}

fn split(mut rest: BigInt, sign: i64, factors: &mut BTreeMap<BigInt, i64>) {
    let mut q = 2u64;
    while q < TRIALS && rest.bits() > 64 {
        tick();
        let count;
        (rest, count) = without_powers(rest, q);
        if count > 0 {
            *factors.entry(q.into()).or_default() += sign * count;
        }
        q += if q == 2 { 1 } else { 2 };
    }
    match rest.to_u64() {
        Some(word) => split_word(word, sign, factors),
        None => split_large(rest, sign, factors),
    }
}

/// A number that is not zero without all its factors q, and their count: it is divided by q, q^2, q^4, and so on, and by
/// these powers from the largest one down.
fn without_powers(mut rest: BigInt, q: u64) -> (BigInt, i64) {
    let (mut powers, mut count) = (vec![BigInt::from(q)], 0);
    if !(&rest % q).is_zero() {
        return (rest, 0);
    }
    let mut divide = |rest: &mut BigInt, power: &BigInt, exponent: usize| {
        long_tick();
        let (quotient, remainder) = rest.div_rem(power);
        if remainder.is_zero() {
            (*rest, count) = (quotient, count + (1 << exponent));
        }
        remainder.is_zero()
    };
    while divide(&mut rest, &powers[powers.len() - 1], powers.len() - 1) {
        let square = &powers[powers.len() - 1] * &powers[powers.len() - 1];
        if square.bits() > rest.bits() {
            break;
        }
        powers.push(square);
    }
    for (exponent, power) in powers.iter().enumerate().rev() {
        divide(&mut rest, power, exponent);
    }
    (rest, count)
}

/// The factors of a number of up to 64 bits; zero has none.
fn split_word(mut rest: u64, sign: i64, factors: &mut BTreeMap<BigInt, i64>) {
    let mut q = 2;
    while q < TRIALS && q * q <= rest {
        while rest.is_multiple_of(q) {
            *factors.entry(q.into()).or_default() += sign;
            rest /= q;
        }
        q += if q == 2 { 1 } else { 2 };
    }
    if rest > 1 {
        split_without_small(rest, sign, factors);
    }
}

/// The factors of a number that is prime or has none below the bound of trials.
fn split_without_small(word: u64, sign: i64, factors: &mut BTreeMap<BigInt, i64>) {
    if word < TRIALS * TRIALS || is_prime(word) {
        *factors.entry(word.into()).or_default() += sign;
        return;
    }
    let divisor = proper_divisor(word);
    split_without_small(divisor, sign, factors);
    split_without_small(word / divisor, sign, factors);
}

/// A number of more than 64 bits: the root of a perfect power, or the number itself.
fn split_large(number: BigInt, sign: i64, factors: &mut BTreeMap<BigInt, i64>) {
    let bits = u32::try_from(number.bits()).unwrap_or(u32::MAX);
    // No prime below 2^10 divides the number, so it is no higher power than this.
    for degree in (2..=(bits / 10).min(100)).rev().filter(|&degree| may_be_power(&number, degree)) {
        long_tick();
        let root = number.nth_root(degree);
        if root.pow(degree) == number {
            split(root, sign * i64::from(degree), factors);
            return;
        }
    }
    if let Some(divisor) = divisor_in_few_steps(&number) {
        split(&number / &divisor, sign, factors);
        return split(divisor, sign, factors);
    }
    *factors.entry(number).or_default() += sign;
}

/// Whether a number is a residue of powers of a degree modulo the first primes of which that is a question.
fn may_be_power(number: &BigInt, degree: u32) -> bool {
    const PRIMES: usize = 8;
    let degree = u64::from(degree);
    let moduli = (1..).map(|k| k * degree + 1).filter(|&q| q > 2 && is_prime(q)).take(PRIMES);
    moduli.into_iter().all(|q| {
        let residue = (number % q).to_u64().unwrap_or(0);
        residue == 0 || pow_mod(residue, (q - 1) / degree, q) == 1
    })
}

/// A proper divisor of a large number by Pollard's rho method, if it is found in few steps: one with a prime factor below
/// 2^20, as a rule. The differences of many steps are tried together [Brent 1980].
fn divisor_in_few_steps(number: &BigInt) -> Option<BigInt> {
    const STEPS: usize = 2048;
    const TOGETHER: usize = 128;
    if number.bits() > MOST_BITS_FOR_STEPS {
        return None;
    }
    let next = |x: &BigInt| (x * x + 1u32) % number;
    let (mut slow, mut fast) = (BigInt::from(2), BigInt::from(2));
    for _ in 0..STEPS / TOGETHER {
        let (start_slow, start_fast) = (slow.clone(), fast.clone());
        let mut product = BigInt::one();
        for _ in 0..TOGETHER {
            tick();
            slow = next(&slow);
            fast = next(&next(&fast));
            product = product * (&slow - &fast) % number;
        }
        if gcd(product.abs(), number.clone()).is_one() {
            continue;
        }
        return first_divisor(number, start_slow, start_fast, TOGETHER);
    }
    None
}

/// The first divisor that a difference of steps of the rho method shares with the number; `None` if it is the number.
fn first_divisor(number: &BigInt, mut slow: BigInt, mut fast: BigInt, steps: usize) -> Option<BigInt> {
    let next = |x: &BigInt| (x * x + 1u32) % number;
    let shared = (0..steps).map(|_| {
        slow = next(&slow);
        fast = next(&next(&fast));
        gcd((&slow - &fast).abs(), number.clone())
    });
    shared.into_iter().find(|divisor| !divisor.is_one()).filter(|divisor| divisor != number)
}

/// The test of Miller and Rabin for numbers above 1, with the first twelve primes as bases, which decides below 2^64
/// [Sorenson & Webster 2017].
pub(super) fn is_prime(n: u64) -> bool {
    let twos = (n - 1).trailing_zeros();
    [2u64, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37].iter().all(|&base| {
        let mut power = pow_mod(base, (n - 1) >> twos, n);
        if base == n || power == 1 || power == n - 1 {
            return true;
        }
        (1..twos).any(|_| {
            power = mul_mod(power, power, n);
            power == n - 1
        })
    })
}

fn pow_mod(mut base: u64, mut exponent: u64, n: u64) -> u64 {
    let mut result = 1;
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = mul_mod(result, base, n);
        }
        base = mul_mod(base, base, n);
        exponent >>= 1;
    }
    result
}

/// A divisor of a composite number, by Pollard's rho method [Pollard 1975].
fn proper_divisor(n: u64) -> u64 {
    (1..)
        .find_map(|c| {
            let next =
                |x: u64| u64::try_from((u128::from(mul_mod(x, x, n)) + c) % u128::from(n)).unwrap_or(0);
            let (mut slow, mut fast) = (2, 2);
            loop {
                slow = next(slow);
                fast = next(next(fast));
                match slow.abs_diff(fast).gcd(&n) {
                    1 => {}
                    divisor if divisor == n => return None,
                    divisor => return Some(divisor),
                }
            }
        })
        .expect("some constant finds a divisor of a composite number")
}

/// The prime factors of numbers. Those of more than 64 bits may be composite, and are split by what they share.
pub(crate) fn coprime_factors(numbers: impl Iterator<Item = Number>) -> BTreeSet<BigInt> {
    let mut factors: BTreeSet<BigInt> =
        numbers.flat_map(|number| prime_factors(&number).into_keys()).collect();
    while let Some((large, shared)) = shared_factor(&factors) {
        let rest = &large / &shared;
        factors.remove(&large);
        for part in [rest, shared] {
            factors.extend(prime_factors(&Number::whole(part)).into_keys());
        }
    }
    factors
}

/// A factor of more than 64 bits, and a proper divisor of it that another factor has.
fn shared_factor(factors: &BTreeSet<BigInt>) -> Option<(BigInt, BigInt)> {
    let large = factors.iter().filter(|factor| factor.bits() > 64);
    large
        .flat_map(|large| factors.iter().map(move |other| (large, gcd(large.clone(), other.clone()))))
        .find_map(|(large, shared)| (!shared.is_one() && shared != *large).then(|| (large.clone(), shared)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn primes_are_told_from_products() {
        let primes = (2..200).filter(|&n| is_prime(n)).count();
        let composite = [1_000_003 * 1_000_033, 3_215_031_751, 3_825_123_056_546_413_051];
        assert_eq!((primes, composite.map(is_prime)), (46, [false; 3]));
        assert!(is_prime(1_000_003) && is_prime(18_446_744_073_709_551_557));
    }

    #[test]
    fn factors_multiply_to_the_number() {
        for (num, den) in [(1, 1), (12, 35), (2_147_483_647, 4), (1_000_003 * 1_000_033, 9), (i64::MAX, 1)] {
            let number = Number::rational(num, den);
            let product = prime_factors(&number).iter().fold(Number::integer(1), |product, (q, &e)| {
                product.mul(&Number::whole(q.clone()).powi(e).expect("a small power"))
            });
            assert_eq!(product, number);
        }
    }

    #[test]
    fn large_factors_are_split_by_what_they_share() {
        let large: BigInt = BigInt::from(10).pow(25) + 3;
        let numbers = [large.clone() * 15791, large].map(Number::whole);
        let factors = coprime_factors(numbers.into_iter());
        assert!(factors.contains(&15791.into()) && factors.iter().any(|factor| factor.bits() > 64));
        assert_eq!(shared_factor(&factors), None);
    }

    #[test]
    fn high_powers_of_small_primes_are_counted() {
        for (q, n) in [(2u32, 1000), (7, 1023), (7, 1024), (1999, 321)] {
            let power: BigInt = BigInt::from(q).pow(n) * 9;
            let expected =
                [(3.into(), 2), (q.into(), i64::from(n))].into_iter().collect::<BTreeMap<BigInt, i64>>();
            assert_eq!(prime_factors(&Number::whole(power)), expected);
        }
    }

    #[test]
    fn perfect_powers_pass_the_test_of_residues() {
        let base: BigInt = BigInt::from(10).pow(25) + 13;
        for degree in 2..40 {
            assert!(may_be_power(&base.pow(degree), degree), "{degree}");
        }
        assert!(!(2..40).any(|degree| may_be_power(&base, degree)));
    }

    #[test]
    fn powers_of_large_numbers_are_powers() {
        let base: BigInt = BigInt::from(10).pow(25) + 13;
        let factors = prime_factors(&Number::whole(num_traits::Pow::pow(&base, 3u32)));
        assert!(factors.values().all(|e| e % 3 == 0), "{factors:?}");
    }
}
