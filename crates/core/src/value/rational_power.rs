//! Powers with rational exponents in a field: roots where the field has them, and drawn values elsewhere.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::ToPrimitive;

use super::field::Field;
use super::key::Key;
use super::number::Number;
use super::prime::fraction_modulo;
use super::quadratic::Quadratic;

/// The twos in a denominator that leave room for it in a word: roots of higher degree are drawn.
const MOST_HALVINGS: u64 = 60;

impl Field {
    /// The principal power with a rational exponent r: |u|^r for a positive u, |u|^r e^(i pi r) for a negative one.
    ///
    /// Positive elements of GF(p) form a group of odd order, in which r counts modulo the order. In larger fields
    /// there are square roots, and roots of odd degree (`odd_root`); those that are too large are drawn.
    pub(crate) fn rational_power(&self, base: &Quadratic, exponent: &Number) -> Quadratic {
        if exponent.is_integer() {
            return self.power(base, exponent);
        }
        match base {
            Quadratic::Real(0) => Quadratic::ZERO,
            &Quadratic::Real(word) => self.power_of_real(word, exponent),
            _ => self.power_of_wide(base, exponent),
        }
    }

    pub(super) fn power_of_real(&self, word: u64, exponent: &Number) -> Quadratic {
        let prime = self.prime();
        let is_positive = prime.is_square(word);
        let magnitude = if is_positive { word } else { prime.neg(word) };
        let power = match fraction_modulo(exponent, (prime.p - 1) / 2) {
            Some(e) => Quadratic::Real(prime.pow(magnitude, e)),
            None => self.power_in_parts(magnitude, exponent),
        };
        if is_positive {
            return power;
        }
        self.mul(&power, &self.power_of_minus_one(exponent))
    }

    /// A power of a square, where the denominator shares factors with the order n k of the squares, and n shares none.
    ///
    /// A square is a product of two, whose orders divide n and k. The first has one root. That of the second is drawn
    /// unless it is 1, as it is for positive symbols and exponentials, whose orders are large primes.
    fn power_in_parts(&self, square: u64, exponent: &Number) -> Quadratic {
        let prime = self.prime();
        let order = (prime.p - 1) / 2;
        let shared = shared_part(order, &exponent.denominator());
        let unshared = order / shared;
        let inverse = fraction_modulo(&Number::whole(shared.into()).recip().expect("not 0"), unshared);
        let (Some(e), Some(inverse)) = (fraction_modulo(exponent, unshared), inverse) else {
            return self.drawn_root(&Quadratic::Real(square), exponent);
        };
        let part = prime.pow(square, shared * inverse);
        let rest = prime.mul(square, prime.inverse(part));
        let power = Quadratic::Real(prime.pow(part, e));
        if rest == prime.one {
            power
        } else {
            self.mul(&power, &self.drawn_root(&Quadratic::Real(rest), exponent))
        }
    }

    /// e^(i pi r), which is i^n for r = n/2.
    pub(crate) fn power_of_minus_one(&self, exponent: &Number) -> Quadratic {
        match exponent.mul(&Number::integer(2)).to_i64() {
            Some(n) => self.closure.power(&self.closure.imaginary(), n.rem_euclid(4).unsigned_abs()),
            None => self.unit(&exponent.mul(&Number::rational(1, 2))),
        }
    }

    /// A power of a prime number: powers with odd denominators are real, also where the prime is no square.
    ///
    /// (-1)^(m/(2^k n)) is the power of -1 with the exponent m/n mod 2^(k + 1) over 2^k.
    pub(crate) fn power_of_prime(&self, number: &Number, exponent: &Number) -> Quadratic {
        let value = self.number(number);
        let halvings = exponent.denominator().trailing_zeros().unwrap_or(0);
        if halvings > MOST_HALVINGS {
            return self.drawn_root(&value, exponent);
        }
        let two_part = 1u64 << halvings;
        let Some(numerator) = fraction_modulo(&exponent.mul(&Number::whole(two_part.into())), 2 * two_part)
        else {
            return self.drawn_root(&value, exponent);
        };
        let magnitude = self.rational_power(&self.modulus(&value), exponent);
        if self.closure.is_positive(&value) {
            return magnitude;
        }
        let turns = Number::whole(numerator.into())
            .mul(&Number::whole((2 * two_part).into()).recip().expect("not 0"));
        self.mul(&magnitude, &self.unit(&turns))
    }

