//! Angles and exponents at points of the q-adic integers at which they are drawn.
//!
//! They are drawn for the terms of an argument, as parts of these, so that the addition theorems hold there as well:
//! the sine of 2*x is that of twice the angle of x.

use crate::graph::{Graph, Id, View};
use crate::value::{Adic, Adics, Coefficient, Number};

use super::adic_point::AdicPoint;
use super::rotation::{Point, multiple, rotate};

/// Angles are drawn for this part of a term: halves, thirds and fifths of it are multiples of that.
const PARTS: i64 = 60;

/// Arguments of more terms are drawn as a whole.
const MOST_TERMS: usize = 64;

impl Graph {
    /// The cosine and the sine of an argument that holds no known angles.
    pub(super) fn drawn_angle<C: Coefficient>(
        &self,
        argument: Id,
        at: &AdicPoint<'_, C>,
    ) -> Option<Point<Adic<C>>> {
        let terms = self.terms_of_argument(argument, false)?;
        terms.into_iter().try_fold((at.one(), Adics::zero()), |sum, (factor, term)| {
            let (count, part) = in_parts(&factor)?;
            let angle = self.drawn_part_of_angle(term, &part, at);
            Some(rotate(at.adics, &sum, &multiple(at.adics, angle, count)))
        })
    }

    /// The exponential of an argument that holds no logarithms.
    pub(super) fn drawn_exponential<C: Coefficient>(
        &self,
        argument: Id,
        at: &AdicPoint<'_, C>,
    ) -> Option<Adic<C>> {
        let terms = self.terms_of_argument(argument, true)?;
        terms.into_iter().try_fold(at.one(), |product, (factor, term)| {
            let (count, part) = in_parts(&factor)?;
            let key = at.key_of(|field| self.value_in(term, field)).text("exponential").text(&part);
            let exponential = at.adics.draw(&key);
            Some(at.adics.mul(&product, &at.adics.power(&exponential, count)))
        })
    }

    /// A point of the circle by the tangent of half of the angle.
    fn drawn_part_of_angle<C: Coefficient>(
        &self,
        term: Id,
        part: &str,
        at: &AdicPoint<'_, C>,
    ) -> Point<Adic<C>> {
        let adics = at.adics;
        let tangent = adics.draw(&at.key_of(|field| self.value_in(term, field)).text("tangent").text(part));
        let square = adics.mul(&tangent, &tangent);
        let scale = adics.power(&adics.add(&at.one(), &square), -1);
        let minus = adics.mul(&adics.integer(&(-1).into()), &square);
        let twice = adics.add(&tangent, &tangent);
        (adics.mul(&scale, &adics.add(&at.one(), &minus)), adics.mul(&scale, &twice))
    }

    /// The terms of an argument with their factors; `None` for one with known angles or logarithms, or of many terms.
    fn terms_of_argument(&self, argument: Id, of_exponential: bool) -> Option<Vec<(Number, Id)>> {
        if !self.split_argument(argument, of_exponential).is_empty() {
            return None;
        }
        let (mut terms, mut waiting) =
            (Vec::new(), vec![(Number::integer(1), self.representative(argument))]);
        while let Some((factor, id)) = waiting.pop() {
            if waiting.len() + terms.len() > MOST_TERMS {
                return None;
            }
            let times = |number| self.get_number(number).mul(&factor);
            match self.view(id) {
                View::Number(number) => terms.push((times(number), Id::ONE)),
                View::Scale(number, child) => waiting.push((times(number), child)),
                View::Sum(sum) => waiting.extend(sum.iter().map(|(number, node)| (times(number), node))),
                _ => {
                    let (first, is_opposite) = self.representative_up_to_sign(id);
                    terms.push((if is_opposite { factor.neg() } else { factor }, first));
                }
            }
        }
        Some(terms)
    }
}

/// How many parts of a term a multiple of it is, and which ones: those of 60, or parts of these.
fn in_parts(factor: &Number) -> Option<(i64, String)> {
    let count = factor.mul(&Number::integer(PARTS));
    let part = count.denominator();
    let count = count.mul(&Number::whole(part.clone())).to_i64()?;
    Some((count, part.to_string()))
}
