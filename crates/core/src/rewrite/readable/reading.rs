//! What a form is to a reader: the length of its text, and what a reader stumbles over.

use rustc_hash::FxHashSet;
use std::collections::{BTreeMap, BTreeSet};

use crate::graph::{Function, Graph, Id, NumberId, View};
use crate::value::Number;

/// Characters by which a form is longer to a reader than its text: for each factor that occurs again in its brackets,
/// each multiple of an angle, each fraction inside brackets, and each negative term of a sum in which a parameter stands alone.
const NESTED: usize = 14;
const MULTIPLE: usize = 16;
const FRACTION: usize = 8;
const DIFFERENCE: usize = 12;

/// What a form is to a reader: the length of its text with all that is awkward, its operations, its text.
pub(super) type Reading = (usize, u64, String);

impl Graph {
    pub(super) fn reading(&self, id: Id) -> Reading {
        let text = self.to_text(id);
        (text.chars().count() + self.awkwardness(id), self.tree_cost(&[id]).total(), text)
    }

    /// The characters that count in addition to those of the text.
    fn awkwardness(&self, root: Id) -> usize {
        let mut total = 0;
        let mut stack = vec![(root, false)];
        while let Some((id, is_inner)) = stack.pop() {
            match self.view(id) {
                View::Sum(_) => {
                    let terms = self.flat_terms(id);
                    total += self.awkwardness_of_sum(&terms);
                    for (factor, term) in terms {
                        let is_fraction = !factor.is_integer() && !factor.is_decimal();
                        total += FRACTION * usize::from(is_inner && is_fraction);
                        stack.push((term, is_inner));
                    }
                }
                View::Product(factors) => {
                    total += NESTED * self.repeated_factors(id, id == root);
                    stack.extend(factors.iter().map(|(base, _)| (base, true)));
                }
                View::Function(Function::Sin | Function::Cos, args) => {
                    total += MULTIPLE * usize::from(self.is_multiple(args.get(0)));
                }
                View::Scale(factor, child) => {
                    total += FRACTION * self.cancelled_terms(self.get_number(factor), child);
                    stack.push((child, is_inner));
                }
                _ => {}
            }
        }
        total
    }

    /// The terms of a sum behind a fraction that its denominator cancels: two in `1/12*(12*I1 + 12*I2 + m*l**2)`.
    fn cancelled_terms(&self, factor: &Number, child: Id) -> usize {
        let Some(denominator) = factor.to_small().map(|(_, d)| d).filter(|&d| d > 1) else { return 0 };
        let is_cancelled =
            |(c, _): &(Number, Id)| c.to_small().is_some_and(|(n, d)| d == 1 && n % denominator == 0);
        let factors = match self.view(child) {
            View::Product(_) => self.flat_factors(child),
            _ => vec![(child, true)],
        };
        let sums = factors.into_iter().filter(|&(id, is_plain)| is_plain && self.is_sum(id));
        sums.map(|(id, _)| self.flat_terms(id).iter().filter(|term| is_cancelled(term)).count()).sum()
    }

    fn is_sum(&self, id: Id) -> bool {
        matches!(self.view(id), View::Sum(_))
    }

    /// The number of factors of a product that occur again inside the sums among its factors; a sum counts twice. Sines
    /// and cosines before a whole sum don't count.
    fn repeated_factors(&self, product: Id, is_whole: bool) -> usize {
        let factors = self.flat_factors(product);
        let mut inner: FxHashSet<Id> = FxHashSet::default();
        for &(sum, is_plain) in factors.iter().filter(|&&(base, _)| self.is_sum(base)) {
            if is_plain {
                let mut stack = vec![sum];
                while let Some(id) = stack.pop() {
                    match self.view(id) {
                        View::Sum(terms) => stack.extend(terms.iter().map(|(_, term)| term)),
                        View::Product(factors) => {
                            inner.extend(factors.iter().map(|(base, _)| base).filter(|&id| self.is_sum(id)));
                            stack.extend(factors.iter().map(|(base, _)| base));
                        }
                        View::Scale(_, child) => stack.push(child),
                        _ => {
                            inner.insert(id);
                        }
                    }
                }
            }
        }
        // A displacement stands in brackets of its own, times its lever or direction: `a*k*(a*theta - z)`.
        let is_motion = |id: Id| matches!(self.view(id), View::TimeFunction(..));
        let has_motion = inner.iter().any(|&id| is_motion(id));
        let is_outside = |id: Id| is_whole && matches!(self.view(id), View::Function(..));
        let counts =
            |base: Id| inner.contains(&base) && !is_outside(base) && (is_motion(base) || !has_motion);
        let weight = |base: Id| 1 + usize::from(self.is_sum(base));
        factors.iter().filter(|&&(base, _)| counts(base)).map(|&(base, _)| weight(base)).sum()
    }

