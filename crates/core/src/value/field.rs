//! Arithmetic at the random point: two prime fields, the circle group over each, and fixed draws.
//!
//! A fingerprint is the value of an expression in GF(p) for the two primes below. Both satisfy
//! p = -1 mod 110880, so the circle group x^2 + y^2 = 1 is cyclic of order p + 1 and holds the angles
//! 2 pi k / 110880; all primes up to 61 are squares in both fields. Moreover (p + 1)/110880 and (p - 1)/2
//! have prime factors above 2^44 and 2^53, so an angle and an exponent may be divided by any number that a
//! user writes (a unique root exists in a group of prime order).
//! [Martin 1971; Gonnet 1984; Monagan & Gonnet 1994, "Signature functions for algebraic numbers"]

use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive};
use std::ops::{Add, Mul, Neg, Sub};
use std::sync::LazyLock;

use super::number::Number;

/// The order of the group of torsion angles: multiples of 2 pi / 110880.
pub const TORSION: u64 = 110_880;

const RESIDUE: &str = "a residue is between zero and its modulus, a word";

/// One prime field and the orders of the groups in it that serve angles and exponents.
#[derive(Clone, Copy, Debug)]
struct Prime {
    p: u64,
    /// -p^-1 mod 2^64, for Montgomery multiplication.
    neg_inverse: u64,
    /// 2^64 mod p (the Montgomery form of one) and 2^128 mod p.
    one: u64,
    r2: u64,
    /// The prime order of the group of atomic angles, a factor of p + 1.
    angle_order: u64,
    /// The prime order of the group of exponentials, a factor of p - 1.
    exp_order: u64,
}

#[expect(clippy::cast_possible_truncation, reason = "remainders by a word are below it")]
const fn prime(p: u64, angle_order: u64, exp_order: u64) -> Prime {
    let mut inverse: u64 = 1;
    let mut i = 0;
    while i < 6 {
        inverse = inverse.wrapping_mul(2u64.wrapping_sub(p.wrapping_mul(inverse)));
        i += 1;
    }
    let one = ((1u128 << 64) % p as u128) as u64;
    let r2 = (one as u128 * one as u128 % p as u128) as u64;
    Prime { p, neg_inverse: inverse.wrapping_neg(), one, r2, angle_order, exp_order }
}

const PRIMES: [Prime; 2] = [
    prime(4_611_685_641_547_390_559, 41_591_681_471_387, 2_305_842_820_773_695_279),
    prime(4_611_684_925_650_116_159, 20_795_837_507_441, 13_644_038_241_568_391),
];

impl Prime {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "Montgomery's m is a remainder by 2^64, and u is below 2 p"
    )]
    const fn reduce(&self, t: u128) -> u64 {
        let m = (t as u64).wrapping_mul(self.neg_inverse);
        let u = ((t + m as u128 * self.p as u128) >> 64) as u64;
        if u >= self.p { u - self.p } else { u }
    }

    const fn mul(&self, a: u64, b: u64) -> u64 {
        self.reduce(a as u128 * b as u128)
    }

    const fn add(&self, a: u64, b: u64) -> u64 {
        let sum = a + b;
        if sum >= self.p { sum - self.p } else { sum }
    }

    const fn sub(&self, a: u64, b: u64) -> u64 {
        if a >= b { a - b } else { a + self.p - b }
    }

    fn pow(&self, mut base: u64, mut exponent: u64) -> u64 {
        let mut result = self.one;
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = self.mul(result, base);
            }
            base = self.mul(base, base);
            exponent >>= 1;
        }
        result
    }

    fn circle_mul(&self, a: (u64, u64), b: (u64, u64)) -> (u64, u64) {
        (self.sub(self.mul(a.0, b.0), self.mul(a.1, b.1)), self.add(self.mul(a.0, b.1), self.mul(a.1, b.0)))
    }

    fn circle_pow(&self, mut base: (u64, u64), mut exponent: u64) -> (u64, u64) {
        let mut result = (self.one, 0);
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = self.circle_mul(result, base);
            }
            base = self.circle_mul(base, base);
            exponent >>= 1;
        }
        result
    }

    /// The rational point of the circle with parameter t: ((1 - t^2)/(1 + t^2), 2t/(1 + t^2)).
    fn circle_point(&self, t: u64) -> (u64, u64) {
        let square = self.mul(t, t);
        // 1 + t^2 is never zero: -1 is not a square when p = 3 mod 4.
        let scale = self.pow(self.add(self.one, square), self.p - 2);
        (self.mul(self.sub(self.one, square), scale), self.mul(self.add(t, t), scale))
    }
}

