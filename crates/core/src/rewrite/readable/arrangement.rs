//! The arrangements of a polynomial: its content outside, and factors before brackets in which they don't occur.

use std::collections::BTreeMap;

use crate::error::Error;
use crate::graph::{Id, NumberId};
use crate::polynomial::{Budget, Monomial, Polynomial};
use crate::value::Number;

use super::flat_form::LONG_WAVES;
use super::{LONG, TERMS, WORK_ON_SQUARES};
use crate::rewrite::content::common_monomial;
use crate::rewrite::expand::Opening;
use crate::rewrite::ring::Ring;

/// The factors that are tried as the first one to be taken out; and the same for long polynomials.
const FIRST_FACTORS: [usize; 2] = [10, 3];
/// The same where squares are completed.
const FIRST_FACTORS_OF_SQUARES: usize = 4;
/// The most levels of brackets.
const DEEPEST: usize = 3;

impl Ring<'_> {
    /// Forms in which the sums among the factors of products stay closed, such as `R - r`.
    pub(super) fn closed_forms(&mut self, part: Id) -> Vec<Id> {
        match self.polynomial(part, Opening::Sums) {
            Ok(polynomial) => self.arrangements(&polynomial),
            Err(_) => Vec::new(),
        }
    }

    /// The arrangements of a polynomial, with its content outside.
    pub(super) fn arrangements(&mut self, polynomial: &Polynomial) -> Vec<Id> {
        let mut made = Vec::new();
        let Ok((monomial, factor, rest)) = whole_content(polynomial) else { return made };
        let outside = self.node_of(&Polynomial::term(monomial, factor));
        let mut sums: Vec<Result<Id, Error>> = vec![self.node_of(&rest), self.squared(&rest)];
        let mut firsts = factors_of(&rest);
        firsts.truncate(FIRST_FACTORS[usize::from(rest.len() >= LONG)]);
        for first in firsts {
            sums.push(self.grouped_sum(&rest, Some(first), DEEPEST));
        }
        made.extend(self.node_of(polynomial));
        let Ok(outside) = outside else { return made };
        for sum in sums.into_iter().flatten() {
            made.extend(self.product_of(&[outside, sum]));
        }
        made.extend(self.grouped_sum(polynomial, None, DEEPEST));
        made.extend(self.with_squares(polynomial, outside, &rest));
        made
    }

    /// Arrangements in which squares are completed where terms of one factor allow it.
    fn with_squares(&mut self, polynomial: &Polynomial, outside: Id, rest: &Polynomial) -> Vec<Id> {
        if polynomial.len() < 3 || polynomial.len() > LONG_WAVES {
            return Vec::new();
        }
        let budget = std::mem::replace(&mut self.budget, Budget::new(TERMS, WORK_ON_SQUARES));
        self.completes_squares = true;
        let whole = self.squares(rest, DEEPEST).ok().flatten();
        let mut made: Vec<Id> = Vec::new();
        made.extend(whole.and_then(|sum| self.product_of(&[outside, sum]).ok()));
        let firsts = factors_of(polynomial).into_iter().take(FIRST_FACTORS_OF_SQUARES).map(Some);
        for first in std::iter::once(None).chain(firsts) {
            self.budget = Budget::new(TERMS, WORK_ON_SQUARES);
            made.extend(self.grouped_sum(polynomial, first, DEEPEST));
        }
        self.completes_squares = false;
        self.budget = budget;
        made
    }

    /// The square of a sum, if the polynomial is one.
    fn squared(&mut self, polynomial: &Polynomial) -> Result<Id, Error> {
        let root = polynomial.square_root(&mut self.budget).filter(|root| root.len() > 1);
        let Some(root) = root else { return self.node_of(polynomial) };
        let root = self.grouped_sum(&root, None, DEEPEST)?;
        self.graph.pow_number(root, &Number::integer(2))
    }

    /// Numerator over denominator, both in their most readable forms.
    pub(super) fn over_common_denominator(&mut self, polynomial: &Polynomial) -> Option<Id> {
        let (numerator, denominator) = self.fraction(polynomial).ok()??;
        let numerator = self.graph.most_readable(numerator, false);
        self.graph.product(&[(numerator, NumberId::ONE), (denominator, NumberId::MINUS_ONE)]).ok()
    }

    /// A sum in which factors that several terms share stand before brackets in which they don't occur.
    fn grouped_sum(
        &mut self,
        polynomial: &Polynomial,
        first: Option<(u32, i64)>,
        depth: usize,
    ) -> Result<Id, Error> {
        let mut rest = polynomial.clone();
        let mut parts = Vec::new();
        let mut next = first;
        while depth > 0 && rest.len() > 1 {
            let chosen = match next.take() {
                Some(factor) => self.group_of(&rest, factor)?,
                None => self.best_group(&rest)?,
            };
            let Some((outside, columns)) = chosen else { break };
            let covered = columns.shifted(&outside, &Number::integer(1));
            rest.add_scaled(&covered, &Number::integer(-1));
            let (monomial, factor, columns) = numeric_content(&columns)?;
            let outside = self.node_of(&Polynomial::term(outside.times(&monomial), factor))?;
            let columns = match self.squares(&columns, depth)? {
                Some(squares) => squares,
                None => self.grouped_sum(&columns, None, depth - 1)?,
            };
            parts.push(self.product_of(&[outside, columns])?);
        }
        parts.push(self.node_of(&rest)?);
        Ok(self.sum_of(&parts))
    }

    /// A polynomial as the square of a sum and, where differences may be squared, another polynomial.
    fn squares(&mut self, polynomial: &Polynomial, depth: usize) -> Result<Option<Id>, Error> {
        if polynomial.len() < 3 {
            return Ok(None);
        }
        let (root, rest) = match polynomial.square_root(&mut self.budget) {
            Some(root) => (root, Polynomial::default()),
            None if self.completes_squares => match self.square_within(polynomial)? {
                Some(found) => found,
                None => return Ok(None),
            },
            None => return Ok(None),
        };
        let root = self.grouped_sum(&root, None, depth - 1)?;
        let square = self.graph.pow_number(root, &Number::integer(2))?;
        let rest = self.grouped_sum(&rest, None, depth - 1)?;
        Ok(Some(self.sum_of(&[square, rest])))
    }

    /// The root of the first square of two terms, `a**2 + 2*a*b + b**2`, within a polynomial, and the other terms.
    fn square_within(&mut self, polynomial: &Polynomial) -> Result<Option<(Polynomial, Polynomial)>, Error> {
        let terms: Vec<Polynomial> =
            polynomial.iter().map(|(m, c)| Polynomial::term(m.clone(), c.clone())).collect();
        let roots: Vec<Polynomial> =
            terms.iter().filter_map(|term| term.square_root(&mut self.budget)).collect();
        for (k, one) in roots.iter().enumerate() {
            for other in &roots[..k] {
                for sign in [1, -1] {
                    let mut root = one.clone();
                    root.add_scaled(other, &Number::integer(sign));
                    let mut rest = polynomial.clone();
                    let square = root.times(&root, &mut self.budget)?;
                    rest.add_scaled(&square, &Number::integer(-1));
                    if rest.len() + square.len() == polynomial.len() {
                        return Ok(Some((root, rest)));
                    }
                }
            }
        }
        Ok(None)
    }

    /// The group that saves most factors; among equal ones, that of the smallest atom.
    fn best_group(&mut self, polynomial: &Polynomial) -> Result<Option<(Monomial, Polynomial)>, Error> {
        let mut best: Option<(u64, (u32, i64))> = None;
        for factor in factors_of(polynomial) {
            self.budget.spend(polynomial.len())?;
            if let Some((holders, outside)) = self.factor_of_group(polynomial, factor) {
                let saving = self.width(&outside) * (holders as u64 - 1);
                if best.as_ref().is_none_or(|&(most, _)| saving > most) {
                    best = Some((saving, factor));
                }
            }
        }
        match best {
            Some((_, factor)) => self.group_of(polynomial, factor),
            None => Ok(None),
        }
    }

    /// About how long the text of a monomial is.
    fn width(&self, monomial: &Monomial) -> u64 {
        let of_factor = |&(atom, e): &(u32, i64)| {
            let wave = self.wave(atom).is_some();
            2 + if wave { 5 } else { 0 } + if e == 1 { 0 } else { 3 }
        };
        monomial.factors().iter().map(of_factor).sum()
    }

    /// The terms that hold a power, as a monomial times a sum in which no atom of the monomial occurs.
    fn group_of(
        &mut self,
        polynomial: &Polynomial,
        factor: (u32, i64),
    ) -> Result<Option<(Monomial, Polynomial)>, Error> {
        self.budget.spend(polynomial.len())?;
        let Some((_, outside)) = self.factor_of_group(polynomial, factor) else { return Ok(None) };
        let mut columns = Polynomial::default();
        for (monomial, coefficient) in polynomial.iter().filter(|(m, _)| m.exponent(factor.0) == factor.1) {
            columns.add_term(monomial.over(&outside), coefficient);
        }
        Ok(Some((outside, columns)))
    }

    /// The number of terms that hold a power, and what stands before them: the powers that all of them share, of atoms
    /// that occur in no other power there.
    fn factor_of_group(
        &self,
        polynomial: &Polynomial,
        (atom, exponent): (u32, i64),
    ) -> Option<(usize, Monomial)> {
        let is_wave = self.wave(atom).is_some();
        let mut holders: Vec<&Monomial> = Vec::new();
        for (monomial, _) in polynomial.iter() {
            match monomial.exponent(atom) {
                0 => {}
                found if found == exponent => holders.push(monomial),
                _ if is_wave => {}
                _ => return None, // a quadratic form stays flat
            }
        }
        let (&first, others) = holders.split_first().filter(|(_, others)| !others.is_empty())?;
        let is_shared = |atom| others.iter().all(|other| other.exponent(atom) == first.exponent(atom));
        let (outside, _) = first.split(is_shared);
        Some((holders.len(), outside))
    }
}

