//! Roots of units of an unramified extension.
//!
//! A unit u has a root of the prime degree p if its residue has one. There are q^d - 1 = p^s t residues but for zero, p
//! being no divisor of t. If s = 0, each has one root. Otherwise one in p of them has p, which differ by the powers of
//! g^(p^(s - 1)), where g is some residue of the order p^s [Adleman, Manders & Miller 1977; Cohen 1993, sec. 1.5.1].

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::Pow;
use std::sync::PoisonError;

use super::coefficient::Coefficient;
use super::key::Key;
use super::unramified::{Integral, Unramified};

/// The primes of which the residues may have several roots. Those of another degree are found where there is one.
pub(crate) const DEGREES: [u64; 4] = [2, 3, 5, 7];

/// The number of residues but for zero is t p^s.
struct Order {
    degree: u64,
    prime: BigInt,
    count: u32,
    rest: BigInt,
}

impl<C: Coefficient> Unramified<C> {
    /// A root of a unit, if there is one: the residue's, then by Newton's iteration, r - (r^n - u)/(n r^(n-1)), together
    /// with that for the reciprocal of r. The number chooses between several.
    pub(super) fn root(&self, unit: &Integral<C>, degree: u64, choice: u32) -> Option<Integral<C>> {
        let whole_degree = BigInt::from(degree);
        let modulus = self.modulus.to_big();
        let part = whole_degree.modinv(&modulus)?;
        let minus_part = C::below_modulus(&(modulus - part));
        let start = self.root_of_residue(&self.residue(unit), degree, choice)?;
        let inverse = self.inverse_of_residue(&start);
        let less_one = &whole_degree - 1;
        let (root, _) = (0..self.newton_steps()).fold((start, inverse), |(root, inverse), _| {
            let error = self.sum(&self.power(&root, &whole_degree), unit, &self.minus_one());
            let slope = self.power(&inverse, &less_one);
            let root = self.sum(&root, &self.mul(&error, &slope), &minus_part);
            let inverse = self.improved_inverse(&root, &inverse);
            (root, inverse)
        });
        Some(root)
    }

    /// A root of a residue. The modulus q may be a product whose factors are unknown; then what is found may be no root,
    /// which the last line checks.
    fn root_of_residue(&self, unit: &Integral<C>, degree: u64, choice: u32) -> Option<Integral<C>> {
        let (field, order) = (self.residues(), self.order(degree));
        let inverse = order.prime.modinv(&order.rest)?;
        let exponent = if order.rest == BigInt::from(1) { order.rest.clone() } else { inverse };
        let part = field.power(unit, &(exponent - 1));
        let root = field.mul(&part, unit);
        let root = if order.count == 0 {
            root
        } else {
            let generator = self.generator(&order)?;
            // root^p = unit * rest
            let rest = field.mul(&field.power(&part, &order.prime), &field.power(unit, &(&order.prime - 1)));
            let factor = field.root_of_unit(rest, &order, &generator)?;
            let unity = field.power(&generator, &(Pow::pow(&order.prime, order.count - 1) * choice));
            field.mul(&field.mul(&root, &factor), &unity)
        };
        (field.power(&root, &order.prime) == *unit).then_some(root)
    }

    /// The p-th root of the reciprocal of a residue whose order is a power of p, which becomes smaller.
    fn root_of_unit(
        &self,
        mut unit: Integral<C>,
        order: &Order,
        generator: &Integral<C>,
    ) -> Option<Integral<C>> {
        let mut root = self.constant(C::one());
        for level in (0..order.count).rev() {
            let times = order.count.checked_sub(2 + level);
            let power = Pow::pow(&order.prime, level);
            for _ in 1..order.degree {
                if Self::is_one(&self.power(&unit, &power)) {
                    break;
                }
                let factor = self.power(generator, &Pow::pow(&order.prime, times?));
                root = self.mul(&root, &factor);
                unit = self.mul(&unit, &self.power(&factor, &order.prime));
            }
        }
        Some(root)
    }