/// An element of both fields at once, in Montgomery form; the fingerprint of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Element([u64; 2]);

impl Element {
    /// The value of 0.
    pub const ZERO: Self = Self([0, 0]);
    /// The value of 1.
    pub const ONE: Self = Self([PRIMES[0].one, PRIMES[1].one]);

    fn zip(self, other: Self, op: impl Fn(&Prime, u64, u64) -> u64) -> Self {
        Self([op(&PRIMES[0], self.0[0], other.0[0]), op(&PRIMES[1], self.0[1], other.0[1])])
    }

    /// Whether the value is zero at both points.
    #[must_use]
    pub fn is_zero(self) -> bool {
        self == Self::ZERO
    }

    /// Whether the value vanishes at one of the two points (it then has no reciprocal).
    #[must_use]
    pub const fn is_singular(self) -> bool {
        self.0[0] == 0 || self.0[1] == 0
    }

    /// The reciprocal; zero stays zero.
    #[must_use]
    pub fn inverse(self) -> Self {
        self.zip(self, |prime, a, _| prime.pow(a, prime.p - 2))
    }

    /// A power with an integer exponent (negative: of the reciprocal).
    #[must_use]
    pub fn powi(self, exponent: i64) -> Self {
        let base = if exponent < 0 { self.inverse() } else { self };
        let n = exponent.unsigned_abs();
        base.zip(base, |prime, a, _| prime.pow(a, n))
    }

    /// A power with an integer exponent of any size (negative: of the reciprocal).
    #[must_use]
    pub fn power(self, exponent: &Number) -> Self {
        match exponent.to_i64() {
            Some(n) => self.powi(n),
            // Fermat: exponents count modulo p - 1.
            None => self.zip(self, |prime, a, _| prime.pow(a, residue(exponent, prime.p - 1))),
        }
    }

    /// The simple rational with this value at both points, if there is one.
    ///
    /// Rational reconstruction [Wang 1981]: Euclid's algorithm on (p, a) stopped half way.
    #[must_use]
    pub fn to_simple_rational(self) -> Option<Number> {
        const LARGEST: i64 = 1 << 30;
        let prime = &PRIMES[0];
        let residue = prime.reduce(u128::from(self.0[0]));
        // Both are below 2^62.
        #[expect(clippy::cast_possible_wrap, reason = "below 2^62")]
        let (mut r0, mut r1) = (prime.p as i64, residue as i64);
        let (mut t0, mut t1) = (0i64, 1i64);
        while r1 > LARGEST {
            let q = r0 / r1;
            (r0, r1) = (r1, r0 - q * r1);
            (t0, t1) = (t1, t0 - q * t1);
        }
        if t1 == 0 || t1.abs() > LARGEST {
            return None;
        }
        let number = Number::rational(r1, t1);
        (Self::from_number(&number) == self).then_some(number)
    }

    /// The principal square root at both points, if there is one: the root that is itself a square.
    #[must_use]
    pub fn sqrt(self) -> Option<Self> {
        let root = self.zip(self, |prime, a, _| prime.pow(a, (prime.p + 1) / 4));
        (root.mul(root) == self).then_some(root)
    }

    /// The image of an integer.
    #[must_use]
    pub fn from_i64(value: i64) -> Self {
        let magnitude = value.unsigned_abs();
        let element = Self::ZERO.zip(Self::ZERO, |prime, _, _| prime.mul(magnitude % prime.p, prime.r2));
        if value < 0 { element.neg() } else { element }
    }

    fn from_bigint(value: &BigInt) -> Self {
        let magnitude = value.abs();
        let residue = |prime: &Prime| (&magnitude % prime.p).to_u64().expect(RESIDUE);
        let element = Self::ZERO.zip(Self::ZERO, |prime, _, _| prime.mul(residue(prime), prime.r2));
        if value.is_negative() { element.neg() } else { element }
    }

    /// The image of an exact number.
    #[must_use]
    pub fn from_number(value: &Number) -> Self {
        match value.to_small() {
            Some((num, 1)) => Self::from_i64(num),
            Some((num, den)) => Self::from_i64(num).mul(Self::from_i64(den).inverse()),
            None => {
                Self::from_bigint(&value.numerator()).mul(Self::from_bigint(&value.denominator()).inverse())
            }
        }
    }

