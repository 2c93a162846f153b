//! Roots of odd degree: extensions of the quadratic closure by roots of unity.
//!
//! A *generator* is the unit e^(2 pi i/q) of a power q = n^c of an odd prime n. If n divides p + 1, the circle holds such
//! units up to c = s. The next ones are roots of the last one, T^(n^(c - s)) = e^(2 pi i/n^s), and the extension is a field [Lang
//! 2002, sec. VI.9]. Otherwise the generator is a root of the cyclotomic polynomial of q, and the extension is a product of
//! fields, in which elements have reciprocals unless they are zero in one of them, which is as rare as any coincidence.
//!
//! An element is a polynomial in the generator of the largest prime, whose coefficients are elements with smaller primes,
//! down to the closure. Generators are as few and as small as possible.

use num_bigint::BigInt;

use super::field::Field;
use super::key::Key;
use super::number::Number;
use super::quadratic::{Extended, Generator, Quadratic};

/// The largest degree of a generator.
pub(super) const LARGEST_DEGREE: u64 = 128;

/// Products of elements that take more products of coordinates are drawn.
const HEAVIEST: usize = 50_000;

impl Generator {
    pub(super) fn order(self) -> u64 {
        self.prime.pow(self.count)
    }
}

impl Extended {
    /// The element with another value for each coefficient, which is linear in that.
    pub(super) fn map(&self, map: impl Fn(&Quadratic) -> Quadratic) -> Quadratic {
        let coefficients = self.coefficients.iter().map(map).collect();
        Quadratic::Extended(Self { generator: self.generator, coefficients }.into())
    }

    /// The coefficient and the exponent of what has one term.
    pub(super) fn single_term(&self) -> Option<(&Quadratic, u64)> {
        let mut terms = self.coefficients.iter().zip(0..).filter(|(coefficient, _)| !coefficient.is_zero());
        let first = terms.next()?;
        terms.next().is_none().then_some(first)
    }
}

impl Field {
    /// The unit of a fraction of a turn whose denominator is a power of an odd prime; `None` if its degree is too large.
    pub(super) fn unit_of_prime_power(&self, turns: &Number, prime: u64, count: u32) -> Option<Quadratic> {
        let generator = Generator { prime, count };
        let order = prime.checked_pow(count)?;
        let parts = residue(&turns.mul(&Number::whole(order.into())).numerator(), order);
        if let Some((held, unit)) = self.unit_on_circle(prime)
            && count <= held
        {
            return Some(self.natural_power(unit, parts * prime.pow(held - count)));
        }
        if self.degree(generator) > LARGEST_DEGREE {
            return None;
        }
        Some(self.power_of_generator(generator, parts))
    }

    /// Whether a generator is a root of a unit of the circle, so that the extension is a field.
    pub(super) fn is_root_of_circle(&self, generator: Generator) -> bool {
        self.unit_on_circle(generator.prime).is_some()
    }

    /// The degree of the polynomial of which a generator is a root.
    pub(super) fn degree(&self, generator: Generator) -> u64 {
        match self.unit_on_circle(generator.prime) {
            Some((held, _)) => generator.prime.pow(generator.count - held),
            None => generator.order() / generator.prime * (generator.prime - 1),
        }
    }

    pub(super) fn power_of_generator(&self, generator: Generator, exponent: u64) -> Quadratic {
        self.polynomial(generator, [(exponent, self.one())])
    }

    /// The element that is a sum of multiples of powers of a generator.
    fn polynomial(
        &self,
        generator: Generator,
        terms: impl IntoIterator<Item = (u64, Quadratic)>,
    ) -> Quadratic {
        let degree = self.degree(generator);
        let mut coefficients = vec![Quadratic::ZERO; place(degree)];
        let mut add = |exponent: u64, value: &Quadratic| {
            let known = &mut coefficients[place(exponent)];
            *known = self.add(known, value);
        };
        for (exponent, value) in terms {
            let exponent = exponent % generator.order();
            match self.unit_on_circle(generator.prime) {
                Some((_, unit)) => {
                    let turned = self.natural_power(unit, exponent / degree);
                    add(exponent % degree, &self.mul(&turned, &value));
                }
                None if exponent < degree => add(exponent, &value),
                None => {
                    // 1 + z^m + z^(2 m) + ... + z^((n - 1) m) = 0 for the m of degree (n - 1) m
                    let opposite = self.neg(&value);
                    let step = generator.order() / generator.prime;
                    (0..generator.prime - 1).for_each(|k| add(exponent - degree + k * step, &opposite));
                }
            }
        }
        with_least_generator(generator, coefficients)
    }

