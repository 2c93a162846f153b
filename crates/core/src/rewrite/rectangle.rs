//! Rectangles among the terms of a sum: if the terms hold y q for every y of a set Y and every q of a set Q, they are
//! (sum of Y) times (sum of Q).
//!
//! The search goes on with the terms that are left when a rectangle has been taken out. A rectangle that loses none of
//! its terms by that is the same as before: what couldn't be one of its rows can't become one. So it is kept.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;

use crate::error::Error;
use crate::interrupt::tick;
use crate::polynomial::{Budget, Monomial, Polynomial};
use crate::value::Number;

use super::content::content;

/// Sums of more terms are searched for common atoms only.
const LONGEST_SUM: usize = 256;

/// The terms y q of a sum, for y in `rows` and q in `columns`.
#[derive(Clone)]
pub(super) struct Rectangle {
    pub(super) rows: Polynomial,
    pub(super) columns: Polynomial,
    /// The places of its terms in the sum.
    pub(super) terms: Vec<usize>,
    /// The operations that it saves.
    saving: i64,
    /// Whether its rows are all that the sum offers.
    is_extended: bool,
}

/// The powers of atoms that the same terms have, several ones.
struct Power {
    holders: Vec<usize>,
    /// How many such powers there are.
    count: usize,
    /// The rectangle whose columns are the cofactors of the power, if it has been found.
    rectangle: Option<Rectangle>,
}

/// The terms of a sum that are in no rectangle yet.
pub(super) struct RectangleSearch<'p> {
    sum: &'p Polynomial,
    terms: Vec<(&'p Monomial, &'p Number)>,
    /// The operations of each term, with the addition of it.
    costs: Vec<i64>,
    codes: Vec<u64>,
    places: FxHashMap<u64, usize>,
    is_left: Vec<bool>,
    left: usize,
    powers: Vec<Power>,
}

impl<'p> RectangleSearch<'p> {
    pub(super) fn new(sum: &'p Polynomial) -> Self {
        let terms: Vec<_> = sum.iter().collect();
        let codes: Vec<u64> = terms.iter().map(|(monomial, _)| code(monomial)).collect();
        let mut powers: BTreeMap<(u32, i64), Vec<usize>> = BTreeMap::new();
        for (place, (monomial, _)) in terms.iter().enumerate() {
            for &factor in monomial.factors() {
                powers.entry(factor).or_default().push(place);
            }
        }
        Self {
            sum,
            costs: terms.iter().map(|&(monomial, number)| term_cost(monomial, number)).collect(),
            places: codes.iter().enumerate().map(|(place, &code)| (code, place)).collect(),
            is_left: vec![true; terms.len()],
            left: terms.len(),
            powers: by_holders(powers.into_values()),
            terms,
            codes,
        }
    }

    /// The rectangle that saves most; among equal ones, that of the smallest atom.
    pub(super) fn best(&mut self, budget: &mut Budget) -> Result<Option<Rectangle>, Error> {
        budget.spend(self.left)?;
        let extends = self.left <= LONGEST_SUM;
        let most = self.powers.iter().map(|power| power.holders.len()).max().unwrap_or(0);
        let least = if extends { 2 } else { most.max(2) };
        let mut best: Option<usize> = None;
        for at in 0..self.powers.len() {
            if self.powers[at].holders.len() < least {
                continue;
            }
            if self.powers[at].rectangle.as_ref().is_none_or(|known| known.is_extended != extends) {
                let holders = self.powers[at].holders.clone();
                self.powers[at].rectangle = Some(self.rectangle_of(&holders, extends)?);
            }
            let Some(rectangle) = &self.powers[at].rectangle else { continue };
            if extends {
                budget.spend(self.powers[at].count * (rectangle.columns.len() + self.left))?;
            }
            let known = best.and_then(|at| self.powers[at].rectangle.as_ref());
            if rectangle.saving > known.map_or(0, |known| known.saving) {
                best = Some(at);
            }
        }
        Ok(best.and_then(|at| self.powers[at].rectangle.clone()))
    }

    /// Take terms out of the sum.
    pub(super) fn remove(&mut self, terms: &[usize]) {
        for &place in terms {
            self.is_left[place] = false;
        }
        self.left -= terms.len();
        let is_left = &self.is_left;
        for power in &mut self.powers {
            power.holders.retain(|&place| is_left[place]);
            if power.rectangle.as_ref().is_some_and(|known| known.terms.iter().any(|&place| !is_left[place]))
            {
                power.rectangle = None;
            }
        }
    }

    /// The sum of the terms that are left.
    pub(super) fn rest(&self) -> Polynomial {
        self.sum_of((0..self.terms.len()).filter(|&place| self.is_left[place]))
    }

    fn sum_of(&self, places: impl Iterator<Item = usize>) -> Polynomial {
        Polynomial::of_terms(places.map(|place| {
            let (monomial, number) = self.terms[place];
            (monomial.clone(), number.clone())
        }))
    }