    /// Return the value or its opposite, whichever represents both, and whether the sign was changed.
    #[must_use]
    pub fn unsigned(self) -> (Self, bool) {
        let opposite = self.neg();
        if opposite.0 < self.0 { (opposite, true) } else { (self, false) }
    }

    /// The raw words, for hashing, ordering and keys.
    #[must_use]
    pub const fn words(self) -> [u64; 2] {
        self.0
    }

    /// A value drawn for a key: the same on every machine, as good as random.
    #[must_use]
    pub fn draw(key: &Key) -> Self {
        Self::ZERO.zip(Self::ZERO, |prime, _, _| key.draw(prime.p) % prime.p)
    }

    /// A member of the group of exponentials (prime order, so it has all roots), drawn for a key.
    #[must_use]
    pub fn draw_exponential(key: &Key) -> Self {
        let raw = Self::draw(key);
        raw.zip(raw, |prime, a, _| prime.pow(a, (prime.p - 1) / prime.exp_order))
    }

    /// A rational power of a member of the group of exponentials.
    #[must_use]
    pub fn pow_rational(self, exponent: &Number) -> Self {
        self.zip(self, |prime, a, _| prime.pow(a, residue(exponent, prime.exp_order)))
    }
}

impl Add for Element {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.zip(other, Prime::add)
    }
}

impl Sub for Element {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.zip(other, Prime::sub)
    }
}

impl Mul for Element {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.zip(other, Prime::mul)
    }
}

impl Neg for Element {
    type Output = Self;
    fn neg(self) -> Self {
        Self::ZERO - self
    }
}

/// num / den modulo the prime `order`.
fn residue(value: &Number, order: u64) -> u64 {
    let modulo = |big: &BigInt| -> u64 {
        let rest = big % order;
        let rest = if rest.is_negative() { rest + order } else { rest };
        rest.to_u64().expect(RESIDUE)
    };
    let (num, den) = match value.to_small() {
        Some((num, 1)) if num >= 0 => return num.unsigned_abs() % order,
        _ if value.is_integer() => return modulo(&value.numerator()),
        _ => (modulo(&value.numerator()), modulo(&value.denominator())),
    };
    mul_mod(num, pow_mod(den, order - 2, order), order)
}

#[expect(clippy::cast_possible_truncation, reason = "a remainder by a word is below it")]
fn mul_mod(a: u64, b: u64, m: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(m)) as u64
}

fn pow_mod(mut base: u64, mut exponent: u64, m: u64) -> u64 {
    let mut result = 1;
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = mul_mod(result, base, m);
        }
        base = mul_mod(base, base, m);
        exponent >>= 1;
    }
    result
}

/// A point of the circle group at both points: the cosine and the sine of an angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Circle {
    pub cos: Element,
    pub sin: Element,
}

impl Circle {
    pub const ONE: Self = Self { cos: Element::ONE, sin: Element::ZERO };

    fn map(self, op: impl Fn(&Prime, (u64, u64)) -> (u64, u64)) -> Self {
        let a = op(&PRIMES[0], (self.cos.0[0], self.sin.0[0]));
        let b = op(&PRIMES[1], (self.cos.0[1], self.sin.0[1]));
        Self { cos: Element([a.0, b.0]), sin: Element([a.1, b.1]) }
    }

    /// The sum of two angles.
    #[must_use]
    pub fn rotate(self, other: Self) -> Self {
        let cos = self.cos.mul(other.cos).sub(self.sin.mul(other.sin));
        let sin = self.cos.mul(other.sin).add(self.sin.mul(other.cos));
        Self { cos, sin }
    }

    /// An atomic angle drawn for a key, in the group of prime order.
    #[must_use]
    pub fn draw(key: &Key) -> Self {
        let t = Element::draw(key);
        Self { cos: t, sin: t }
            .map(|prime, (t, _)| prime.circle_pow(prime.circle_point(t), (prime.p + 1) / prime.angle_order))
    }

    /// A rational multiple of an atomic angle.
    #[must_use]
    pub fn times(self, factor: &Number) -> Self {
        self.map(|prime, point| prime.circle_pow(point, residue(factor, prime.angle_order)))
    }