    /// The factors of a product and of the products among them, and whether their exponent is one.
    fn flat_factors(&self, product: Id) -> Vec<(Id, bool)> {
        let (mut flat, mut stack) = (Vec::new(), vec![(product, true)]);
        while let Some((id, is_plain)) = stack.pop() {
            match self.view(id) {
                View::Product(factors) => {
                    let is_one = |e| self.get_number(e).is_one();
                    stack.extend(factors.iter().map(|(base, e)| (base, is_plain && is_one(e))));
                }
                View::Scale(_, child) => stack.push((child, is_plain)),
                _ => flat.push((id, is_plain)),
            }
        }
        flat
    }

    /// Characters for a negative term beside a parameter. `l**2 - l**2*cos(q)**2` is a square that is written as a
    /// difference, and `l2**2 - l1**2` is nothing in a mechanism; `R - l*cos(q)` is a place.
    fn awkwardness_of_negative(&self, term: Id) -> usize {
        match self.view(term) {
            View::Product(factors) => {
                let is_odd = |(base, exponent)| {
                    matches!(self.view(base), View::Function(..)) && !self.get_number(exponent).is_even()
                };
                let has_sum = self.flat_factors(term).iter().any(|&(base, _)| self.is_sum(base));
                if !has_sum && factors.iter().any(is_odd) { 0 } else { DIFFERENCE }
            }
            View::Function(..) => 0,
            _ => DIFFERENCE,
        }
    }

    /// The terms of a sum and of the sums among them, as they are printed: brackets stand only behind numbers, and
    /// terms that cancel are left out.
    fn flat_terms(&self, sum: Id) -> Vec<(Number, Id)> {
        let mut flat: BTreeMap<Id, Number> = BTreeMap::new();
        let mut stack = vec![(Number::integer(1), sum)];
        while let Some((factor, id)) = stack.pop() {
            match self.view(id) {
                View::Sum(terms) if factor.abs().is_one() => {
                    stack
                        .extend(terms.iter().map(|(inner, term)| (factor.mul(self.get_number(inner)), term)));
                }
                View::Scale(inner, child) => stack.push((factor.mul(self.get_number(inner)), child)),
                _ => {
                    let total = flat.get(&id).map_or_else(|| factor.clone(), |known| known.add(&factor));
                    flat.insert(id, total);
                }
            }
        }
        flat.into_iter().filter(|(_, factor)| !factor.is_zero()).map(|(id, factor)| (factor, id)).collect()
    }

    /// Characters for a factor that all terms of a sum have, and for each negative term of a sum in which a parameter
    /// stands by itself, but for such factors: `l2**2 - l1**2`, `l1*m1*cos(q) - l2*m2*cos(q)`.
    fn awkwardness_of_sum(&self, terms: &[(Number, Id)]) -> usize {
        let is_motion =
            |&(base, _): &(Id, bool)| !matches!(self.view(base), View::Symbol(..) | View::Number(_));
        let bases_of = |term| self.flat_factors(term).into_iter().filter(is_motion).map(|(base, _)| base);
        let motions: Vec<BTreeSet<Id>> = terms.iter().map(|&(_, term)| bases_of(term).collect()).collect();
        let is_shared = |base: &Id| motions.iter().all(|others| others.contains(base));
        let is_function = |base: &Id| matches!(self.view(*base), View::Function(..));
        let shared =
            motions.first().is_some_and(|bases| bases.iter().any(|b| is_function(b) && is_shared(b)));
        let has_parameter = motions.iter().any(|bases| bases.iter().all(is_shared));
        let negatives = terms.iter().filter(|(factor, _)| factor.is_negative());
        let difference: usize = negatives.map(|&(_, term)| self.awkwardness_of_negative(term)).sum();
        NESTED * usize::from(shared && terms.len() > 1) + difference * usize::from(has_parameter)
    }

    /// Whether an angle has a term with a whole number other than one before it.
    pub(super) fn is_multiple(&self, angle: Id) -> bool {
        let is_whole = |factor: &Number| factor.is_integer() && !factor.abs().is_one();
        let is_symbolic = |id: Id| !matches!(self.view(id), View::Pi | View::Number(_));
        match self.view(angle) {
            View::Scale(NumberId::MINUS_ONE, child) => self.is_multiple(child),
            View::Scale(factor, child) => is_whole(self.get_number(factor)) && is_symbolic(child),
            View::Sum(terms) => {
                terms.iter().any(|(factor, term)| is_whole(self.get_number(factor)) && is_symbolic(term))
            }
            _ => false,
        }
    }
}
