//! Exact angles: the fractions of a turn that are points of known order on the circle.
//!
//! The order of the exact angles divides p + 1. Halves of them down to 1/32 of a turn are exact as well: where the circle
//! has no such point, its cosine is sqrt((1 + cos)/2) in a larger field.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Pow, Zero};

use super::circle;
use super::extended::LARGEST_DEGREE;
use super::field::{Field, TORSION};
use super::key::Key;
use super::number::Number;
use super::prime::fraction_modulo;
use super::quadratic::Quadratic;
use super::radical::prime_factors;

/// The largest power of two in the parts of a turn that are found by halves: 2^this.
const MOST_HALVINGS: u64 = 16;

/// The cosine and the sine of an angle.
type Point = (Quadratic, Quadratic);

impl Field {
    /// The unit cos + i sin of a fraction of a turn.
    ///
    /// In the first field of a lane, the unit of b/d of a turn has the order d also where the circle has no such point.
    pub(crate) fn unit(&self, turns: &Number) -> Quadratic {
        let (mut rest, mut unit) = (turns.clone(), self.one());
        if self.has_odd_roots() {
            for (prime, count) in prime_factors(&Number::whole(turns.denominator())) {
                let power: BigInt = Pow::pow(&prime, count.unsigned_abs());
                if self.is_exact(&power) || prime.is_even() {
                    continue;
                }
                let part = part_over(turns, &power);
                let (Ok(prime), Ok(count)) = (u64::try_from(prime), u32::try_from(count)) else { continue };
                if let Some(factor) = self.unit_of_prime_power(&part, prime, count) {
                    (rest, unit) = (rest.sub(&part), self.mul(&unit, &factor));
                }
            }
        }
        let unit_of_rest = if self.has_odd_roots() && is_power_of_two_beside(&rest, self.groups().torsion.0) {
            self.unit_of_angle(&self.exact_part_of_turn(&rest))
        } else {
            self.unit_of_angle(&self.part_of_turn(&rest))
        };
        self.mul(&unit, &unit_of_rest)
    }

    /// The angle that is a fraction of a turn.
    ///
    /// It is the sum of an exact one and one b/d with other primes in d, which is b times an angle drawn for d, where b
    /// lies between -d/2 and d/2.
    pub(crate) fn part_of_turn(&self, turns: &Number) -> Point {
        let (exact, other) = split(turns, |power| self.is_exact(power));
        let mut point = self.exact_part_of_turn(&exact);
        if !other.is_zero() {
            let prime = self.prime();
            let key = Key::new("part of a turn").text(&other.denominator().to_string());
            let drawn = circle::point(prime, self.word(&key));
            let count = fraction_modulo(&Number::whole(other.numerator()), prime.p + 1).unwrap_or(0);
            point = self.rotate(&point, &real(circle::times(prime, drawn, count)));
        }
        point
    }

    /// Whether an angle is exact whose denominator is this power of a prime number.
    fn is_exact(&self, power: &BigInt) -> bool {
        let largest = if power.is_even() { TORSION } else { self.groups().torsion.0 };
        (BigInt::from(largest) % power).is_zero()
    }

    fn exact_part_of_turn(&self, turns: &Number) -> Point {
        let (order, step) = self.groups().torsion;
        let (on_circle, halved) = split(turns, |power| (BigInt::from(order) % power).is_zero());
        let steps = on_circle.mul(&Number::whole(order.into()));
        let point = real(circle::times(self.prime(), step, fraction_modulo(&steps, order).unwrap_or(0)));
        match halved.to_small() {
            Some((count, denominator)) if denominator > 1 => {
                let part = self.part_by_halves(denominator.unsigned_abs(), order);
                self.rotate(&point, &self.multiple(part, count))
            }
            _ => point,
        }
    }

