//! Lanes: independent random points at which expressions are evaluated exactly, each over a prime of its own.
//!
//! The fingerprint of an expression is its value in the first two lanes, the *hash lanes*. What holds signs or roots is
//! compared in all of them: there the sign of u is the quadratic character of its value, +1 or -1 as if by the toss of
//! a coin, and what holds in every lane is an identity of the multiplicative law of signs. [`Quadratic`] has the rules.
//!
//! A lane is a *tower of fields*. The exponent of a member of a group counts modulo the order of the group, so the
//! argument of a sine or an exponential is evaluated once more, modulo that order [Martin 1971; Gonnet 1984]:
//! sin(u) is the sine of u' times a fixed angle of prime order A1, where u' is the value of u in GF(A1), and exp(u) is
//! g^(u'') with the value u'' of u in GF(B1). So the value of f(u) depends on the values of u alone, and the addition
//! theorems hold for arguments of every form. The primes of a lane are
//!
//! * p = -1 mod 110880, so that the angles 2 pi k/110880 are exact and sqrt 2, 3, 5, 7, 11 agree with them;
//! * A1, a factor of p + 1, for angles; then A2 = (A1 - 1)/2, A3 = (A2 - 1)/2, and A4, a factor of A3 - 1;
//! * B1 = (p - 1)/2, for exponentials: all positive elements are members of this group, so every root of them is one,
//!   too; then B2 = (B1 - 1)/2 and B3, a factor of B2 - 1.
//!
//! Functions inside arguments are evaluated one field further up the tower. In the fields of exponents B1 and B2, sines are
//! coordinates of the circle again, because A1 divides B1 + 1 and B2 + 1. In the fields of angles A1 to A3 the sine is
//! (z - 1/z)/2i for a z of the multiplicative group. Such a sine is not real, so the squares of sines would be negative
//! there. Therefore signs and roots do not meet it: where an argument holds any, its sines and cosines are those of
//! drawn points of the circle. In the last field a function of u is drawn for the value of u.

use std::sync::LazyLock;

use super::element::Element;
use super::field::Field;
use super::key::Key;
use super::lanes::{FIELDS_OF_A_LANE, LANES};
use super::quadratic::Quadratic;

#[expect(clippy::cast_possible_truncation, reason = "there are 64 lanes of 8 fields")]
const NUMBER_OF_LANES: u16 = LANES.len() as u16;
#[expect(clippy::cast_possible_truncation, reason = "there are 64 lanes of 8 fields")]
const FIELDS_OF_A_LANE_WORD: u16 = FIELDS_OF_A_LANE as u16;

/// A field of a lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct FieldId {
    index: u16,
    /// Which of the random points over the same primes, and whether sines are real there.
    point: u16,
}

/// The bit of a point that tells that sines are real in the fields of angles.
const REAL_SINES: u16 = 1 << 15;

impl FieldId {
    /// The first fields of the lanes that fingerprints show.
    pub(crate) const HASH: [Self; 2] = [Self::of_lane(0, 0), Self::of_lane(1, 0)];

    const fn of_lane(lane: u16, point: u16) -> Self {
        Self { index: lane * FIELDS_OF_A_LANE_WORD, point }
    }

    /// The first fields of the other lanes, at one of the points over their primes.
    pub(crate) fn others(point: u16) -> impl Iterator<Item = Self> {
        (2..NUMBER_OF_LANES).map(move |lane| Self::of_lane(lane, point))
    }

    /// The first field of one of the other lanes.
    pub(crate) fn other(lane: u16) -> Self {
        Self::of_lane(lane + 2, 0)
    }

    /// Which of the other lanes this field begins, if it begins one, and the point.
    pub(crate) fn other_lane(self) -> Option<(usize, u16)> {
        let lane = self.index as usize / FIELDS_OF_A_LANE;
        let is_other = self.index as usize % FIELDS_OF_A_LANE == 0 && lane >= Self::HASH.len();
        is_other.then(|| (lane - Self::HASH.len(), self.point))
    }

    /// Which of the hash lanes this field begins, if it begins one.
    pub(crate) fn hash_lane(self) -> Option<usize> {
        Self::HASH.iter().position(|&field| field == self)
    }

