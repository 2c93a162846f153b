//! Sums and multiples of angles, which are points (cos, sin) of the unit circle, by the addition theorems.

use crate::value::{Adic, Adics, Coefficient, Field, Number, Quadratic};

/// The numbers that the coordinates of points are.
pub(super) trait Ring {
    type Element: Clone;

    fn integer(&self, integer: i64) -> Self::Element;
    fn add(&self, a: &Self::Element, b: &Self::Element) -> Self::Element;
    fn mul(&self, a: &Self::Element, b: &Self::Element) -> Self::Element;

    fn neg(&self, a: &Self::Element) -> Self::Element {
        self.mul(&self.integer(-1), a)
    }
}

impl Ring for Field {
    type Element = Quadratic;

    fn integer(&self, integer: i64) -> Quadratic {
        self.number(&Number::integer(integer))
    }

    fn add(&self, a: &Quadratic, b: &Quadratic) -> Quadratic {
        self.add(a, b)
    }

    fn mul(&self, a: &Quadratic, b: &Quadratic) -> Quadratic {
        self.mul(a, b)
    }
}

impl<C: Coefficient> Ring for Adics<C> {
    type Element = Adic<C>;

    fn integer(&self, integer: i64) -> Adic<C> {
        Adics::integer(self, &integer.into())
    }

    fn add(&self, a: &Adic<C>, b: &Adic<C>) -> Adic<C> {
        self.add(a, b)
    }

    fn mul(&self, a: &Adic<C>, b: &Adic<C>) -> Adic<C> {
        self.mul(a, b)
    }
}

/// The cosine and the sine of an angle.
pub(super) type Point<E> = (E, E);

/// The sum of two angles.
pub(super) fn rotate<R: Ring>(ring: &R, a: &Point<R::Element>, b: &Point<R::Element>) -> Point<R::Element> {
    let cos = ring.add(&ring.mul(&a.0, &b.0), &ring.neg(&ring.mul(&a.1, &b.1)));
    let sin = ring.add(&ring.mul(&a.0, &b.1), &ring.mul(&a.1, &b.0));
    (cos, sin)
}

/// A multiple of an angle.
pub(super) fn multiple<R: Ring>(ring: &R, point: Point<R::Element>, count: i64) -> Point<R::Element> {
    let (cos, sin) = point;
    let mut base = if count < 0 { (cos, ring.neg(&sin)) } else { (cos, sin) };
    let mut sum = (ring.integer(1), ring.integer(0));
    let mut count = count.unsigned_abs();
    while count > 0 {
        if count & 1 == 1 {
            sum = rotate(ring, &sum, &base);
        }
        base = rotate(ring, &base, &base);
        count >>= 1;
    }
    sum
}