    pub(super) fn add_extended(&self, a: &Quadratic, b: &Quadratic) -> Quadratic {
        let generator = outer_generator(a, b);
        self.polynomial(generator, terms(a, generator).into_iter().chain(terms(b, generator)))
    }

    /// The first real coordinate of an element that is not zero, and the element divided by it.
    fn without_leading(&self, a: &Quadratic) -> (Quadratic, Quadratic) {
        let factor = Quadratic::Real(a.leading());
        let rest = self.mul(a, &self.inverse(&factor));
        (factor, rest)
    }

    /// A product, which is drawn up to a real factor where it is too large.
    pub(super) fn mul_extended(&self, a: &Quadratic, b: &Quadratic) -> Quadratic {
        if weight(a) * weight(b) > HEAVIEST {
            let ((m, a), (n, b)) = (self.without_leading(a), self.without_leading(b));
            let (lesser, greater) = if a.words() < b.words() { (&a, &b) } else { (&b, &a) };
            let drawn = self.opaque(Key::new("large product"), &[lesser, greater]);
            return self.mul(&self.mul(&m, &n), &drawn);
        }
        let generator = outer_generator(a, b);
        let (a, b) = (terms(a, generator), terms(b, generator));
        let products = a.iter().flat_map(|(m, x)| b.iter().map(move |(n, y)| (m + n, self.mul(x, y))));
        self.polynomial(generator, products)
    }

    /// The reciprocal: the product of the conjugates over the norm.
    pub(super) fn inverse_of_extended(&self, a: &Extended) -> Quadratic {
        let generator = a.generator;
        if let Some((coefficient, exponent)) = a.single_term() {
            let power = self.power_of_generator(generator, generator.order() - exponent);
            return self.mul(&self.inverse(coefficient), &power);
        }
        let element = Quadratic::Extended(a.clone().into());
        let step = self.conjugation(generator);
        let others = self.conjugated(
            &self.product_of_conjugates(&element, generator, step, self.degree(generator) - 1),
            generator,
            step,
        );
        match self.mul(&element, &others) {
            Quadratic::Extended(norm) if norm.generator.prime == generator.prime => {
                // A product was too large. The reciprocal is drawn up to a real factor.
                let (factor, rest) = self.without_leading(&element);
                self.mul(&self.inverse(&factor), &self.opaque(Key::new("large reciprocal"), &[&rest]))
            }
            norm => self.mul(&others, &self.inverse(&norm)),
        }
    }

    /// An exponent e such that T -> T^e generates the conjugations of a generator T.
    fn conjugation(&self, generator: Generator) -> u64 {
        let Some((held, _)) = self.unit_on_circle(generator.prime) else {
            return primitive_root(generator);
        };
        1 + generator.prime.pow(held)
    }

    /// The element with a power of a generator for that.
    pub(super) fn conjugated(&self, a: &Quadratic, generator: Generator, power: u64) -> Quadratic {
        let order = generator.order();
        let terms = terms(a, generator).into_iter();
        self.polynomial(generator, terms.map(|(k, value)| (mul_modulo(k, power, order), value)))
    }