    pub(crate) fn field(self) -> &'static Field {
        &FIELDS[self.index as usize]
    }

    /// The same field at another point.
    pub(crate) fn at(self, point: u16) -> Self {
        Self { point, ..self }
    }

    /// The coordinate of the random point that is drawn for a key.
    pub(crate) fn draw(self, key: &Key) -> Quadratic {
        self.field().draw(&self.at_point(key))
    }

    /// A positive coordinate.
    pub(crate) fn draw_positive(self, key: &Key) -> Quadratic {
        self.field().draw_positive(&self.at_point(key))
    }

    fn at_point(self, key: &Key) -> Key {
        match self.point & !REAL_SINES {
            0 => *key,
            point => key.word(point.into()),
        }
    }

    /// The field in which the argument of a sine or cosine is evaluated.
    pub(crate) fn of_angles(self) -> Option<Self> {
        let index = match self.place() {
            0 | 5 | 6 => self.index - self.index % FIELDS_OF_A_LANE_WORD + 1,
            1..=3 if self.point & REAL_SINES == 0 => self.index + 1,
            _ => return None,
        };
        Some(Self { index, ..self })
    }

    /// The field in which the argument of an exponential is evaluated.
    pub(crate) fn of_exponents(self) -> Option<Self> {
        let step = match self.place() {
            0 => 5,
            1..=3 | 5 | 6 => 1,
            _ => return None,
        };
        Some(Self { index: self.index + step, ..self })
    }

    /// The same field with real sines, for what holds signs or roots.
    pub(crate) fn with_real_sines(self) -> Self {
        Self { point: self.point | REAL_SINES, ..self }
    }

    fn place(self) -> usize {
        self.index as usize % FIELDS_OF_A_LANE
    }

    /// Whether the group of angles is that of the circle, of order p + 1.
    fn has_circle(self) -> bool {
        matches!(self.place(), 0 | 5 | 6)
    }
}

static FIELDS: LazyLock<Vec<Field>> = LazyLock::new(|| {
    let primes = LANES.iter().flatten().copied();
    primes
        .enumerate()
        .map(|(k, p)| {
            let index = u16::try_from(k).expect("there are some hundred fields");
            let id = FieldId { index, point: 0 };
            let order = |field: Option<FieldId>| {
                field.map(|field| {
                    LANES[field.index as usize / FIELDS_OF_A_LANE][field.index as usize % FIELDS_OF_A_LANE]
                })
            };
            Field::new(p, id.has_circle(), order(id.of_angles()), order(id.of_exponents()))
        })
        .collect()
});

/// The fingerprint of values in the two hash lanes.
pub(crate) fn fingerprint(values: [&Quadratic; 2]) -> Element {
    let image = |k: usize| FieldId::HASH[k].field().linear_image(values[k]);
    Element::from_words([image(0), image(1)])
}

/// The value of a real element in a hash lane.
pub(crate) fn in_hash_lane(element: Element, lane: usize) -> Quadratic {
    Quadratic::Real(element.words()[lane])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::field::TORSION;
    use crate::value::number::Number;
    use crate::value::prime::Prime;
    use crate::value::radical::prime_factors;

    #[test]
    fn the_primes_are_what_the_description_says() {
        for &[p, a1, a2, a3, a4, b1, b2, b3] in &LANES {
            for prime in [p, a1, a2, a3, a4, b1, b2, b3] {
                assert_eq!(prime_factors(&Number::whole(prime.into())).len(), 1, "{prime}");
                assert_eq!(prime % 4, 3);
            }
            assert!(p % TORSION == TORSION - 1 && (p + 1) % a1 == 0 && p - 1 == 2 * b1);
            assert!(a1 == 2 * a2 + 1 && a2 == 2 * a3 + 1 && (a3 - 1) % a4 == 0);
            assert!(b1 == 2 * b2 + 1 && (b2 - 1) % b3 == 0);
            assert!((b1 + 1) % a1 == 0 && (b2 + 1) % a1 == 0);
            for q in [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31] {
                let prime = Prime::new(p);
                assert!(prime.is_square(prime.natural(q)), "{q} modulo {p}");
            }
        }
    }

    #[test]
    fn angles_and_exponentials_are_homomorphisms() {
        for id in FieldId::HASH.into_iter().chain(FieldId::others(0)) {
            let f = id.field();
            let ((c1, s1), (c2, s2)) = (f.angle(5), f.angle(7));
            assert_eq!(f.angle(12).1, f.add(&f.mul(&s1, &c2), &f.mul(&c1, &s2)));
            assert_eq!(f.exponential(12), f.mul(&f.exponential(5), &f.exponential(7)));
            let half = Number::rational(1, 2);
            assert_eq!(f.rational_power(&f.exponential(10), &half), f.exponential(5));
            let (cos, sin) = f.part_of_turn(&Number::rational(1, 4));
            assert!(cos.is_zero() && sin == f.one());
        }
    }
}
