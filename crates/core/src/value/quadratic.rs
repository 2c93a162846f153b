//! The quadratic closure of a prime field: GF(p), GF(p^2), GF(p^4), ..., in which every element has a square root.
//!
//! Each field L of the tower has 2^k coordinates over GF(p), and the next one is L(g) with g^2 = d for a fixed d that is
//! no square in L: i^2 = -1, j^2 = n + i with n^2 + 1 no square, k^2 = j, and so on. An element of L is a square in L if
//! its norm is a square in the field below, down to GF(p) [Lidl & Niederreiter 1997, sec. 2.3].
//!
//! The *leading coordinate* of an element is the first one that is not zero, and an element is *positive* if that is a
//! square: 1 is, -1 is not, and products of positive elements of GF(p) are. Of two square roots, the positive one is
//! taken. So in GF(p) sqrt(u v) = sqrt(u) sqrt(v) for a positive u, and sqrt(u^2) = |u| = +-u everywhere.

use std::borrow::Cow;

use super::prime::Prime;

/// The most coordinates of an element: roots nested five deep in general, and as deep as one likes where they exist.
const MOST_COORDINATES: usize = 32;

/// An element: its coordinates in the smallest field of the tower that holds it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Quadratic {
    /// An element of GF(p).
    Real(u64),
    /// An element of a larger field; the second half of the coordinates is not zero.
    Wide(Box<[u64]>),
    /// An element of an extension of these fields by units: only roots of odd degree make them.
    Extended(Box<Extended>),
}

/// A polynomial in a generator, of which it needs a power with a positive exponent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Extended {
    pub(super) generator: Generator,
    /// As many as the degree of the generator.
    pub(super) coefficients: Box<[Quadratic]>,
}

/// The unit e^(2 pi i/n^c) of a prime n and a count c.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Generator {
    pub(super) prime: u64,
    pub(super) count: u32,
}

impl Quadratic {
    pub(super) const ZERO: Self = Self::Real(0);

    fn coordinates(&self) -> &[u64] {
        match self {
            Self::Real(word) => std::slice::from_ref(word),
            Self::Wide(words) => words,
            Self::Extended(_) => unreachable!("extensions have coefficients in place of coordinates"),
        }
    }

    /// Whether the element is one of GF(p).
    pub(crate) fn is_real(&self) -> bool {
        matches!(self, Self::Real(_))
    }

    pub(super) fn is_extended(&self) -> bool {
        matches!(self, Self::Extended(_))
    }

    fn new(mut words: Vec<u64>) -> Self {
        while words.len() > 1 && words[words.len() / 2..].iter().all(|&word| word == 0) {
            words.truncate(words.len() / 2);
        }
        if let [word] = words[..] { Self::Real(word) } else { Self::Wide(words.into()) }
    }

    /// The coordinates, for ordering and keys; those of extensions with their degrees.
    pub(crate) fn words(&self) -> Cow<'_, [u64]> {
        let Self::Extended(extended) = self else { return self.coordinates().into() };
        let words = |each: &Self| {
            let words = each.words();
            std::iter::once(words.len() as u64).chain(words.iter().copied()).collect::<Vec<u64>>()
        };
        std::iter::once(extended.generator.order())
            .chain(extended.coefficients.iter().flat_map(words))
            .collect()
    }

    pub(crate) fn is_zero(&self) -> bool {
        *self == Self::ZERO
    }

    pub(super) fn leading(&self) -> u64 {
        if let Self::Extended(extended) = self {
            return extended.coefficients.iter().map(Self::leading).find(|&word| word != 0).unwrap_or(0);
        }
        self.coordinates().iter().copied().find(|&word| word != 0).unwrap_or(0)
    }
}

/// The arithmetic of the closure over one prime.
#[derive(Clone, Copy, Debug)]
pub(super) struct Closure {
    pub prime: Prime,
    /// The n of j^2 = n + i.
    n: u64,
}

impl Closure {
    pub(super) fn new(prime: Prime) -> Self {
        let mut n = prime.one;
        while prime.is_square(prime.add(prime.mul(n, n), prime.one)) {
            n = prime.add(n, prime.one);
        }
        Self { prime, n }
    }

    pub(super) fn one(&self) -> Quadratic {
        Quadratic::Real(self.prime.one)
    }