    /// One part in a power of two of a turn, by halves of what the circle has.
    fn part_by_halves(&self, parts: u64, order: u64) -> Point {
        let mut known = 1 << order.trailing_zeros();
        let mut point = real(circle::times(self.prime(), self.groups().torsion.1, order / known));
        while known < parts {
            let square = self.half(&self.add(&self.one(), &point.0));
            let Some(cos) = self.closure.sqrt(&square) else { break }; // never: it has few coordinates
            let sin = self.div(&self.half(&point.1), &cos);
            (point, known) = ((cos, sin), 2 * known);
        }
        point
    }

    /// The principal power of an element r e^(i theta) with a positive r in GF(p) and an exact angle, if it is one, and k
    /// theta is exact: r^k e^(i k theta) for the theta above -pi and up to pi.
    pub(super) fn power_at_exact_angle(&self, base: &Quadratic, exponent: &Number) -> Option<Quadratic> {
        let Quadratic::Wide(words) = base else { return None };
        let &[x, y] = &words[..] else { return None };
        let prime = self.prime();
        let square = prime.add(prime.mul(x, x), prime.mul(y, y));
        if !prime.is_square(square) {
            return None;
        }
        let magnitude = prime.root(square);
        let scale = prime.inverse(magnitude);
        let turns = self.turns_of((prime.mul(x, scale), prime.mul(y, scale)))?.mul(exponent);
        let powers = prime_factors(&Number::whole(turns.denominator()));
        let is_exact = |(q, count): (BigInt, i64)| self.is_exact(&Pow::pow(q, count.unsigned_abs()));
        if !powers.into_iter().all(is_exact) {
            return None;
        }
        Some(self.mul(&self.power_of_real(magnitude, exponent), &self.unit(&turns)))
    }

    /// The fraction of a turn, above -1/2 and up to 1/2, that an angle is, if it is an exact one [Pohlig & Hellman 1978].
    fn turns_of(&self, point: circle::Point) -> Option<Number> {
        let prime = self.prime();
        let (order, step) = self.groups().torsion;
        if circle::times(prime, point, order) != circle::identity(prime) {
            return None;
        }
        let mut turns = Number::integer(0);
        for (q, count) in prime_factors(&Number::whole(order.into())) {
            let power = Pow::pow(u64::try_from(q).ok()?, u32::try_from(count).ok()?);
            let (base, target) =
                (circle::times(prime, step, order / power), circle::times(prime, point, order / power));
            let mut multiple = circle::identity(prime);
            let mut residue = 0;
            while multiple != target {
                (multiple, residue) = (circle::rotate(prime, multiple, base), residue + 1);
            }
            // The number of steps is this residue modulo the power, and any one modulo the others.
            let inverse = fraction_modulo(&Number::whole((order / power).into()).recip().ok()?, power)?;
            let part = Number::whole((residue * inverse % power).into());
            turns = turns.add(&part.mul(&Number::whole(power.into()).recip().ok()?));
        }
        let half = Number::rational(1, 2);
        Some(half.sub(&half.sub(&turns).sub(&half.sub(&turns).floor())))
    }

    fn rotate(&self, a: &Point, b: &Point) -> Point {
        let cos = self.sub(&self.mul(&a.0, &b.0), &self.mul(&a.1, &b.1));
        (cos, self.add(&self.mul(&a.0, &b.1), &self.mul(&a.1, &b.0)))
    }

    fn multiple(&self, (cos, sin): Point, count: i64) -> Point {
        let mut base = if count < 0 { (cos, self.neg(&sin)) } else { (cos, sin) };
        let (mut sum, mut count) = ((self.one(), Quadratic::ZERO), count.unsigned_abs());
        while count > 0 {
            if count & 1 == 1 {
                sum = self.rotate(&sum, &base);
            }
            (base, count) = (self.rotate(&base, &base), count >> 1);
        }
        sum
    }
}

