//! The flat polynomials from which the forms for the reader are arranged.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::error::Error;
use crate::graph::{Function, Graph, Id, View};
use crate::polynomial::{Monomial, Polynomial};

use super::LONG;
use crate::rewrite::expand::Opening;
use crate::rewrite::ring::Ring;

/// The polynomials that are arranged: those with the shortest flat texts; and the same for long ones.
const ARRANGED: [usize; 2] = [4, 2];
/// The terms of a polynomial whose sines and cosines stay as they are.
pub(super) const LONG_WAVES: usize = 24;

impl Graph {
    /// The sums of parameters among the factors of products, and under powers.
    fn sums_of_parameters(&self, part: Id) -> FxHashSet<Id> {
        let is_parameters = |id: Id| match self.view(id) {
            View::Sum(terms) => terms.iter().all(|(_, term)| matches!(self.view(term), View::Symbol(..))),
            _ => false,
        };
        let mut found: FxHashSet<Id> = FxHashSet::default();
        for id in self.post_order(&[part]) {
            if let View::Product(factors) = self.view(id) {
                found.extend(factors.iter().map(|(base, _)| base).filter(|&base| is_parameters(base)));
            }
        }
        found
    }
}

impl Ring<'_> {
    /// The polynomials of a part whose flat texts read shortest.
    pub(super) fn flat_forms(&mut self, part: Id) -> Vec<Polynomial> {
        let Ok(flat) = self.polynomial(part, Opening::Products) else { return Vec::new() }; // beyond the limits
        if self.is_linear_in_waves(&flat) {
            let products = self.with_wave_products(&flat).ok().flatten();
            return std::iter::once(flat).chain(products).collect();
        }
        let combined = if flat.len() <= 2 * LONG_WAVES { self.combined(&flat).ok() } else { None };
        // Of a planar mechanism, this is what the books print.
        if let Some(combined) = &combined
            && combined.len() <= flat.len()
            && self.is_linear_in_waves(combined)
            && self.shortened(&flat).is_ok_and(|short| combined.len() <= short.len())
        {
            return vec![combined.clone()];
        }
        // Of axes in space that are parallel, this is: squares of distances from an axis.
        let in_frame_angles = combined.and_then(|combined| self.in_frame_angles(&combined).ok());
        let in_frame_angles = in_frame_angles.filter(|form| form.len() <= flat.len() && *form != flat);
        if flat.len() > LONG_WAVES {
            return in_frame_angles.into_iter().chain([flat]).collect();
        }
        let Ok(node) = self.node_of(&flat) else { return Vec::new() };
        let mut forms = self.polynomials(node);
        forms.extend(in_frame_angles.filter(|form| !forms.contains(form)));
        let is_multiple =
            |atom: &u32| self.wave(*atom).is_some_and(|(_, angle)| self.graph.is_multiple(angle));
        if flat.atoms().iter().any(is_multiple) {
            self.opens_all = true;
            if let Ok(opened) =
                self.polynomial(part, Opening::Angles).and_then(|opened| self.node_of(&opened))
            {
                forms.extend(self.polynomials(opened));
            }
        }
        let halved = self.with_half_angles(&flat).ok().flatten();
        let products = self.with_wave_products(&flat).ok().flatten();
        forms.extend(halved.into_iter().chain(products));
        let mut read: Vec<(usize, u64, Id, Polynomial)> = Vec::new();
        let mut known: FxHashMap<Id, usize> = FxHashMap::default();
        for polynomial in forms {
            if let Ok(node) = self.node_of(&polynomial) {
                let length = self.graph.least_length(node, &mut known) + self.graph.awkwardness(node);
                read.push((length, self.graph.tree_cost(&[node]).total(), node, polynomial));
            }
        }
        let graph = &*self.graph;
        read.sort_by(|(a, m, x, _), (b, n, y, _)| {
            (a, m).cmp(&(b, n)).then_with(|| graph.to_text(*x).cmp(&graph.to_text(*y)))
        });
        let is_long = read.first().is_some_and(|(.., shortest)| shortest.len() >= LONG);
        read.truncate(ARRANGED[usize::from(is_long)]);
        let mut forms: Vec<Polynomial> = read.into_iter().map(|(.., polynomial)| polynomial).collect();
        for form in forms.clone().into_iter().chain([flat]) {
            let squares = self.with_squares_only(&form).ok().flatten();
            forms.extend(squares.filter(|squares| !forms.contains(squares)));
        }
        forms
    }

    /// The forms of a part in which the sums of parameters among its factors, such as `R - r`, stay closed.
    pub(super) fn forms_over_parameters(&mut self, part: Id) -> Vec<Polynomial> {
        let closed = self.graph.sums_of_parameters(part);
        if closed.is_empty() {
            return Vec::new();
        }
        let Ok(flat) = self.polynomial_over(part, Opening::Products, closed) else { return Vec::new() };
        let mut forms = vec![flat.clone()];
        if flat.len() <= LONG_WAVES {
            let combined = self.combined(&flat).ok();
            let in_frame_angles = combined.as_ref().and_then(|form| self.in_frame_angles(form).ok());
            let halved = self.with_half_angles(&flat).ok().flatten();
            let products = self.with_wave_products(&flat).ok().flatten();
            let others = [self.shortened(&flat).ok(), combined, in_frame_angles, halved, products];
            for form in others.into_iter().flatten() {
                if form.len() <= flat.len() && !forms.contains(&form) {
                    forms.push(form);
                }
            }
        }
        forms
    }

    /// Whether a term has two sines or cosines, and none has more.
    pub(super) fn has_pairs(&self, polynomial: &Polynomial) -> bool {
        polynomial.iter().map(|(monomial, _)| self.waves_of(monomial)).max() == Some(2)
    }

    /// The number of sines and cosines in a product.
    fn waves_of(&self, monomial: &Monomial) -> u64 {
        let waves = monomial.factors().iter().filter(|&&(atom, _)| self.wave(atom).is_some());
        waves.map(|&(_, exponent)| exponent.unsigned_abs()).sum()
    }

    /// Whether each term has one sine or cosine at most, and none of a multiple of an angle.
    pub(super) fn is_linear_in_waves(&self, polynomial: &Polynomial) -> bool {
        let is_plain = |atom: u32| self.wave(atom).is_none_or(|(_, angle)| !self.graph.is_multiple(angle));
        polynomial.atoms().into_iter().all(is_plain)
            && polynomial.iter().all(|(monomial, _)| self.waves_of(monomial) <= 1)
    }

    /// The polynomial with tangents for quotients of sines and cosines, if there are any.
    pub(super) fn in_tangents(&mut self, polynomial: &Polynomial) -> Result<Option<Polynomial>, Error> {
        let mut made = Polynomial::default();
        let pairs = self.angles_in(polynomial)?;
        for (monomial, coefficient) in polynomial.iter() {
            let mut monomial = monomial.clone();
            for &(sin, cos) in &pairs {
                let power = monomial.exponent(sin).min(-monomial.exponent(cos));
                if power > 0 {
                    let Some((_, angle)) = self.wave(sin) else { continue };
                    let tangent = self.graph.apply(Function::Tan, &[angle])?;
                    let (tangent, is_opposite) = self.atom(tangent);
                    if is_opposite {
                        return Ok(None);
                    }
                    let quotient = Monomial::power(sin, -power).times(&Monomial::power(cos, power));
                    monomial = monomial.times(&quotient).times(&Monomial::power(tangent, power));
                }
            }
            made.add_term(monomial, coefficient);
        }
        Ok((made != *polynomial).then_some(made))
    }
}