/// The powers that several terms hold, the most frequent first.
fn factors_of(polynomial: &Polynomial) -> Vec<(u32, i64)> {
    let mut counts: BTreeMap<(u32, i64), usize> = BTreeMap::new();
    for (monomial, _) in polynomial.iter() {
        for &factor in monomial.factors() {
            *counts.entry(factor).or_default() += 1;
        }
    }
    let mut shared: Vec<_> = counts.into_iter().filter(|&(_, count)| count > 1).collect();
    shared.sort_by_key(|&(factor, count)| (std::cmp::Reverse(count), factor));
    shared.into_iter().map(|(factor, _)| factor).collect()
}

/// The common monomial, the common numeric factor that leaves integers, and the rest.
fn whole_content(polynomial: &Polynomial) -> Result<(Monomial, Number, Polynomial), Error> {
    let monomial = common_monomial(polynomial);
    let rest = polynomial.shifted(&monomial.pow(-1), &Number::integer(1));
    let (_, factor, rest) = numeric_content(&rest)?;
    Ok((monomial, factor, rest))
}

/// The common numeric factor of a polynomial, taken out.
fn numeric_content(polynomial: &Polynomial) -> Result<(Monomial, Number, Polynomial), Error> {
    let factor = polynomial.numeric_content().abs();
    let rest = polynomial.shifted(&Monomial::default(), &factor.recip()?);
    Ok((Monomial::default(), factor, rest))
}
