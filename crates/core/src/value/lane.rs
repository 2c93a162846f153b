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
//! theorems hold for arguments of every form. Functions inside arguments are evaluated one field further up the tower:
//!
//! | field | is | angles in | exponents in |
//! |---|---|---|---|
//! | p | -1 mod 110880, so that the angles 2 pi k/110880 are exact and sqrt 2, 3, 5, 7, 11 agree with them | A1 | B1 |
//! | B1 | (p - 1)/2: all positive elements are members of this group, so every root of them is one, too | A1 | B2 |
//! | B2 | (B1 - 1)/2 | A1 | B3 |
//! | B3 | a factor of B2 - 1 | | |
//! | A1 | a factor of p + 1, and so of B1 + 1 and B2 + 1; -1 mod 240 | C1 | A2 |
//! | A2 | (A1 - 1)/2 | C1 | A3 |
//! | A3 | a factor of A2 - 1 | | |
//! | C1 | a factor of A1 + 1, and so of A2 + 1; -1 mod 120 | C2 | C3 |
//! | C2 | a factor of C1 + 1 | | |
//! | C3 | a factor of C1 - 1 | | |
//!
//! Angles are points of the circle in each of these fields, so that sines are real and their squares positive. In the
//! fields without angles or exponents, a sine or an exponential of u is drawn for the value of u.

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
    /// Which of the random points over the same primes, and in the bits of [`TURNED_BY`] one more than the place of the
    /// field that tells which logarithms are larger by pi here, if one does.
    point: u16,
}

/// See [`FieldId::with_turned_logarithms`].
const TURNED_BY: u32 = 12;

/// The bit of points at which complex symbols lie elsewhere.
const MOVED: u16 = 1 << (TURNED_BY - 1);

/// The bit of second points, see [`FieldId::exponent_of`].
const SECOND: u16 = 1 << (TURNED_BY - 2);

/// The bit of second points of fields whose logarithms are turned by a field that is not at its second point.
const TURNED_BY_FIRST: u16 = 1 << (TURNED_BY - 3);

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
        let is_other = (self.index as usize).is_multiple_of(FIELDS_OF_A_LANE) && lane >= Self::HASH.len();
        is_other.then(|| (lane - Self::HASH.len(), self.point))
    }

    /// Whether this field begins a lane, at any of its points.
    pub(crate) fn is_first(self) -> bool {
        self.index.is_multiple_of(FIELDS_OF_A_LANE_WORD)
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

    /// The first field of the lane, at the same point: signs are those of the values there.
    pub(crate) fn of_signs(self) -> Self {
        let index = self.index - self.index % FIELDS_OF_A_LANE_WORD;
        Self { index, point: self.unturned().point & !SECOND }
    }

    /// Where the arguments of functions are evaluated: at the points of a field above this one, if there is one.
    pub(crate) fn points_above(self, above: Option<Self>) -> impl Iterator<Item = Self> {
        std::iter::once(above.unwrap_or(self)).chain(above.and_then(Self::second))
    }

    /// The same field at the second point at which arguments are evaluated, if they are: in all lanes but the hash lanes.
    fn second(self) -> Option<Self> {
        let is_first = self.point & SECOND == 0;
        let is_other = self.index as usize / FIELDS_OF_A_LANE >= Self::HASH.len();
        (is_first && is_other).then_some(Self { point: self.point | SECOND, ..self })
    }

    /// The exponent of a generator of a group that an argument is, from its values in this field of exponents or angles.
    ///
    /// A root of a square is a modulus with a sign of its own in each field. If an argument holds one and is known up to its
    /// sign alone, its cosine would be known, and the derivative of this cosine would not. So arguments have values
    /// at two points of the field, where the signs of such roots differ, and the exponent is a sum of both.
    pub(crate) fn exponent_of(self, value: impl Fn(Self) -> Quadratic) -> u64 {
        let f = self.field();
        let first = value(self);
        f.exponent(&match self.second() {
            Some(second) => f.add(&first, &f.mul(&f.draw(&Key::new("second point")), &value(second))),
            None => first,
        })
    }

    /// The coordinate of the random point that is drawn for a key.
    pub(crate) fn draw(self, key: &Key) -> Quadratic {
        self.field().draw(&self.at_point(key))
    }

    /// A positive coordinate.
    pub(crate) fn draw_positive(self, key: &Key) -> Quadratic {
        self.field().draw_positive(&self.at_point(key))
    }

    /// The coordinate of a complex symbol.
    pub(crate) fn draw_complex(self, key: &Key) -> Quadratic {
        if self.point & MOVED == 0 { self.draw(key) } else { self.draw(&key.word(MOVED.into())) }
    }

    fn at_point(self, key: &Key) -> Key {
        match self.unturned().point & !MOVED {
            0 => *key,
            point => key.word(point.into()),
        }
    }

    /// The same point, but for the complex symbols, which lie elsewhere.
    pub(crate) fn with_complex_moved(self) -> Self {
        Self { point: self.point | MOVED, ..self }
    }

    /// The field in which the argument of a sine or cosine is evaluated.
    pub(crate) fn of_angles(self) -> Option<Self> {
        self.above(|place| place.angles)
    }

    /// The field in which the argument of an exponential is evaluated.
    pub(crate) fn of_exponents(self) -> Option<Self> {
        self.above(|place| place.exponents)
    }

    /// The field of what is inside a function: its logarithms are not turned.
    fn above(self, which: impl Fn(&Place) -> Option<u16>) -> Option<Self> {
        let place = self.index % FIELDS_OF_A_LANE_WORD;
        let above = which(&TOWER[place as usize])?;
        Some(Self { index: self.index - place + above, ..self.unturned() })
    }

    /// The same point, but the logarithms of what is negative in another field of the lane are larger by pi: the
    /// difference to the values without that is the imaginary part, if log u is log |u| + i pi for a negative u.
    pub(crate) fn with_turned_logarithms(self, by: Self) -> Self {
        let place = by.index % FIELDS_OF_A_LANE_WORD;
        let differs = (self.point ^ by.point) & SECOND != 0;
        let which = if differs { TURNED_BY_FIRST } else { 0 };
        Self { point: self.unturned().point | which | (place + 1) << TURNED_BY, ..self }
    }

    /// The field that tells which logarithms are larger by pi here.
    pub(crate) fn turned_by(self) -> Option<Self> {
        let place = (self.point >> TURNED_BY).checked_sub(1)?;
        let lane = self.index - self.index % FIELDS_OF_A_LANE_WORD;
        let unturned = self.unturned().point;
        let point = if self.point & TURNED_BY_FIRST == 0 { unturned } else { unturned & !SECOND };
        Some(Self { index: lane + place, point })
    }

    /// The same point without larger logarithms.
    pub(crate) fn unturned(self) -> Self {
        Self { point: self.point & ((1 << TURNED_BY) - 1) & !TURNED_BY_FIRST, ..self }
    }

    fn prime(self) -> u64 {
        LANES[self.index as usize / FIELDS_OF_A_LANE][self.index as usize % FIELDS_OF_A_LANE]
    }
}

