//! Roots of odd degree of what is not real, by its polar form.
//!
//! The elements of a field other than zero form a cyclic group. Its order is h m, where h has the primes 2, 3, 5, 7 and 11
//! and m has others. An element is therefore r e^(i theta) with an exact angle, a multiple of 2 pi/h, and an r that has one
//! root of each degree that shares no factor with m. The root of degree d is r^(1/d) e^(i theta/d) with the theta above -pi
//! and up to pi: its power d is the element. So are principal roots of units, and those of real numbers times units.
//! Other roots are some branch, that of which theta/d is the angle.

use num_bigint::BigInt;
use num_traits::{One, Pow, ToPrimitive};

use super::extended::{dimensions, place};
use super::field::Field;
use super::number::Number;
use super::quadratic::{Generator, Quadratic};

/// The primes of exact angles.
const PRIMES: [u64; 4] = [3, 5, 7, 11];

/// Roots in fields of larger degree are drawn.
const LARGEST_DEGREE: usize = 18;

/// The group of a field that holds an element.
struct Group {
    /// The order of the exact angles, and that of the other elements.
    exact: BigInt,
    other: BigInt,
    /// The primes of the order of the exact angles, their powers in it, and units of these orders.
    units: Vec<(u64, u32, Quadratic)>,
}

impl Field {
    /// A root of odd degree; `None` if the field is too large, or if some elements have several roots without exact angles.
    pub(super) fn odd_root(&self, a: &Quadratic, degree: u64) -> Option<Quadratic> {
        if let Quadratic::Extended(a) = a
            && !self.is_root_of_circle(a.generator)
        {
            // c z^k with the root c^(1/d) e^(i theta/d) of z^k = e^(i theta)
            let (coefficient, exponent) = a.single_term()?;
            let root = self.root_of_odd_degree(coefficient, degree)?;
            let turns = Number::whole(exponent.into()).mul(&part(a.generator.order()));
            return Some(self.mul(&root, &self.unit(&centered(&turns).mul(&part(degree)))));
        }
        let group = self.group_of(a)?;
        let inverse = (&group.exact * degree).modinv(&group.other)?;
        let root = self.large_power(a, &(&group.exact * inverse));
        let turns = self.turns_in(&group, a)?;
        Some(self.mul(&root, &self.unit(&turns.mul(&part(degree)))))
    }

    fn root_of_odd_degree(&self, a: &Quadratic, degree: u64) -> Option<Quadratic> {
        match a {
            &Quadratic::Real(word) => Some(self.power_of_real(word, &part(degree))),
            _ => self.odd_root(a, degree),
        }
    }

    fn group_of(&self, a: &Quadratic) -> Option<Group> {
        let mut generators = Vec::new();
        let dimension = dimensions(a, &mut generators).max(2);
        let degree = generators.iter().fold(dimension, |all, each| all * place(self.degree(*each)));
        if degree > LARGEST_DEGREE || !generators.iter().all(|each| self.is_root_of_circle(*each)) {
            return None;
        }
        let order: BigInt = Pow::pow(BigInt::from(self.prime().p), degree) - 1;
        let halvings = u32::try_from(order.trailing_zeros()?).ok()?;
        let two = self.unit(&part(1 << halvings));
        let mut units = vec![(2, halvings, two)];
        for prime in PRIMES {
            let (held, unit) = self.unit_on_circle(prime)?;
            units.push(match generators.iter().find(|generator| generator.prime == prime) {
                Some(generator) => (prime, generator.count, self.power_of_generator(*generator, 1)),
                None => (prime, held, unit.clone()),
            });
        }
        let exact = units.iter().fold(BigInt::one(), |all, (prime, count, _)| all * prime.pow(*count));
        let other = &order / &exact;
        Some(Group { exact, other, units })
    }

    /// The fraction of a turn, above -1/2 and up to 1/2, that the exact angle of an element is [Pohlig & Hellman 1978].
    fn turns_in(&self, group: &Group, a: &Quadratic) -> Option<Number> {
        let unit = self.large_power(a, &(&group.other * group.other.modinv(&group.exact)?));
        let mut turns = Number::integer(0);
        for (prime, count, base) in &group.units {
            let order = prime.pow(*count);
            let others = &group.exact / order;
            let target = self.large_power(&unit, &(&others * others.modinv(&order.into())?));
            let mut power = self.one();
            let mut parts = 0u64;
            while power != target {
                (power, parts) = (self.mul(&power, base), parts + 1);
                if parts == order {
                    return None; // never: the powers of the base are all units of this order
                }
            }
            turns = turns.add(&Number::whole(parts.into()).mul(&part(order)));
        }
        Some(centered(&turns))
    }

    /// The power with a positive exponent of any size.
    fn large_power(&self, a: &Quadratic, exponent: &BigInt) -> Quadratic {
        let mut power = self.one();
        for bit in (0..exponent.bits()).rev() {
            power = self.mul(&power, &power);
            if exponent.bit(bit) {
                power = self.mul(&power, a);
            }
        }
        power
    }