    /// The product of an element and of its first conjugates, as many as `count` in all.
    pub(super) fn product_of_conjugates(
        &self,
        a: &Quadratic,
        generator: Generator,
        step: u64,
        count: u64,
    ) -> Quadratic {
        let order = generator.order();
        let (mut product, mut done, mut power) = (a.clone(), 1, step);
        for bit in (0..count.ilog2()).rev() {
            product = self.mul(&product, &self.conjugated(&product, generator, power));
            (done, power) = (2 * done, mul_modulo(power, power, order));
            if count >> bit & 1 == 1 {
                product = self.mul(&product, &self.conjugated(a, generator, power));
                (done, power) = (done + 1, mul_modulo(power, step, order));
            }
        }
        debug_assert_eq!(done, count);
        product
    }
}

/// The polynomial in the smallest generator that it needs, or its only coefficient.
fn with_least_generator(mut generator: Generator, mut coefficients: Vec<Quadratic>) -> Quadratic {
    loop {
        if coefficients[1..].iter().all(Quadratic::is_zero) {
            return coefficients.swap_remove(0);
        }
        let step = place(generator.prime);
        let is_needed = coefficients.iter().enumerate().any(|(k, c)| k % step != 0 && !c.is_zero());
        if is_needed {
            return Quadratic::Extended(Extended { generator, coefficients: coefficients.into() }.into());
        }
        generator.count -= 1;
        coefficients = coefficients.into_iter().step_by(step).collect();
    }
}

/// The terms of an element as a polynomial in a generator.
fn terms(a: &Quadratic, generator: Generator) -> Vec<(u64, Quadratic)> {
    match a {
        Quadratic::Extended(a) if a.generator.prime == generator.prime => {
            let step = generator.prime.pow(generator.count - a.generator.count);
            let terms = (0..).step_by(place(step)).zip(a.coefficients.iter().cloned());
            terms.filter(|(_, coefficient)| !coefficient.is_zero()).collect()
        }
        _ => vec![(0, a.clone())],
    }
}

/// The coordinates of the largest coefficient, and the generators of an element, which are added to others.
pub(super) fn dimensions(a: &Quadratic, generators: &mut Vec<Generator>) -> usize {
    let Quadratic::Extended(a) = a else { return a.words().len() };
    match generators.iter_mut().find(|known| known.prime == a.generator.prime) {
        Some(known) => known.count = known.count.max(a.generator.count),
        None => generators.push(a.generator),
    }
    a.coefficients.iter().map(|each| dimensions(each, generators)).max().unwrap_or(1)
}

/// The larger of the generators of two elements, of which one has one.
fn outer_generator(a: &Quadratic, b: &Quadratic) -> Generator {
    let generator = |a: &Quadratic| match a {
        Quadratic::Extended(a) => Some(a.generator),
        _ => None,
    };
    let found = [generator(a), generator(b)].into_iter().flatten();
    found.max_by_key(|generator| (generator.prime, generator.count)).expect("one of the elements is extended")
}

/// How many coordinates an element has that are not zero.
fn weight(a: &Quadratic) -> usize {
    match a {
        Quadratic::Extended(a) => a.coefficients.iter().filter(|each| !each.is_zero()).map(weight).sum(),
        _ => a.words().len(),
    }
}

/// A degree or an exponent as a place in a list.
pub(super) fn place(exponent: u64) -> usize {
    usize::try_from(exponent).expect("degrees are small")
}

fn residue(value: &BigInt, modulus: u64) -> u64 {
    let rest: BigInt = ((value % modulus) + modulus) % modulus;
    u64::try_from(rest).expect("a remainder by a word")
}

fn mul_modulo(a: u64, b: u64, modulus: u64) -> u64 {
    a * b % modulus
}

/// The least number whose powers are all units modulo the order of a generator.
fn primitive_root(generator: Generator) -> u64 {
    let order = generator.order();
    let units = order / generator.prime * (generator.prime - 1);
    let has_all = |root: u64| {
        let powers = std::iter::successors(Some(root), |power| Some(mul_modulo(*power, root, order)));
        powers.zip(1..).find(|(power, _)| *power == 1).is_some_and(|(_, count)| count == units)
    };
    (2..order).filter(|root| root % generator.prime != 0).find(|&root| has_all(root)).unwrap_or(1)
}