    /// The rectangle whose columns are the cofactors of what the terms at `holders` have in common.
    fn rectangle_of(&self, holders: &[usize], extends: bool) -> Result<Rectangle, Error> {
        let (monomial, factor, columns) = content(&self.sum_of(holders.iter().copied()))?;
        let mut rows = Polynomial::term(monomial, factor);
        let mut terms = holders.to_vec();
        if extends {
            self.extend_rows(&columns, &mut rows, &mut terms)?;
        }
        let covered = terms.iter().map(|&place| self.costs[place]).sum::<i64>() - 1;
        let joining = i64::from(!is_unit(&rows) && !is_unit(&columns));
        let saving = covered - cost(&rows) - cost(&columns) - joining;
        Ok(Rectangle { rows, columns, terms, saving, is_extended: extends })
    }

    /// Find the other monomials whose products with all columns are terms of the sum.
    fn extend_rows(
        &self,
        columns: &Polynomial,
        rows: &mut Polynomial,
        terms: &mut Vec<usize>,
    ) -> Result<(), Error> {
        let Some((lead, lead_factor)) = columns.iter().next_back() else { return Ok(()) };
        let (lead_code, inverse) = (code(lead), lead_factor.recip()?);
        let codes: Vec<u64> =
            columns.iter().map(|(column, _)| code(column).wrapping_sub(lead_code)).collect();
        let mut is_free = self.is_left.clone();
        for &place in terms.iter() {
            is_free[place] = false;
        }
        for place in 0..self.terms.len() {
            tick();
            // A row of which a column leads to no term is no row: few remain to be compared.
            let is_term = |offset: &u64| self.places.contains_key(&self.codes[place].wrapping_add(*offset));
            if !is_free[place] || !codes.iter().all(is_term) {
                continue;
            }
            let (monomial, coefficient) = self.terms[place];
            let row = monomial.over(lead);
            let factor = coefficient.mul(&inverse);
            let Some(found) = self.row(&row, &factor, columns, &is_free) else { continue };
            for &place in &found {
                is_free[place] = false;
            }
            terms.extend(found);
            rows.add_term(row, &factor);
        }
        Ok(())
    }

    /// The places of the products of a row with all columns, if these are terms that are free.
    fn row(
        &self,
        row: &Monomial,
        factor: &Number,
        columns: &Polynomial,
        is_free: &[bool],
    ) -> Option<Vec<usize>> {
        let place_of = |(column, number): (&Monomial, &Number)| {
            let place = self.place(&row.times(column))?;
            let is_term = is_free[place] && self.terms[place].1.same_value(&factor.mul(number));
            is_term.then_some(place)
        };
        columns.iter().map(place_of).collect()
    }

    /// The place of a monomial in the sum. Two monomials may have one code.
    fn place(&self, monomial: &Monomial) -> Option<usize> {
        let &place = self.places.get(&code(monomial))?;
        if self.terms[place].0 == monomial {
            return Some(place);
        }
        self.sum.coefficient(monomial)?;
        self.terms.iter().position(|&(known, _)| known == monomial)
    }
}

/// One entry for each set of holders, in the order in which they come.
fn by_holders(all: impl Iterator<Item = Vec<usize>>) -> Vec<Power> {
    let mut places: FxHashMap<Vec<usize>, usize> = FxHashMap::default();
    let mut powers: Vec<Power> = Vec::new();
    for holders in all.filter(|holders| holders.len() > 1) {
        let place = *places.entry(holders.clone()).or_insert(powers.len());
        match powers.get_mut(place) {
            Some(power) => power.count += 1,
            None => powers.push(Power { holders, count: 1, rectangle: None }),
        }
    }
    powers
}

/// A number for each monomial, such that the number of a product is the sum of those of its factors.
fn code(monomial: &Monomial) -> u64 {
    let bits = |exponent: i64| u64::from_ne_bytes(exponent.to_ne_bytes());
    let of_power = |&(atom, exponent): &(u32, i64)| spread(atom).wrapping_mul(bits(exponent));
    monomial.factors().iter().map(of_power).fold(0, u64::wrapping_add)
}

/// A number of 64 bits that looks random [Steele et al. 2014, `SplitMix`].
fn spread(atom: u32) -> u64 {
    let mut word = (u64::from(atom) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    word ^ (word >> 31)
}

/// The multiplications of a term, and the addition of it.
fn term_cost(monomial: &Monomial, coefficient: &Number) -> i64 {
    let powers: i64 =
        monomial.factors().iter().map(|&(_, e)| 1 + i64::from(e.unsigned_abs().max(1).ilog2())).sum();
    let numeric = i64::from(!coefficient.abs().is_one() && !monomial.is_one());
    (powers - 1).max(0) + numeric + 1
}

fn cost(sum: &Polynomial) -> i64 {
    sum.iter().map(|(monomial, coefficient)| term_cost(monomial, coefficient)).sum::<i64>() - 1
}

fn is_unit(sum: &Polynomial) -> bool {
    sum.single().is_some_and(|(monomial, number)| monomial.is_one() && number.abs().is_one())
}
