//! Trees put together: nested sums and products merged, like terms one term, signs where they read best, all in the
//! reader's order.

use crate::value::Number;

use super::order;
use super::plan::is_sign;
use super::tree::{Base, Factor, Sum, Term};

impl Sum {
    pub(super) fn atom(base: Base) -> Self {
        Term::power(base, Number::integer(1)).into_sum()
    }

    /// Terms merged and put in order.
    pub(super) fn new(mut terms: Vec<Term>) -> Self {
        for term in &mut terms {
            term.settle();
        }
        let mut terms = order::sorted_terms(terms);
        terms.dedup_by(|next, kept| {
            let like = next.factors == kept.factors;
            if like {
                kept.coefficient = kept.coefficient.add(&next.coefficient);
            }
            like
        });
        terms.retain(|term| !term.coefficient.is_zero());
        if terms.is_empty() {
            return Self::number(Number::integer(0));
        }
        for term in &mut terms {
            term.give_sign_away();
        }
        positive_first(&mut terms);
        Self { terms }
    }

    /// The sum times a number: over the terms where only signs change or fractions vanish.
    pub(super) fn times(mut self, factor: &Number) -> Self {
        let distributes = self.terms.len() == 1 || is_sign(factor) || self.clears_fractions(factor);
        if distributes {
            for term in &mut self.terms {
                term.coefficient = term.coefficient.mul(factor);
            }
            return Self::new(self.terms);
        }
        let mut term = Term::power(Base::Group(self), Number::integer(1));
        term.coefficient = factor.clone();
        Self::new(vec![term])
    }

    fn clears_fractions(&self, factor: &Number) -> bool {
        let whole = |number: Number| number.is_integer() && !number.is_decimal();
        factor.is_integer()
            && self.terms.iter().any(|term| !term.coefficient.is_integer())
            && self.terms.iter().all(|term| whole(term.coefficient.mul(factor)))
    }

    fn negatives(&self) -> usize {
        self.terms.iter().filter(|term| term.coefficient.is_negative()).count()
    }

    /// Whether the sum is the difference of two terms of one kind, which reads as well the other way round.
    fn is_even_difference(&self) -> bool {
        matches!(&self.terms[..], [a, b] if self.negatives() == 1
            && order::are_of_one_kind(a, b)
            && a.is_subtracted() == b.is_subtracted())
    }

    /// Whether the opposite has fewer minus signs. The deflection of a spring has the sign of its first coordinate in all
    /// equations, `z - a*theta - z1`; that of a mass between two springs has its own sign, `2*x2 - x1 - x3`.
    fn reads_better_negated(&self) -> bool {
        if self.is_deflection() {
            let first = self.terms.iter().min_by(|a, b| order::compare_terms(a, b));
            return self.balancing().or(first).is_some_and(|term| term.coefficient.is_negative());
        }
        2 * self.negatives() > self.terms.len()
    }

    /// Whether the opposite of an argument reads better: of a negative term, and of a difference of coordinates of equations
    /// that doesn't begin with the first of these, `sin(knee - hip)`.
    pub(super) fn is_opposite_angle(&self) -> bool {
        if let [term] = &self.terms[..] {
            return term.coefficient.is_negative();
        }
        let negatives = self.negatives();
        let is_difference = negatives > 0 && self.terms.iter().all(order::is_displacement);
        let first = self.terms.iter().min_by(|a, b| order::compare_terms(a, b));
        is_difference && first.is_some_and(|term| term.coefficient.is_negative())
    }

    /// The only term of its sign, if its number is that of all others together.
    fn balancing(&self) -> Option<&Term> {
        let total = self.terms.iter().fold(Number::integer(0), |sum, term| sum.add(&term.coefficient));
        let alone = if self.negatives() == 1 { 1 } else { self.terms.len() - 1 };
        let is_alone = |term: &&Term| term.coefficient.is_negative() == (alone == 1);
        (total.is_zero() && self.negatives() == alone).then(|| self.terms.iter().find(is_alone)).flatten()
    }

    /// Whether the sum is that of multiples of three coordinates of equations or more, of both signs.
    fn is_deflection(&self) -> bool {
        let negatives = self.negatives();
        let is_mixed = negatives > 0 && negatives < self.terms.len();
        self.terms.len() > 2 && is_mixed && self.terms.iter().all(order::is_displacement)
    }
}

/// `b - a` rather than `-a + b`, and `x + l*cos(q) - a` for parameters before coordinates, or coordinates before
/// functions.
fn positive_first(terms: &mut [Term]) {
    let Some(first) = terms.iter().position(|term| !term.coefficient.is_negative()) else { return };
    if first > 0 && order::are_of_different_kinds(&terms[0], &terms[first]) {
        terms.rotate_left(first);
    } else {
        terms[..=first].rotate_right(1);
    }
}

