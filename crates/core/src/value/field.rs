//! A finite field of a lane, with its groups of angles and exponentials, and the functions that have values there.

use std::sync::OnceLock;

use super::circle;
use super::groups::{Groups, units_on_circle};
use super::key::Key;
use super::number::Number;
use super::prime::{Prime, fraction_modulo};
use super::quadratic::{Closure, Quadratic};

/// The exact angles are multiples of 2 pi over this number, as far as it divides p + 1.
pub(super) const TORSION: u64 = 110_880;

/// A field with its groups of angles and exponentials.
pub(crate) struct Field {
    pub(super) closure: Closure,
    /// Smaller primes are squares here.
    least_non_square: u64,
    angle_order: Option<u64>,
    exponent_order: Option<u64>,
    groups: OnceLock<Groups>,
}

impl Field {
    /// The field of a prime, with the orders of its groups of angles and exponentials, if these have values.
    pub(super) fn new(p: u64, angle_order: Option<u64>, exponent_order: Option<u64>) -> Self {
        let prime = Prime::new(p);
        let least_non_square =
            [2, 3, 5, 7, 11].into_iter().find(|&q| !prime.is_square(prime.natural(q))).unwrap_or(13);
        Self {
            closure: Closure::new(prime),
            least_non_square,
            angle_order,
            exponent_order,
            groups: OnceLock::new(),
        }
    }

    /// The least prime that may be no square here.
    pub(crate) fn least_non_square(&self) -> u64 {
        self.least_non_square
    }

    pub(super) fn prime(&self) -> &Prime {
        &self.closure.prime
    }

    pub(super) fn groups(&self) -> &Groups {
        self.groups.get_or_init(|| {
            let prime = self.prime();
            let torsion = num_integer::gcd(TORSION, prime.p + 1);
            let angle = self.angle_order.map_or(circle::identity(prime), |order| {
                circle::times(
                    prime,
                    circle::point(prime, self.word(&Key::new("angle"))),
                    (prime.p + 1) / order,
                )
            });
            let exponential = self.exponent_order.map_or(prime.one, |order| {
                prime.pow(self.word(&Key::new("exponential")), (prime.p - 1) / order)
            });
            let torsion = (torsion, circle::turn_over(prime, torsion));
            let units = if torsion.0 == TORSION { units_on_circle(prime, torsion) } else { Vec::new() };
            Groups { torsion, angle, exponential, units }
        })
    }

    /// The largest power of a prime that is the order of a unit on the circle, and that unit, if the field is one in which
    /// roots of odd degree are found.
    pub(super) fn unit_on_circle(&self, prime: u64) -> Option<(u32, &Quadratic)> {
        let mut units = self.groups().units.iter();
        units.find(|(known, ..)| *known == prime).map(|(_, count, unit)| (*count, unit))
    }

    /// Whether roots of odd degree are found here: in the first field of a lane.
    pub(super) fn has_odd_roots(&self) -> bool {
        !self.groups().units.is_empty()
    }

    pub(super) fn word(&self, key: &Key) -> u64 {
        key.draw(self.prime().p) % self.prime().p
    }

    /// A value drawn for a key: the same on every machine, as good as random.
    pub(crate) fn draw(&self, key: &Key) -> Quadratic {
        Quadratic::Real(self.word(key))
    }

    /// A positive value drawn for a key.
    pub(crate) fn draw_positive(&self, key: &Key) -> Quadratic {
        let word = self.word(key);
        Quadratic::Real(self.prime().mul(word, word))
    }

    /// The image of a number; a value is drawn where the prime divides the numerator or the denominator.
    pub(crate) fn number(&self, number: &Number) -> Quadratic {
        if number.is_zero() {
            return Quadratic::ZERO;
        }
        let image = self.prime().number(number);
        if image == 0 {
            return self.draw(&Key::new("singular number").text(&number.with_decimal(false).to_string()));
        }
        Quadratic::Real(image)
    }

    pub(crate) fn one(&self) -> Quadratic {
        self.closure.one()
    }

    pub(crate) fn add(&self, a: &Quadratic, b: &Quadratic) -> Quadratic {
        if a.is_extended() || b.is_extended() {
            return self.add_extended(a, b);
        }
        self.closure.add(a, b)
    }

    pub(crate) fn sub(&self, a: &Quadratic, b: &Quadratic) -> Quadratic {
        self.add(a, &self.neg(b))
    }

    pub(crate) fn neg(&self, a: &Quadratic) -> Quadratic {
        match a {
            Quadratic::Extended(a) => a.map(|each| self.neg(each)),
            _ => self.closure.neg(a),
        }
    }

    pub(crate) fn mul(&self, a: &Quadratic, b: &Quadratic) -> Quadratic {
        if a.is_extended() || b.is_extended() {
            return self.mul_extended(a, b);
        }
        self.closure.mul(a, b)
    }