    pub(super) fn add(&self, a: &Quadratic, b: &Quadratic) -> Quadratic {
        if let (Quadratic::Real(a), Quadratic::Real(b)) = (a, b) {
            return Quadratic::Real(self.prime.add(*a, *b));
        }
        let (a, b) = (a.coordinates(), b.coordinates());
        let (long, short) = if a.len() >= b.len() { (a, b) } else { (b, a) };
        let mut sum = long.to_vec();
        for (word, addend) in sum.iter_mut().zip(short) {
            *word = self.prime.add(*word, *addend);
        }
        Quadratic::new(sum)
    }

    pub(super) fn neg(&self, a: &Quadratic) -> Quadratic {
        match a {
            Quadratic::Real(a) => Quadratic::Real(self.prime.neg(*a)),
            _ => Quadratic::Wide(a.coordinates().iter().map(|&word| self.prime.neg(word)).collect()),
        }
    }

    pub(super) fn mul(&self, a: &Quadratic, b: &Quadratic) -> Quadratic {
        if let (Quadratic::Real(a), Quadratic::Real(b)) = (a, b) {
            return Quadratic::Real(self.prime.mul(*a, *b));
        }
        if let (&[a, b], &[c, d]) = (a.coordinates(), b.coordinates()) {
            // (a + b i)(c + d i), which is most common
            let p = &self.prime;
            let (real, imaginary) = (p.sub(p.mul(a, c), p.mul(b, d)), p.add(p.mul(a, d), p.mul(b, c)));
            return if imaginary == 0 {
                Quadratic::Real(real)
            } else {
                Quadratic::Wide([real, imaginary].into())
            };
        }
        Quadratic::new(self.product(a.coordinates(), b.coordinates()))
    }

    pub(super) fn half(&self, a: &Quadratic) -> Quadratic {
        if let Quadratic::Real(a) = a {
            return Quadratic::Real(self.prime.half(*a));
        }
        Quadratic::new(a.coordinates().iter().map(|&word| self.prime.half(word)).collect())
    }

    /// The reciprocal; zero stays zero.
    pub(super) fn inverse(&self, a: &Quadratic) -> Quadratic {
        if let Quadratic::Real(a) = a {
            return Quadratic::Real(self.prime.inverse(*a));
        }
        Quadratic::new(self.reciprocal(a.coordinates()))
    }

    /// The i of i^2 = -1: a root of -1, and the positive one.
    pub(super) fn imaginary(&self) -> Quadratic {
        Quadratic::Wide([0, self.prime.one].into())
    }