    /// The angle 2 pi k / 110880.
    #[must_use]
    pub fn torsion(k: u64) -> Self {
        static GENERATORS: LazyLock<Circle> =
            LazyLock::new(|| Circle::ONE.map(|prime, _| torsion_generator(prime)));
        GENERATORS.map(|prime, generator| prime.circle_pow(generator, k % TORSION))
    }
}

/// The first point whose cofactor power has full order in the group of torsion angles.
fn torsion_generator(prime: &Prime) -> (u64, u64) {
    let cofactor = (prime.p + 1) / TORSION;
    let mut t = prime.add(prime.one, prime.one);
    loop {
        let candidate = prime.circle_pow(prime.circle_point(t), cofactor);
        let full =
            [2, 3, 5, 7, 11].iter().all(|q| prime.circle_pow(candidate, TORSION / q) != (prime.one, 0));
        if full {
            // Of the two directions of turning, the one in which the sine of a quarter turn is 1.
            let (_, sine) = prime.circle_pow(candidate, TORSION / 4);
            let (cos, sin) = candidate;
            return if sine == prime.one { candidate } else { (cos, prime.sub(0, sin)) };
        }
        t = prime.add(t, prime.one);
    }
}

/// The key of a draw: equal keys draw equal values, and other keys draw other values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Key(u64, u64);

impl Key {
    /// The key of a kind of value, such as "symbol" or "angle".
    #[must_use]
    pub fn new(domain: &str) -> Self {
        Self(0x9e37_79b9_7f4a_7c15, 0xc2b2_ae3d_27d4_eb4f).text(domain)
    }

    /// The key extended by a word.
    #[must_use]
    pub const fn word(self, word: u64) -> Self {
        let a = mix(self.0 ^ word);
        let b = mix(self.1.wrapping_add(word).rotate_left(29) ^ a);
        Self(a.wrapping_add(self.1.rotate_left(17)), b)
    }

    /// The key extended by a text.
    #[must_use]
    pub fn text(self, text: &str) -> Self {
        let mut key = self.word(text.len() as u64);
        for chunk in text.as_bytes().chunks(8) {
            let mut word = [0u8; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            key = key.word(u64::from_le_bytes(word));
        }
        key
    }

    /// The key extended by a value.
    #[must_use]
    pub const fn element(self, value: Element) -> Self {
        self.word(value.0[0]).word(value.0[1])
    }

    /// A word below 2^62, different for every salt.
    const fn draw(&self, salt: u64) -> u64 {
        let a = mix(self.0 ^ salt);
        mix(a.wrapping_add(self.1)) >> 2
    }
}

/// The finaliser of splitmix64 [Steele, Lea & Flood 2014].
const fn mix(word: u64) -> u64 {
    let mut z = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_field_inverts() {
        let a = Element::from_number(&Number::rational(-7, 3));
        assert_eq!(a.mul(a.inverse()), Element::ONE);
        assert_eq!(a.mul(Element::from_i64(-3)), Element::from_i64(7));
        assert_eq!(a.powi(-2).mul(a.powi(2)), Element::ONE);
    }

    #[test]
    fn primes_up_to_61_are_squares() {
        for q in [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61] {
            assert!(Element::from_i64(q).sqrt().is_some(), "{q}");
        }
    }

    #[test]
    fn angles_add_and_divide() {
        let x = Circle::draw(&Key::new("angle").text("x"));
        let third = x.times(&Number::rational(1, 3));
        assert_eq!(third.rotate(third).rotate(third), x);
        assert_eq!(x.cos.mul(x.cos).add(x.sin.mul(x.sin)), Element::ONE);
        assert_eq!(x.rotate(x.times(&Number::integer(-1))), Circle::ONE);
        let percent = x.times(&Number::rational(1, 100));
        assert_eq!(percent.times(&Number::integer(100)), x);
    }

    #[test]
    fn torsion_is_the_full_group() {
        let step = Circle::torsion(1);
        assert_eq!(Circle::torsion(TORSION), Circle::ONE);
        assert_eq!(Circle::torsion(TORSION / 2).cos, Element::from_i64(-1));
        assert_eq!(Circle::torsion(TORSION / 6).cos, Element::from_number(&Number::rational(1, 2)));
        assert_ne!(step, Circle::ONE);
    }

    #[test]
    fn exponentials_have_roots() {
        let e = Element::draw_exponential(&Key::new("exp").text("x"));
        let root = e.pow_rational(&Number::rational(1, 2));
        assert_eq!(root.mul(root), e);
    }
}
