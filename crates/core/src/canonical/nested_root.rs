//! Square roots of p + q sqrt(n): sqrt(3 + 2 sqrt(2)) is 1 + sqrt(2).
//!
//! If p^2 - q^2 n is the square of a rational number d, then sqrt(p + q sqrt(n)) = sqrt((p + d)/2) +- sqrt((p - d)/2),
//! with the sign of q [Borodin et al. 1985]. Nothing sees the rational part 1 in the root of a root.

use num_integer::Integer;

use crate::error::Error;
use crate::graph::{Graph, Id, View};
use crate::value::Number;

use super::collector::Collector;

impl Graph {
    /// Add a power of a sum with a broken exponent to the collector.
    pub(super) fn collect_root_of_sum(
        &mut self,
        out: &mut Collector,
        sum: Id,
        exponent: &Number,
    ) -> Result<(), Error> {
        if exponent.denominator().is_even()
            && let Some(root) = self.denested_root(sum)?
        {
            return self.collect_power(out, root, &exponent.add(exponent));
        }
        out.push(self, sum, exponent);
        Ok(())
    }

    /// The square root of a node, if it is one of p + q sqrt(n) and a sum of roots of numbers that has its value.
    fn denested_root(&mut self, base: Id) -> Result<Option<Id>, Error> {
        let Some((p, q, n)) = self.parts_with_root(base) else { return Ok(None) };
        let norm = p.mul(&p).sub(&q.mul(&q).mul(&n));
        if p.is_negative() || norm.is_negative() {
            return Ok(None);
        }
        let half = Number::rational(1, 2);
        let d = self.number(&norm);
        let d = self.sqrt(d)?;
        let Some(d) = self.as_number(d).cloned() else { return Ok(None) };
        let mut roots = [Id::ZERO; 2];
        for (root, square) in roots.iter_mut().zip([p.add(&d), p.sub(&d)]) {
            let square = self.number(&square.mul(&half));
            *root = self.sqrt(square)?;
        }
        let sum = if q.is_negative() { self.sub(roots[0], roots[1]) } else { self.add(roots[0], roots[1]) };
        let half = self.number_id(&half);
        // A lane knows the sign of few irrational numbers, and may have drawn the other root.
        Ok((self.product_fingerprint(&[(base, half)]) == self.value(sum)).then_some(sum))
    }

    /// The numbers p, q and n of p + q sqrt(n).
    fn parts_with_root(&self, id: Id) -> Option<(Number, Number, Number)> {
        let View::Sum(terms) = self.view(id) else { return None };
        if terms.len() != 2 {
            return None;
        }
        let (mut rational, mut irrational) = (None, None);
        for (factor, node) in terms.iter() {
            let factor = self.get_number(factor);
            if node == Id::ONE {
                rational = Some(factor.clone());
            } else {
                irrational = Some((factor.clone(), self.square_of_root(node)?));
            }
        }
        let (p, (q, n)) = rational.zip(irrational)?;
        Some((p, q, n))
    }

    /// The number n of sqrt(n).
    fn square_of_root(&self, id: Id) -> Option<Number> {
        let View::Product(factors) = self.view(id) else { return None };
        let mut factors = factors.iter();
        let (base, exponent) = factors.next().filter(|_| factors.len() == 0)?;
        let is_square_root = *self.get_number(exponent) == Number::rational(1, 2);
        self.as_number(base).filter(|_| is_square_root).cloned()
    }
}