    pub(crate) fn half(&self, a: &Quadratic) -> Quadratic {
        match a {
            Quadratic::Extended(a) => a.map(|each| self.half(each)),
            _ => self.closure.half(a),
        }
    }

    /// The reciprocal; zero stays zero.
    pub(crate) fn inverse(&self, a: &Quadratic) -> Quadratic {
        match a {
            Quadratic::Extended(a) => self.inverse_of_extended(a),
            _ => self.closure.inverse(a),
        }
    }

    pub(super) fn natural_power(&self, base: &Quadratic, mut exponent: u64) -> Quadratic {
        if !base.is_extended() {
            return self.closure.power(base, exponent);
        }
        let (mut base, mut result) = (base.clone(), self.one());
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = self.mul(&result, &base);
            }
            exponent >>= 1;
            if exponent > 0 {
                base = self.mul(&base, &base);
            }
        }
        result
    }

    /// The positive square root; `None` if it is too large.
    pub(super) fn square_root(&self, a: &Quadratic) -> Option<Quadratic> {
        if !a.is_extended() {
            return self.closure.sqrt(a);
        }
        self.square_root_of_extended(a).map(|root| self.modulus(&root))
    }

    pub(crate) fn div(&self, a: &Quadratic, b: &Quadratic) -> Quadratic {
        self.mul(a, &self.inverse(b))
    }

    /// An integer power.
    pub(crate) fn power(&self, base: &Quadratic, exponent: &Number) -> Quadratic {
        let base = if exponent.is_negative() { self.inverse(base) } else { base.clone() };
        let magnitude = exponent.abs();
        match (magnitude.to_i64(), &base) {
            (Some(n), _) => self.natural_power(&base, n.unsigned_abs()),
            // Fermat: exponents count modulo p - 1.
            (None, Quadratic::Real(_)) => {
                self.closure.power(&base, fraction_modulo(&magnitude, self.prime().p - 1).unwrap_or(0))
            }
            (None, _) => self.opaque(Key::new("power").text(&magnitude.to_string()), &[&base]),
        }
    }

    /// The sign of an element, 1 or -1, and 0 of zero.
    pub(crate) fn sign(&self, a: &Quadratic) -> Quadratic {
        match a {
            _ if a.is_zero() => Quadratic::ZERO,
            _ if self.closure.is_positive(a) => self.one(),
            _ => self.neg(&self.one()),
        }
    }

    /// The modulus |u|, the positive one of u and -u.
    pub(super) fn modulus(&self, a: &Quadratic) -> Quadratic {
        if self.closure.is_positive(a) { a.clone() } else { self.neg(a) }
    }

    /// The absolute value of what may lie outside GF(p): the root |N|^(1/n) of the norm N from a field of degree n. It is
    /// multiplicative, that of a unit of the circle is 1, and that of a root is the root of that of the radicand.
    pub(crate) fn absolute_value(&self, a: &Quadratic) -> Quadratic {
        if let Quadratic::Extended(extended) = a {
            if let Some((coefficient, _)) = extended.single_term() {
                return self.absolute_value(coefficient);
            }
            let drawn = self.opaque(Key::new("absolute value"), &[&self.unsigned(a).0]);
            return self.mul(&drawn, &drawn);
        }
        let (norm, degree) = self.closure.whole_norm(a);
        let magnitude = self.modulus(&Quadratic::Real(norm));
        self.rational_power(&magnitude, &Number::rational(1, i64::try_from(degree).unwrap_or(1)))
    }

    /// The first value whose condition is positive, as the sum of the values times indicators (1 + sign)/2.
    ///
    /// Values and conditions alternate, as in the arguments of the function, and `signs` has the signs of all of them.
    pub(crate) fn piecewise(&self, values: &[Quadratic], signs: &[Quadratic]) -> Quadratic {
        let (mut sum, mut not_yet) = (Quadratic::ZERO, self.one());
        for (value, sign) in values.chunks_exact(2).zip(signs.chunks_exact(2)) {
            let positive = self.half(&self.add(&self.one(), &sign[1]));
            sum = self.add(&sum, &self.mul(&self.mul(&not_yet, &positive), &value[0]));
            not_yet = self.mul(&not_yet, &self.sub(&self.one(), &positive));
        }
        self.add(&sum, &self.mul(&not_yet, &values[values.len() - 1]))
    }

    /// The n of 2^n with |n| up to a bound, if a value is that.
    pub(crate) fn power_of_two(&self, value: &Quadratic, bound: i64) -> Option<i64> {
        let (mut doubled, mut halved) = (self.one(), self.one());
        for n in 0..=bound {
            if *value == doubled {
                return Some(n);
            }
            if *value == halved {
                return Some(-n);
            }
            (doubled, halved) = (self.add(&doubled, &doubled), self.half(&halved));
        }
        None
    }

    /// The rational number of small numerator and denominator that has this value, if there is one.
    pub(crate) fn small_rational(&self, value: &Quadratic) -> Option<Number> {
        const LARGEST: u32 = 1 << 20;
        let &Quadratic::Real(word) = value else { return None };
        self.prime().simple_fraction(word, LARGEST).map(|(num, den)| Number::rational(num, den))
    }

    /// The unit cos + i sin of an angle.
    pub(crate) fn unit_of_angle(&self, (cos, sin): &(Quadratic, Quadratic)) -> Quadratic {
        self.add(cos, &self.mul(sin, &self.closure.imaginary()))
    }

    /// The cosine and the sine of an argument, given by its value in the field of angles.
    pub(crate) fn angle(&self, argument: u64) -> (Quadratic, Quadratic) {
        let (cos, sin) = circle::times(self.prime(), self.groups().angle, argument);
        (Quadratic::Real(cos), Quadratic::Real(sin))
    }

    /// A point of the circle drawn for a value: cos(-u) = cos(u), sin(-u) = -sin(u).
    pub(crate) fn drawn_angle(&self, key: Key, argument: &Quadratic) -> (Quadratic, Quadratic) {
        let (magnitude, negated) = self.unsigned(argument);
        if magnitude.is_zero() {
            return (self.one(), Quadratic::ZERO);
        }
        let drawn = self.linear_image(&self.opaque(key, &[&magnitude]));
        let (cos, sin) = circle::point(self.prime(), drawn);
        let sin = Quadratic::Real(sin);
        (Quadratic::Real(cos), if negated { self.neg(&sin) } else { sin })
    }

    /// The exponential of an argument, given by its value in the field of exponents.
    pub(crate) fn exponential(&self, argument: u64) -> Quadratic {
        Quadratic::Real(self.prime().pow(self.groups().exponential, argument))
    }

    /// The exponential drawn for a value: exp(-u) = 1/exp(u).
    pub(crate) fn drawn_exponential(&self, argument: &Quadratic) -> Quadratic {
        let (magnitude, negated) = self.unsigned(argument);
        if magnitude.is_zero() {
            return self.one();
        }
        let root = self.opaque(Key::new("drawn exponential"), &[&magnitude]);
        let value = self.mul(&root, &root);
        if negated { self.inverse(&value) } else { value }
    }

    /// A value drawn for a key and values.
    pub(crate) fn opaque(&self, key: Key, values: &[&Quadratic]) -> Quadratic {
        let key = values.iter().fold(key, |key, value| {
            let words = value.words();
            words.iter().fold(key.word(words.len() as u64), |key, &word| key.word(word))
        });
        self.draw(&key)
    }

    /// A value drawn for a key and a value, odd in that.
    pub(crate) fn odd(&self, key: Key, argument: &Quadratic) -> Quadratic {
        let (magnitude, negated) = self.unsigned(argument);
        if magnitude.is_zero() {
            return Quadratic::ZERO;
        }
        let value = self.opaque(key, &[&magnitude]);
        if negated { self.neg(&value) } else { value }
    }

    /// The value or its opposite, whichever represents both, and whether the sign was changed.
    pub(crate) fn unsigned(&self, value: &Quadratic) -> (Quadratic, bool) {
        let opposite = self.neg(value);
        if opposite.words() < value.words() { (opposite, true) } else { (value.clone(), false) }
    }

    /// A linear image in GF(p): x + k y for the coordinates x, y with a fixed k, so that sums and multiples stay sums and
    /// multiples.
    pub(super) fn linear_image(&self, value: &Quadratic) -> u64 {
        let prime = self.prime();
        if let Quadratic::Extended(extended) = value {
            let order = extended.generator.order();
            return extended.coefficients.iter().zip(0..).fold(0, |sum, (coefficient, exponent)| {
                let turns =
                    Number::integer(exponent).mul(&Number::whole(order.into()).recip().expect("not 0"));
                let key = Key::new("generator").text(&turns.to_string());
                let factor = if exponent == 0 { prime.one } else { self.word(&key) };
                prime.add(sum, prime.mul(factor, self.linear_image(coefficient)))
            });
        }
        value.words().iter().enumerate().fold(0, |sum, (k, &word)| {
            let factor = if k == 0 { prime.one } else { self.word(&Key::new("coordinate").word(k as u64)) };
            prime.add(sum, prime.mul(factor, word))
        })
    }

    /// The linear image as an element of GF(p).
    pub(crate) fn real_image(&self, value: &Quadratic) -> Quadratic {
        Quadratic::Real(self.linear_image(value))
    }

    /// The linear image as an exponent: an integer below p.
    pub(crate) fn exponent(&self, value: &Quadratic) -> u64 {
        self.prime().residue(self.linear_image(value))
    }

    /// Whether a number has this value.
    pub(crate) fn is_number(&self, value: &Quadratic, number: &Number) -> bool {
        *value == self.number(number)
    }
}
