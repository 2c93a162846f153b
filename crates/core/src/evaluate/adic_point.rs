//! A point of the q-adic integers, and the roots that values have there.
//!
//! A square root squares to its argument, which half of all units allow. So further points are tried where some have
//! no root. If there are many roots, those that are missing are drawn. Of two opposite roots one is drawn, but sqrt(4 u) is
//! twice sqrt(u).

use num_bigint::BigInt;
use num_traits::One;
use std::cell::{Cell, RefCell};

use crate::value::{Adic, Adics, Coefficient, Element, FieldId, Key, Number, Quadratic};

use super::node::in_hash_lanes;

/// How many points there are at which arguments are zero. At as many others sines and exponentials are drawn: these serve
/// where a value is zero at all of the first.
pub(super) const POINTS: u16 = 5;

/// How often a point is drawn again if it has no roots of some values.
pub(super) const TRIALS: u16 = 24;

/// If there are more different roots, a point is not drawn again.
const MOST_ROOTS: usize = 4;

/// A point of the q-adic integers of a prime.
pub(super) struct AdicPoint<'a, C> {
    pub(super) adics: &'a Adics<C>,
    number: u16,
    trial: u16,
    /// The roots that are known, with the fingerprints of their squares.
    roots: RefCell<Vec<(Element, Adic<C>)>>,
    misses_roots: Cell<bool>,
    has_pole: Cell<bool>,
}

impl<'a, C: Coefficient> AdicPoint<'a, C> {
    pub(super) fn new(adics: &'a Adics<C>, number: u16, trial: u16) -> Self {
        Self {
            adics,
            number,
            trial,
            roots: RefCell::default(),
            misses_roots: Cell::new(false),
            has_pole: Cell::new(false),
        }
    }

    /// Whether some values had no root here.
    pub(super) fn misses_roots(&self) -> bool {
        self.misses_roots.get()
    }

    /// Whether something has a pole here: what was made of it has no value.
    pub(super) fn has_pole(&self) -> bool {
        self.has_pole.get()
    }

    /// Whether the roots are so few that they may all exist at another point.
    pub(super) fn is_to_be_drawn_again(&self) -> bool {
        self.roots.borrow().len() < MOST_ROOTS
    }

    pub(super) fn has_plain_arguments(&self) -> bool {
        self.number < POINTS
    }

    /// The lane whose signs are those here.
    pub(super) fn lane(&self) -> FieldId {
        FieldId::other(self.number % POINTS)
    }

    pub(super) fn one(&self) -> Adic<C> {
        self.adics.integer(&BigInt::one())
    }

    pub(super) fn key(&self, key: Key) -> Key {
        let key = key.word(self.number.into());
        if self.trial == 0 { key } else { key.word(self.trial.into()) }
    }

    /// The key of what has these values in the hash lanes, or their opposites.
    pub(super) fn key_of(&self, in_field: impl Fn(FieldId) -> Quadratic) -> Key {
        self.key_of_fingerprint(in_hash_lanes(in_field))
    }

    fn key_of_fingerprint(&self, value: Element) -> Key {
        let [first, second] = value.unsigned().0.words();
        self.key(Key::new("digits").word(first).word(second))
    }

    pub(super) fn half(&self, a: &Adic<C>) -> Adic<C> {
        self.adics.mul(&self.adics.rational(&Number::rational(1, 2)), a)
    }

    /// A rational power of a value, which is that of something with these values in the hash lanes.
    ///
    /// The root of a unit that has none here is drawn for the values of what is left without whole powers of the prime, so
    /// that q^2 u has the root that is q times that of u. So are roots of other degrees.
    pub(super) fn power(
        &self,
        value: &Adic<C>,
        exponent: &Number,
        in_field: impl Fn(FieldId) -> Quadratic,
    ) -> Adic<C> {
        if value.leading().is_none() && exponent.is_negative() {
            self.has_pole.set(true);
        }
        if let Some((count, 2)) = exponent.to_small()
            && let Some(root) = self.square_root(value, &in_field)
        {
            return self.adics.power(&root, count);
        }
        self.adics.rational_power(value, exponent, |whole| {
            let key = self.key_of(|field| {
                let f = field.field();
                f.mul(&f.power(&f.number(&self.adics.prime()), &whole.neg()), &in_field(field))
            });
            key.text(&exponent.to_string())
        })
    }

    fn square_root(&self, square: &Adic<C>, in_field: impl Fn(FieldId) -> Quadratic) -> Option<Adic<C>> {
        let value = in_hash_lanes(in_field);
        let known = self.roots.borrow().iter().find_map(|(known, root)| {
            let factor = rational_root(&(value * known.inverse()).to_simple_rational()?)?;
            Some(self.adics.mul(&self.adics.rational(&factor), root))
        });
        if known.is_some() {
            return known;
        }
        let bit = self.key_of_fingerprint(value).text("root").draw_word(0) & 1 == 1;
        let root = self.adics.square_root(square, bit);
        match &root {
            Some(root) => self.roots.borrow_mut().push((value, root.clone())),
            None => self.misses_roots.set(true),
        }
        root
    }
}

/// The root of a number that is a square.
fn rational_root(square: &Number) -> Option<Number> {
    if square.is_negative() {
        return None;
    }
    let (num, den) = (square.numerator().sqrt(), square.denominator().sqrt());
    let root = Number::from_big(num, den).ok()?;
    root.mul(&root).same_value(square).then_some(root)
}