    fn power_of_wide(&self, base: &Quadratic, exponent: &Number) -> Quadratic {
        let Some((num, den)) = exponent.to_small() else { return self.drawn_root(base, exponent) };
        let halvings = den.trailing_zeros();
        let mut root = base.clone();
        for _ in 0..halvings {
            let Some(next) = self.square_root(&root) else { return self.power_of_unrooted(base, exponent) };
            root = next;
        }
        self.rational_or_drawn(&root, num, den >> halvings)
    }

    fn rational_or_drawn(&self, root: &Quadratic, num: i64, odd: i64) -> Quadratic {
        match root {
            _ if odd == 1 => self.power(root, &Number::integer(num)),
            &Quadratic::Real(word) => self.power_of_real(word, &Number::rational(num, odd)),
            _ => {
                let exponent = Number::rational(num, odd);
                self.power_at_exact_angle(root, &exponent)
                    .or_else(|| self.power_of_odd_root(root, num, odd))
                    .unwrap_or_else(|| self.power_of_unrooted(root, &exponent))
            }
        }
    }

    fn power_of_odd_root(&self, base: &Quadratic, num: i64, odd: i64) -> Option<Quadratic> {
        let degree = odd.unsigned_abs();
        let root = self.has_odd_roots().then(|| self.odd_root(base, degree))??;
        Some(self.power(&root, &Number::integer(num)))
    }

    /// A power of a root that the closure does not hold: the positive factor that makes the leading coordinate 1 or -1 has
    /// a root, and that of the rest is drawn for its degree and radicand.
    fn power_of_unrooted(&self, base: &Quadratic, exponent: &Number) -> Quadratic {
        let leading = Quadratic::Real(base.leading());
        let magnitude = self.modulus(&leading);
        let Quadratic::Real(word) = magnitude else { unreachable!("a coordinate is real") };
        let rest = self.div(base, &magnitude);
        self.mul(&self.power_of_real(word, exponent), &self.drawn_root(&rest, exponent))
    }

    /// A root drawn for a value; that of the reciprocal is its reciprocal.
    fn drawn_root(&self, base: &Quadratic, exponent: &Number) -> Quadratic {
        let key = Key::new("root").text(&exponent.denominator().to_string());
        let reciprocal = self.inverse(base);
        let (lesser, sign) = if reciprocal.words() < base.words() { (&reciprocal, -1) } else { (base, 1) };
        let root = self.opaque(key, &[lesser]);
        self.power(&self.mul(&root, &root), &Number::whole(exponent.numerator() * sign))
    }
}

/// The largest divisor of a number that has only primes of another number.
fn shared_part(number: u64, other: &BigInt) -> u64 {
    let (mut shared, mut rest) = (1, number);
    loop {
        match BigInt::from(rest).gcd(other).to_u64() {
            Some(factor) if factor > 1 => {
                shared *= factor;
                rest /= factor;
            }
            _ => return shared,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::FieldId;

    #[test]
    fn a_root_of_a_degree_of_many_digits_has_its_power() {
        let degree = Number::whole(BigInt::from(10).pow(25) + 3);
        let root = degree.recip().expect("not 0");
        let two = Number::integer(2);
        for field in FieldId::HASH {
            let f = field.field();
            let (first, others) =
                (f.power_of_prime(&two, &root), f.power_of_prime(&two, &Number::integer(1).sub(&root)));
            assert_eq!(f.mul(&first, &others), f.number(&two));
        }
    }
}