impl Term {
    pub(super) fn one() -> Self {
        Self { coefficient: Number::integer(1), factors: Vec::new() }
    }

    fn power(base: Base, exponent: Number) -> Self {
        Self { coefficient: Number::integer(1), factors: vec![Factor { base, exponent }] }
    }

    /// Multiply by sum ** exponent, merging a product into this one where that is allowed.
    pub(super) fn multiply(&mut self, sum: Sum, exponent: &Number) {
        let base = match <[Term; 1]>::try_from(sum.terms) {
            Ok([term]) => match self.absorb(term, exponent) {
                Ok(()) => return,
                Err(term) => Base::Group(Sum { terms: vec![term] }),
            },
            Err(terms) => Base::Group(Sum { terms }),
        };
        self.factors.push(Factor { base, exponent: exponent.clone() });
    }

    /// Multiply by term ** exponent; the term comes back where (a*b)**e is not a**e*b**e.
    fn absorb(&mut self, mut term: Self, exponent: &Number) -> Result<(), Self> {
        if let Some(n) = exponent.to_i64()
            && let Ok(power) = term.coefficient.powi(n)
        {
            self.coefficient = self.coefficient.mul(&power);
            let powers = term.factors.into_iter();
            self.factors.extend(powers.map(|f| Factor { base: f.base, exponent: f.exponent.mul(exponent) }));
            return Ok(());
        }
        let base = match &term.factors[..] {
            [] if !term.coefficient.is_negative() => Base::Number(term.coefficient),
            [factor] if factor.exponent.is_one() && term.coefficient.is_one() => match term.factors.pop() {
                Some(factor) => factor.base,
                None => return Ok(()),
            },
            _ => return Err(term),
        };
        self.factors.push(Factor { base, exponent: exponent.clone() });
        Ok(())
    }

    /// Order the factors, merge equal bases, and put the signs where they read best.
    fn settle(&mut self) {
        for factor in &mut self.factors {
            self.coefficient = self.coefficient.mul(&factor.settle_sign());
        }
        self.factors.sort_by(|a, b| order::compare_bases(&a.base, &b.base));
        self.factors.dedup_by(|next, kept| {
            let same = next.base == kept.base;
            if same {
                kept.exponent = kept.exponent.add(&next.exponent);
            }
            same
        });
        self.factors.retain(|factor| !factor.exponent.is_zero());
        self.fold_numbers();
    }

    /// Numbers that have lost their root.
    fn fold_numbers(&mut self) {
        let coefficient = &mut self.coefficient;
        self.factors.retain(|factor| match (&factor.base, factor.exponent.to_i64()) {
            (Base::Number(number), Some(n)) => match number.powi(n) {
                Ok(power) => {
                    *coefficient = coefficient.mul(&power);
                    false
                }
                Err(_) => true,
            },
            _ => true,
        });
    }

    /// `-m*(a - b)` is `m*(b - a)`; but a coordinate stays before a parameter: `-m*(x - a)`.
    fn give_sign_away(&mut self) {
        if !self.coefficient.is_negative() {
            return;
        }
        let takes_sign = |factor: &&mut Factor| match &factor.base {
            Base::Group(sum) => {
                is_odd(&factor.exponent) && (sum.reads_better_negated() || sum.is_even_difference())
            }
            _ => false,
        };
        if let Some(factor) = self.factors.iter_mut().find(takes_sign) {
            factor.negate_base();
            self.coefficient = self.coefficient.neg();
        }
    }

    pub(super) fn into_sum(mut self) -> Sum {
        self.settle();
        match &self.factors[..] {
            [Factor { base: Base::Group(sum), exponent }] if exponent.is_one() => {
                sum.clone().times(&self.coefficient)
            }
            _ => Sum::new(vec![self]),
        }
    }
}

impl Factor {
    /// Bring a group to the sign that equal groups share; return the sign that comes out.
    fn settle_sign(&mut self) -> Number {
        let one = Number::integer(1);
        let (Base::Group(sum), Some(n)) = (&self.base, self.exponent.to_i64()) else { return one };
        let half = 2 * sum.negatives() == sum.terms.len();
        let leads_negative = half && {
            let subtracted = |a: &Term, b: &Term| a.is_subtracted().cmp(&b.is_subtracted());
            let least = sum.terms.iter().min_by(|a, b| subtracted(a, b).then(order::compare_terms(a, b)));
            least.is_some_and(|term| term.coefficient.is_negative())
        };
        if !(sum.reads_better_negated() || leads_negative) {
            return one;
        }
        self.negate_base();
        if n % 2 == 0 { one } else { one.neg() }
    }

    fn negate_base(&mut self) {
        if let Base::Group(sum) = &mut self.base {
            *sum = sum.clone().times(&Number::integer(-1));
        }
    }
}

fn is_odd(exponent: &Number) -> bool {
    exponent.to_i64().is_some_and(|n| n % 2 != 0)
}