    /// What has the order p^s among the residues, if there are several roots of the degree p to look for.
    fn generator(&self, order: &Order) -> Option<Integral<C>> {
        DEGREES.contains(&order.degree).then_some(())?;
        let mut known = self.generators.lock().unwrap_or_else(PoisonError::into_inner);
        let find = || self.residues().find_generator(order);
        Some(known.entry(order.degree).or_insert_with(find).clone())
    }

    /// The number of residues but for zero, without the powers of a prime and these. The powers of another number are not
    /// looked for: its roots are found if it has no factor in common with the number of residues.
    fn order(&self, degree: u64) -> Order {
        let prime = BigInt::from(degree);
        let mut rest: BigInt = Pow::pow(self.whole_prime(), self.degree) - 1;
        let mut count = 0;
        while rest.is_multiple_of(&prime) {
            rest /= &prime;
            count += 1;
        }
        Order { degree, prime, count, rest }
    }

    /// What is no p-th power, to the power of the part of the order without p.
    fn find_generator(&self, order: &Order) -> Integral<C> {
        let candidates = (0u64..).map(|salt| self.draw(&Key::new("no power").word(salt)));
        let mut powers = candidates.map(|candidate| self.power(&candidate, &order.rest));
        let part_of_order = Pow::pow(&order.prime, order.count - 1);
        let is_no_power = |power: &Integral<C>| !Self::is_one(&self.power(power, &part_of_order));
        powers.find(is_no_power).expect("most units are no p-th powers")
    }
}

#[cfg(test)]
mod tests {
    use super::super::unramified::Extension;
    use super::*;

    const PRIMES: [u32; 9] = [5, 7, 37, 61, 67, 109, 509, 1009, 1_000_003];

    fn powers_have_roots<C: Coefficient>(ring: &Unramified<C>) {
        for degree in [2, 3, 5, 7, 13].map(BigInt::from) {
            let small = u64::try_from(&degree).expect("a word");
            let has_all_roots = ring.order(small).count == 0;
            if !has_all_roots && !DEGREES.contains(&small) || ring.whole_prime() == degree {
                continue;
            }
            let mut with_root = 0;
            for seed in 0..40 {
                let unit = ring.draw(&Key::new("unit").word(seed));
                let power = ring.power(&unit, &degree);
                let choice = u32::try_from(seed).expect("a word");
                let root = ring.root(&power, small, choice).expect("a power has a root");
                assert!(ring.power(&root, &degree) == power, "{degree} {}", ring.whole_prime());
                with_root += usize::from(ring.root(&unit, small, 0).is_some());
            }
            let expected = if has_all_roots { 40..41 } else { 1..40 };
            assert!(expected.contains(&with_root), "{with_root} of 40 for {}", ring.whole_prime());
        }
    }

    #[test]
    fn powers_have_roots_for_all_sizes_of_primes() {
        for (prime, with_roots) in PRIMES.iter().flat_map(|prime| [(prime, false), (prime, true)]) {
            match Extension::of_prime(&(*prime).into(), with_roots) {
                Extension::Words(ring) => powers_have_roots(&ring),
                Extension::Long(ring) => powers_have_roots(&ring),
            }
        }
    }

    fn integers_have_roots<C: Coefficient>(ring: &Unramified<C>) {
        for (integer, degree) in (2..20u32).flat_map(|integer| [2, 3].map(|degree| (integer, degree))) {
            let integer = ring.integer(&integer.into());
            let root = ring.root(&integer, degree, 1).expect("the extension has these roots");
            assert!(ring.power(&root, &degree.into()) == integer);
        }
    }

    #[test]
    fn a_product_of_primes_has_no_extension_with_roots() {
        let product = BigInt::from(1_000_003u64 * 1_000_033);
        let degree = |with_roots| match Extension::of_prime(&product, with_roots) {
            Extension::Words(ring) => ring.degree,
            Extension::Long(ring) => ring.degree,
        };
        assert_eq!(degree(true), degree(false));
    }

    #[test]
    fn integers_have_square_roots_and_cube_roots() {
        for prime in &PRIMES[2..] {
            match Extension::of_prime(&(*prime).into(), true) {
                Extension::Words(ring) => integers_have_roots(&ring),
                Extension::Long(ring) => integers_have_roots(&ring),
            }
        }
    }
}