/// Whether a root of this degree of what may be negative needs products of units that have more than 128 coordinates
/// together. (Where a single unit has more, it is a drawn point of the circle.)
pub(crate) fn needs_large_products(degree: &BigInt) -> bool {
    let coordinates = prime_factors(&Number::whole(degree.clone())).into_iter().map(|(prime, count)| {
        let power: BigInt = Pow::pow(&prime, count.unsigned_abs());
        match power.gcd(&TORSION.into()) {
            _ if prime.is_even() => BigInt::one(), // square roots
            held if held.is_one() => &power / &prime * (prime - 1),
            held => power / held,
        }
    });
    let units: Vec<BigInt> = coordinates.filter(|each| !each.is_one()).collect();
    units.len() > 1 && units.into_iter().product::<BigInt>() > LARGEST_DEGREE.into()
}

/// The b/d of a fraction of a turn, which is the sum of that and of one with other primes in the denominator.
fn part_over(turns: &Number, d: &BigInt) -> Number {
    let others = turns.denominator() / d;
    let b = (turns.numerator() * others.modinv(d).unwrap_or_default()).mod_floor(d);
    Number::from_big(b, d.clone()).expect("a denominator is positive")
}

/// Whether a denominator divides the order of the exact angles, but for a power of two that is not too large.
fn is_power_of_two_beside(turns: &Number, order: u64) -> bool {
    let denominator = turns.denominator();
    let halvings = denominator.trailing_zeros().unwrap_or(0);
    halvings <= MOST_HALVINGS && (BigInt::from(order) % (denominator >> halvings)).is_zero()
}

fn real((cos, sin): circle::Point) -> Point {
    (Quadratic::Real(cos), Quadratic::Real(sin))
}

/// A fraction of a turn as the sum of one whose denominator has the powers of primes that pass a test, and one between
/// -1/2 and 1/2 with the others.
fn split(turns: &Number, passes: impl Fn(&BigInt) -> bool) -> (Number, Number) {
    let (mut exact, mut other) = (BigInt::one(), BigInt::one());
    for (prime, count) in prime_factors(&Number::whole(turns.denominator())) {
        let power: BigInt = Pow::pow(prime, count.unsigned_abs());
        if passes(&power) {
            exact *= power;
        } else {
            other *= power;
        }
    }
    // turns = a/exact + b/other
    let inverse = exact.modinv(&other).unwrap_or_default();
    let mut b = (turns.numerator() * inverse).mod_floor(&other);
    if &b * 2 > other {
        b -= &other;
    }
    let rest = Number::from_big(b, other).expect("a denominator is positive");
    (turns.sub(&rest), rest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::lane::FieldId;

    fn fields() -> impl Iterator<Item = FieldId> {
        let first: Vec<FieldId> = FieldId::HASH.into_iter().chain(FieldId::others(0)).collect();
        let angles: Vec<FieldId> = first.iter().filter_map(|field| field.of_angles()).collect();
        let inner: Vec<FieldId> = angles.iter().filter_map(|field| field.of_angles()).collect();
        first.into_iter().chain(angles).chain(inner)
    }

    #[test]
    fn parts_of_a_turn_add_up_in_all_fields() {
        for id in fields() {
            let f = id.field();
            let part = f.part_of_turn(&Number::rational(3, 16));
            let one_turn = f.multiple(part, 16);
            assert_eq!(one_turn, (f.one(), Quadratic::ZERO));
            let (quarter, eighth) = (f.part_of_turn(&Number::rational(1, 4)), Number::rational(1, 8));
            assert_eq!(f.multiple(f.part_of_turn(&eighth), 2), quarter);
        }
    }

    #[test]
    fn odd_roots_of_square_roots_are_principal() {
        for id in fields() {
            let f = id.field();
            for seed in 0..6 {
                let square = f.draw(&Key::new("square").word(seed));
                let root = f.rational_power(&square, &Number::rational(1, 2));
                for degree in [3, 5, 7, 9, 11] {
                    if f.groups().torsion.0 % degree != 0 {
                        continue;
                    }
                    let exponent = Number::whole(degree.into()).recip().expect("not 0");
                    let odd = f.rational_power(&root, &exponent);
                    assert_eq!(f.power(&odd, &Number::whole(degree.into())), root);
                    let half = exponent.mul(&Number::rational(1, 2));
                    assert_eq!(odd, f.rational_power(&square, &half));
                }
            }
        }
    }
}