    pub(super) fn power(&self, base: &Quadratic, mut exponent: u64) -> Quadratic {
        if exponent == 1 {
            return base.clone();
        }
        if let Quadratic::Real(base) = base {
            return Quadratic::Real(self.prime.pow(*base, exponent));
        }
        let (mut base, mut result) = (base.clone(), self.one());
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = self.mul(&result, &base);
            }
            base = self.mul(&base, &base);
            exponent >>= 1;
        }
        result
    }

    pub(super) fn is_positive(&self, a: &Quadratic) -> bool {
        self.prime.is_square(a.leading())
    }

    /// The positive square root; `None` if it has more coordinates than elements may have.
    pub(super) fn sqrt(&self, a: &Quadratic) -> Option<Quadratic> {
        let words = a.coordinates();
        let dimension = words.len();
        let root = if self.is_square(words) {
            self.root(words)
        } else if 2 * dimension > MOST_COORDINATES {
            return None;
        } else {
            generator_times(&self.root(&self.over_nonsquare(words)))
        };
        let root = Quadratic::new(root);
        Some(if self.is_positive(&root) { root } else { self.neg(&root) })
    }

    /// The product of elements of one field, or of an element and one of a field below.
    fn product(&self, a: &[u64], b: &[u64]) -> Vec<u64> {
        let (long, short) = if a.len() >= b.len() { (a, b) } else { (b, a) };
        if let [b] = short {
            return long.iter().map(|&word| self.prime.mul(word, *b)).collect();
        }
        let (low, high) = long.split_at(long.len() / 2);
        if short.len() < long.len() {
            return [self.product(low, short), self.product(high, short)].concat();
        }
        let (short_low, short_high) = short.split_at(short.len() / 2);
        let squares = self.times_nonsquare(&self.product(high, short_high));
        let first = self.sum(&self.product(low, short_low), &squares);
        [first, self.sum(&self.product(low, short_high), &self.product(high, short_low))].concat()
    }

    fn sum(&self, a: &[u64], b: &[u64]) -> Vec<u64> {
        a.iter().zip(b).map(|(&a, &b)| self.prime.add(a, b)).collect()
    }

    fn opposite(&self, a: &[u64]) -> Vec<u64> {
        a.iter().map(|&word| self.prime.neg(word)).collect()
    }

    /// The product with the d of the next field.
    fn times_nonsquare(&self, a: &[u64]) -> Vec<u64> {
        match *a {
            [a] => vec![self.prime.neg(a)],
            [a, b] => {
                let (na, nb) = (self.prime.mul(self.n, a), self.prime.mul(self.n, b));
                vec![self.prime.sub(na, b), self.prime.add(nb, a)]
            }
            _ => {
                // d is the generator of this field itself: (x + y g) g = y d' + x g.
                let (low, high) = a.split_at(a.len() / 2);
                [self.times_nonsquare(high), low.to_vec()].concat()
            }
        }
    }

    /// The quotient by the d of the next field.
    fn over_nonsquare(&self, a: &[u64]) -> Vec<u64> {
        let mut one = vec![0; a.len()];
        one[0] = self.prime.one;
        self.product(a, &self.reciprocal(&self.times_nonsquare(&one)))
    }

    /// The norm a^2 - d b^2 of a + b g to the field below.
    fn norm(&self, a: &[u64]) -> Vec<u64> {
        let (low, high) = a.split_at(a.len() / 2);
        let high = self.times_nonsquare(&self.product(high, high));
        self.sum(&self.product(low, low), &self.opposite(&high))
    }

    /// The norm to GF(p) and the degree of the field of the coordinates.
    pub(super) fn whole_norm(&self, a: &Quadratic) -> (u64, u64) {
        let mut norm = a.coordinates().to_vec();
        let degree = norm.len() as u64;
        while norm.len() > 1 {
            norm = self.norm(&norm);
        }
        (norm[0], degree)
    }

    fn reciprocal(&self, a: &[u64]) -> Vec<u64> {
        if let [a] = *a {
            return vec![self.prime.inverse(a)];
        }
        let norm = self.reciprocal(&self.norm(a));
        let (low, high) = a.split_at(a.len() / 2);
        [self.product(low, &norm), self.product(&self.opposite(high), &norm)].concat()
    }

    /// Whether an element is a square in the field of its coordinates, which may end in zeros.
    fn is_square(&self, a: &[u64]) -> bool {
        if let [a] = *a {
            return self.prime.is_square(a);
        }
        self.is_square(&self.norm(a))
    }

    /// One of the roots of a square, in the field of its coordinates.
    fn root(&self, a: &[u64]) -> Vec<u64> {
        if let [a] = *a {
            return vec![self.prime.root(a)];
        }
        let (low, high) = a.split_at(a.len() / 2);
        if high.iter().all(|&word| word == 0) {
            if self.is_square(low) {
                return [self.root(low), vec![0; low.len()]].concat();
            }
            return generator_times(&self.root(&self.over_nonsquare(low)));
        }
        // (x + y g)^2 = a + b g: x^2 is (a + s)/2 or (a - s)/2 with s^2 = a^2 - d b^2, whichever is a square.
        let s = self.root(&self.norm(a));
        let halves =
            |words: Vec<u64>| -> Vec<u64> { words.iter().map(|&word| self.prime.half(word)).collect() };
        let mut square = halves(self.sum(low, &s));
        if !self.is_square(&square) {
            square = halves(self.sum(low, &self.opposite(&s)));
        }
        let x = self.root(&square);
        let y = halves(self.product(high, &self.reciprocal(&x)));
        [x, y].concat()
    }
}

/// The product with the generator g of the next field.
fn generator_times(a: &[u64]) -> Vec<u64> {
    [vec![0; a.len()], a.to_vec()].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn i_is_the_positive_root_of_minus_one() {
        let closure = Closure::new(Prime::new(4_611_685_641_547_390_559));
        let minus_one = closure.neg(&closure.one());
        assert_eq!(closure.sqrt(&minus_one), Some(closure.imaginary()));
    }

    #[test]
    fn every_element_has_a_positive_root() {
        let closure = Closure::new(Prime::new(4_611_685_641_547_390_559));
        let mut value = Quadratic::Real(closure.prime.natural(3));
        for step in 0..24 {
            let addend = Quadratic::Real(closure.prime.natural(7 + step));
            value = closure.neg(&closure.add(&value, &addend));
            let Some(root) = closure.sqrt(&value) else { break };
            assert_eq!(closure.mul(&root, &root), value);
            assert!(closure.is_positive(&root));
            let square = closure.mul(&value, &value);
            let modulus = closure.sqrt(&square).expect("a square has a root in its own field");
            assert!(modulus == value || modulus == closure.neg(&value));
            assert_eq!(closure.mul(&closure.inverse(&value), &value), closure.one());
            value = root;
        }
    }
}