/// Which fields of a lane have the orders of the groups of a field.
struct Place {
    angles: Option<u16>,
    exponents: Option<u16>,
}

/// The fields of a lane, in the order of the table of primes.
const TOWER: [Place; FIELDS_OF_A_LANE] = {
    const fn place(angles: Option<u16>, exponents: Option<u16>) -> Place {
        Place { angles, exponents }
    }
    [
        place(Some(1), Some(4)), // p
        place(Some(7), Some(2)), // A1
        place(Some(7), Some(3)), // A2
        place(None, None),       // A3
        place(Some(1), Some(5)), // B1
        place(Some(1), Some(6)), // B2
        place(None, None),       // B3
        place(Some(8), Some(9)), // C1
        place(None, None),       // C2
        place(None, None),       // C3
    ]
};

static FIELDS: LazyLock<Vec<Field>> = LazyLock::new(|| {
    let number = NUMBER_OF_LANES * FIELDS_OF_A_LANE_WORD;
    let ids = (0..number).map(|index| FieldId { index, point: 0 });
    ids.map(|id| {
        Field::new(id.prime(), id.of_angles().map(FieldId::prime), id.of_exponents().map(FieldId::prime))
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
    use crate::value::lanes::LARGEST_SQUARE;
    use crate::value::number::Number;
    use crate::value::prime::Prime;
    use crate::value::radical::prime_factors;

    #[test]
    fn the_primes_are_what_the_description_says() {
        for lane in &LANES {
            for &prime in lane {
                assert_eq!(prime_factors(&Number::whole(prime.into())).len(), 1, "{prime}");
                assert_eq!(prime % 4, 3);
            }
            let &[p, a1, a2, a3, b1, b2, b3, c1, c2, c3] = lane;
            assert!(p % TORSION == TORSION - 1 && p == 2 * b1 + 1 && b1 == 2 * b2 + 1 && (b2 - 1) % b3 == 0);
            assert!((p + 1) % a1 == 0 && (b1 + 1) % a1 == 0 && (b2 + 1) % a1 == 0);
            assert!(a1 == 2 * a2 + 1 && (a2 - 1) % a3 == 0 && (a1 + 1) % c1 == 0 && (a2 + 1) % c1 == 0);
            assert!((c1 + 1) % c2 == 0 && (c1 - 1) % c3 == 0);
            for (field, largest) in [(p, LARGEST_SQUARE), (b1, 11), (b2, 11), (a1, 5), (a2, 5), (c1, 5)] {
                let prime = Prime::new(field);
                for q in (2..=largest).filter(|&q| prime_factors(&Number::whole(q.into())).len() == 1) {
                    assert!(prime.is_square(prime.natural(q)), "{q} modulo {field}");
                }
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