    /// The square root of an element of an extension by units of odd order, up to the sign; `None` if it is too large.
    ///
    /// In a field of odd degree m over one with q elements, u^(1 + q + ... + q^(m - 1)) = u^(2 k + 1) is the norm N of u, so
    /// that sqrt(N)/u^k is a root of u.
    pub(super) fn square_root_of_extended(&self, a: &Quadratic) -> Option<Quadratic> {
        let Quadratic::Extended(extended) = a else { return self.closure.sqrt(a) };
        let generator = extended.generator;
        if !self.is_root_of_circle(generator) {
            let (coefficient, exponent) = extended.single_term()?;
            let half = self.power_of_generator(generator, exponent * generator.order().div_ceil(2));
            return Some(self.mul(&self.square_root_of_extended(coefficient)?, &half));
        }
        let mut generators = Vec::new();
        let dimension = dimensions(a, &mut generators).max(2);
        let degree = generators.iter().fold(1, |all, each| all * self.degree(*each));
        if dimension * place(degree) > LARGEST_DEGREE
            || !generators.iter().all(|each| self.is_root_of_circle(*each))
        {
            return None;
        }
        let q: BigInt = Pow::pow(BigInt::from(self.prime().p), dimension);
        let conjugate = |a: &Quadratic, times: u64| {
            generators.iter().fold(a.clone(), |a, generator| {
                let order = generator.order();
                let power = q.modpow(&times.into(), &order.into()).to_u64().unwrap_or(1);
                self.conjugated_everywhere(&a, *generator, power)
            })
        };
        let part = self.large_power(a, &((&q + 1u32) / 2u32));
        let (mut power, mut norm) = (self.one(), a.clone());
        for k in 1..degree {
            norm = self.mul(&norm, &conjugate(a, k));
            if k % 2 == 1 {
                power = self.mul(&power, &conjugate(&part, k));
            }
        }
        let root = self.closure.sqrt(&norm)?;
        Some(self.mul(&root, &self.inverse(&power)))
    }

    /// The element with a power of a generator for that, also in coefficients.
    fn conjugated_everywhere(&self, a: &Quadratic, generator: Generator, power: u64) -> Quadratic {
        match a {
            Quadratic::Extended(extended) if extended.generator.prime > generator.prime => {
                extended.map(|each| self.conjugated_everywhere(each, generator, power))
            }
            Quadratic::Extended(_) => self.conjugated(a, generator, power),
            _ => a.clone(),
        }
    }
}

/// One part in a number of parts.
fn part(parts: u64) -> Number {
    Number::whole(parts.into()).recip().expect("a positive number of parts")
}

/// The fraction of a turn above -1/2 and up to 1/2 that is the same angle.
pub(super) fn centered(turns: &Number) -> Number {
    let half = Number::rational(1, 2);
    half.sub(&half.sub(turns).sub(&half.sub(turns).floor()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::{FieldId, Key};

    fn fields() -> impl Iterator<Item = FieldId> {
        FieldId::HASH.into_iter().chain(FieldId::others(0).take(10))
    }

    fn power(f: &Field, a: &Quadratic, exponent: u64) -> Quadratic {
        f.power(a, &Number::whole(exponent.into()))
    }

    #[test]
    fn units_of_all_small_orders_add_up() {
        for f in fields().map(FieldId::field) {
            for parts in [3, 9, 13, 14, 25, 26, 27, 64, 81, 91, 109, 121, 125, 250] {
                let unit = f.unit(&part(parts));
                assert_eq!(power(f, &unit, parts), f.one(), "{parts}");
                for divisor in [2, 3, 5, 7, 11, 13] {
                    if parts % divisor == 0 {
                        assert_ne!(power(f, &unit, parts / divisor), f.one(), "{parts}");
                        assert_eq!(power(f, &unit, divisor), f.unit(&part(parts / divisor)));
                    }
                }
                let inverse = f.unit(&part(parts).neg());
                assert_eq!(f.mul(&unit, &inverse), f.one());
                let sum = f.add(&unit, &f.one());
                assert_eq!(f.mul(&sum, &f.inverse(&sum)), f.one(), "{parts}");
            }
        }
    }

    #[test]
    fn roots_have_the_powers_that_they_are_roots_of() {
        for id in fields() {
            let f = id.field();
            for seed in 0..4 {
                let square = f.draw(&Key::new("square").word(seed));
                let addend = f.draw(&Key::new("addend").word(seed));
                let mut base = f.rational_power(&square, &Number::rational(1, 2));
                for degree in [3, 2, 3] {
                    base = f.add(&base, &addend);
                    let root = f.rational_power(&base, &part(degree));
                    assert_eq!(power(f, &root, degree), base, "{degree} {seed}");
                    let positive = f.mul(&addend, &addend);
                    let multiple = f.rational_power(&f.mul(&positive, &base), &part(degree));
                    assert_eq!(multiple, f.mul(&f.rational_power(&positive, &part(degree)), &root));
                    base = root;
                }
            }
        }
    }

    #[test]
    fn roots_of_negative_values_are_principal() {
        for f in fields().map(FieldId::field) {
            let minus_two = f.number(&Number::integer(-2));
            for degree in [13, 27, 35, 109] {
                let root = f.rational_power(&minus_two, &part(degree));
                assert_eq!(power(f, &root, degree), minus_two);
                let modulus = f.rational_power(&f.neg(&minus_two), &part(degree));
                assert_eq!(root, f.mul(&modulus, &f.unit(&part(2 * degree))));
            }
        }
    }
}
