//! The shortest of a fixed list of forms.
//!
//! Every candidate is a form that textbooks use: terms flattened or multiplied out, sines and cosines in one of a few
//! normal forms, common factors taken out, terms collected by accelerations, speeds, parameters or angles. A
//! candidate is accepted if it has the same value at the random point and costs no more operations than the input.
//! The one that reads shortest is the result. The list is finite, so the search ends.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::error::Error;
use crate::graph::{Cost, Graph, Id, NumberId, View};
use crate::polynomial::{Budget, Monomial, Polynomial};
use crate::value::Number;

use super::collect::{Kind, grouped};
use super::content::content;
use super::expand::Opening;
use super::ring::Ring;
use super::search::Search;

/// The most terms of a polynomial, and the most terms handled for one part of an expression.
const TERMS: usize = 2_000;
const WORK: usize = 400_000;
/// The most terms handled and nodes visited for a whole expression.
const TOTAL_WORK: usize = 2_000_000;
const LEAST_WORK: usize = 100_000;
const WORK_PER_NODE: usize = 5_000;
/// Parts with more nodes stay unchanged.
const LARGEST_PART: usize = 4_000;
/// The most levels of coefficients within coefficients that are simplified on their own.
const DEEPEST: usize = 2;
/// The most sums of speeds that replace a speed.
const MOST_SUMS: usize = 16;
/// The most repetitions, as long as the result gets cheaper.
const ROUNDS: usize = 3;

/// The treatment of sines and cosines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Trigonometry {
    Kept,
    /// Identities where they leave fewer terms.
    Shortened,
    /// The shortest form for each product of parameters.
    Shortest,
    /// No squares of sines; no squares of cosines.
    NoSines,
    NoCosines,
    /// Sines and cosines of sums only.
    Combined,
}

/// The polynomials that candidates are made from.
const POLYNOMIALS: [(Opening, Trigonometry); 8] = [
    (Opening::Sums, Trigonometry::Kept),
    (Opening::Products, Trigonometry::Kept),
    (Opening::Products, Trigonometry::Shortened),
    (Opening::Angles, Trigonometry::Shortened),
    (Opening::Angles, Trigonometry::Shortest),
    (Opening::Angles, Trigonometry::NoSines),
    (Opening::Angles, Trigonometry::NoCosines),
    (Opening::Angles, Trigonometry::Combined),
];

/// The orders in which a sum is collected; common factors come out of what is left.
const ARRANGEMENTS: [&[Kind]; 4] =
    [&[], &[Kind::Acceleration, Kind::Speed], &[Kind::Parameter], &[Kind::Wave]];

/// The parts whose coefficients are simplified on their own.
const COEFFICIENTS: [&[Kind]; 2] = [&[Kind::Acceleration, Kind::Speed], &[Kind::Parameter]];

/// The length of a form for a reader: its operations, where an addition counts as three because it makes another term;
/// then additions, then functions. (Ties are broken by the size of the tree, then by the terms outside brackets.)
fn length(cost: Cost) -> (u64, u64, u64) {
    (cost.total().saturating_add(cost.additions.saturating_mul(2)), cost.additions, cost.functions)
}

impl Graph {
    /// The shortest of a fixed list of forms of an expression.
    ///
    /// # Errors
    /// If a part cannot be rebuilt.
    pub fn simplify(&mut self, id: Id) -> Result<Id, Error> {
        self.choose_form(|graph| {
            let flat = graph.with_flat_sums(id)?;
            let flat = if graph.cost(&[flat]).total() <= graph.cost(&[id]).total() { flat } else { id };
            let work = graph.total_work(flat);
            // The whole expression comes first: if its form is short, its parts take little time.
            let mut search = Search::new(work / 4);
            let whole = graph.simplest(flat, DEEPEST, &mut search);
            let mut best = graph.shortest(flat, &[whole]);
            let mut search = Search::new(work);
            for _ in 0..ROUNDS {
                let parts = |graph: &mut Self, part| Ok(graph.simplest(part, DEEPEST, &mut search));
                let next = graph.inside_out(best, Self::push_enclosed_or_factors, &mut { parts })?;
                let next = graph.shortest(best, &[next]);
                if next == best {
                    break;
                }
                best = next;
            }
            // Where the parts are shorter now, the whole may be within the limits that it exceeded before.
            if best != whole {
                let again = graph.simplest(best, DEEPEST, &mut Search::new(graph.total_work(best) / 4));
                best = graph.shortest(best, &[again]);
            }
            Ok(best)
        })
    }

    /// The candidate that reads shortest among those that have the value of `part` and cost no more.
    fn shortest(&self, part: Id, candidates: &[Id]) -> Id {
        let tree = |id: Id| (self.tree_cost(&[id]).total(), self.outer_terms(id));
        let bound = self.cost(&[part]);
        let mut best = (length(bound), part);
        for &candidate in candidates {
            let cost = self.cost(&[candidate]);
            if !self.same(candidate, part) || cost.total() > bound.total() {
                continue;
            }
            let order = length(cost).cmp(&best.0);
            if order.then_with(|| tree(candidate).cmp(&tree(best.1))).is_lt() {
                best = (length(cost), candidate);
            }
        }
        best.1
    }

    /// The work of a simplification, in proportion to the size of the expression.
    fn total_work(&self, id: Id) -> usize {
        TOTAL_WORK.min(LEAST_WORK + WORK_PER_NODE * self.bounded_size(id, TOTAL_WORK / WORK_PER_NODE))
    }

    /// The terms outside all brackets.
    fn outer_terms(&self, id: Id) -> usize {
        let mut stack = vec![id];
        let mut count = 0;
        while let Some(id) = stack.pop() {
            match self.view(id) {
                View::Sum(terms) => stack.extend(terms.iter().map(|(_, term)| term)),
                _ => count += 1,
            }
        }
        count
    }

    /// The best candidate for a part, or the part itself.
    fn simplest(&mut self, part: Id, depth: usize, search: &mut Search) -> Id {
        let key = (part, depth);
        if let Some(form) = search.known(self, key) {
            return form;
        }
        let frame = search.begin();
        let mut best = part;
        let size = self.bounded_size(part, LARGEST_PART.min(search.work.left()));
        let affordable = search.work.spend(size).is_ok() && size <= LARGEST_PART;
        if affordable && size > 1 {
            let candidates = self.candidates(part, depth, search);
            let _ = search.work.spend(size * candidates.len());
            best = self.shortest(part, &candidates);
            best = self.without_fractions(best);
        }
        search.end(self, frame, key, best);
        best
    }

    /// The form with integer coefficients in all its sums, unless it reads longer.
    fn without_fractions(&mut self, part: Id) -> Id {
        match self.whole(part) {
            Ok(whole)
                if self.same(whole, part) && length(self.cost(&[whole])) <= length(self.cost(&[part])) =>
            {
                whole
            }
            _ => part,
        }
    }

    /// Take the fractions among the coefficients of a sum out of it, from the innermost sums outward.
    fn whole(&mut self, root: Id) -> Result<Id, Error> {
        let mut known: FxHashMap<Id, (Number, Id)> = FxHashMap::default();
        let look_up = |known: &FxHashMap<Id, (Number, Id)>, id: Id| {
            known.get(&id).cloned().unwrap_or_else(|| (Number::integer(1), id))
        };
        for id in self.post_order(&[root]) {
            let whole = match self.view(id) {
                View::Scale(factor, child) => {
                    let factor = self.get_number(factor).clone();
                    let (inner, node) = look_up(&known, child);
                    (factor.mul(&inner), node)
                }
                View::Sum(terms) => {
                    let terms: Vec<_> =
                        terms.iter().map(|(c, node)| (self.get_number(c).clone(), node)).collect();
                    self.whole_sum(&terms, |id| look_up(&known, id))?
                }
                View::Product(factors) => {
                    let factors: Vec<_> =
                        factors.iter().map(|(base, e)| (base, self.get_number(e).clone())).collect();
                    self.whole_product(&factors, |id| look_up(&known, id))?
                }
                _ => continue,
            };
            known.insert(id, whole);
        }
        let (factor, node) = look_up(&known, root);
        let factor = self.number_id(&factor);
        Ok(self.scale(factor, node))
    }

    fn whole_sum(
        &mut self,
        terms: &[(Number, Id)],
        look_up: impl Fn(Id) -> (Number, Id),
    ) -> Result<(Number, Id), Error> {
        let mut coefficients = Polynomial::default();
        let mut parts = Vec::new();
        for (position, (coefficient, node)) in (0..).zip(terms) {
            let (inner, node) = look_up(*node);
            let coefficient = coefficient.mul(&inner);
            coefficients.add_term(Monomial::power(position, 1), &coefficient);
            parts.push((coefficient, node));
        }
        let is_fraction = |(c, _): &(Number, Id)| !c.is_integer() && !c.is_decimal();
        let factor = if parts.iter().any(is_fraction) {
            coefficients.numeric_content().abs()
        } else {
            Number::integer(1)
        };
        let inverse = factor.recip()?;
        let parts: Vec<_> = parts.iter().map(|(c, node)| (self.number_id(&c.mul(&inverse)), *node)).collect();
        Ok((factor, self.sum(&parts)))
    }

    fn whole_product(
        &mut self,
        factors: &[(Id, Number)],
        look_up: impl Fn(Id) -> (Number, Id),
    ) -> Result<(Number, Id), Error> {
        let mut factor = Number::integer(1);
        let mut parts = Vec::new();
        for (base, exponent) in factors {
            let (inner, node) = look_up(*base);
            match exponent.to_i64() {
                Some(n) => {
                    factor = factor.mul(&inner.powi(n)?);
                    parts.push((node, self.number_id(exponent)));
                }
                None => parts.push((*base, self.number_id(exponent))),
            }
        }
        Ok((factor, self.product(&parts)?))
    }

    /// The sums of speeds alone, or of accelerations alone, that occur; shorter ones first.
    fn sums_of_rates(&self, part: Id) -> Vec<Id> {
        let is_sum = |id: &Id| {
            matches!(self.view(*id), View::Sum(_)) && self.rate_order(*id).is_some_and(|order| order > 0)
        };
        let mut sums: Vec<Id> = self.post_order(&[part]).into_iter().filter(is_sum).collect();
        sums.sort_by_key(|&sum| self.children(sum).len());
        sums.truncate(MOST_SUMS);
        sums
    }

    /// The number of nodes of a part; the count stops above `limit`.
    fn bounded_size(&self, part: Id, limit: usize) -> usize {
        let mut seen: FxHashSet<Id> = FxHashSet::default();
        let mut stack = vec![part];
        while let Some(id) = stack.pop().filter(|_| seen.len() <= limit) {
            if seen.insert(id) {
                self.push_children(id, &mut stack);
            }
        }
        seen.len()
    }

    fn candidates(&mut self, part: Id, depth: usize, search: &mut Search) -> Vec<Id> {
        let allowed = WORK.min(search.work.left());
        let mut ring = Ring::new(self, Budget::new(TERMS, allowed));
        let mut polynomials = ring.polynomials(part);
        let sums = ring.graph.sums_of_rates(part);
        polynomials.extend(ring.over_sums(&polynomials, &sums));
        let mut candidates = Vec::new();
        for polynomial in &polynomials {
            // A form beyond the limits is not a candidate.
            candidates.extend(ring.node_of(polynomial));
            for kinds in ARRANGEMENTS {
                candidates.extend(ring.arranged(polynomial, kinds));
            }
        }
        // Beyond the limit no work is left, which ends the search at the next part.
        let _ = search.work.spend(allowed - ring.budget.left());
        if depth > 0 {
            for polynomial in polynomials.iter().take(2) {
                for kinds in COEFFICIENTS {
                    let form = ring.by_coefficients(polynomial, kinds, depth, search);
                    candidates.extend(form.ok().flatten());
                }
                candidates.extend(ring.as_fraction(polynomial, depth, search));
            }
        }
        let mut seen: FxHashSet<Id> = FxHashSet::default();
        candidates.retain(|&candidate| seen.insert(candidate));
        candidates
    }
}

impl Ring<'_> {
    /// The distinct polynomials of a part that are within the limits.
    pub(super) fn polynomials(&mut self, part: Id) -> Vec<Polynomial> {
        let mut forms: Vec<Polynomial> = Vec::new();
        let mut opened: Option<(Opening, Polynomial)> = None;
        for (opening, trigonometry) in POLYNOMIALS {
            let polynomial = match &opened {
                Some((known, polynomial)) if *known == opening => Ok(polynomial.clone()),
                _ => self.polynomial(part, opening),
            };
            let Ok(polynomial) = polynomial else { continue };
            opened = Some((opening, polynomial.clone()));
            let form = self.form(polynomial, trigonometry);
            forms.extend(form.ok().filter(|form| !forms.contains(form)));
        }
        forms
    }

    /// The polynomials written in sums of rates, such as the speed of rotation of each link of a chain.
    fn over_sums(&mut self, polynomials: &[Polynomial], sums: &[Id]) -> Vec<Polynomial> {
        let rules = self.rules(sums);
        let mut forms: Vec<Polynomial> = Vec::new();
        for polynomial in polynomials.iter().filter(|_| !rules.is_empty()) {
            let mut form = Ok(polynomial.clone());
            for (atom, rule) in &rules {
                form = form.and_then(|form| self.replaced(&form, *atom, rule));
            }
            forms.extend(form.ok().filter(|form| !polynomials.contains(form) && !forms.contains(form)));
        }
        forms
    }

    /// For each sum: one of its rates, the one that occurs in fewest sums, as the sum minus the other rates.
    fn rules(&mut self, sums: &[Id]) -> Vec<(u32, Polynomial)> {
        let mut flat: Vec<(Polynomial, Polynomial)> = Vec::new();
        for &sum in sums {
            let View::Sum(terms) = self.graph.view(sum) else { continue };
            let terms: Vec<_> =
                terms.iter().map(|(c, node)| (self.graph.get_number(c).clone(), node)).collect();
            let mut rates = Polynomial::default();
            for (coefficient, node) in terms {
                rates.add_scaled(&self.leaf(node), &coefficient);
            }
            flat.push((self.leaf(sum), rates));
        }
        let mut rules: Vec<(u32, Polynomial)> = Vec::new();
        for (sum, rates) in &flat {
            let mut rest = rates.clone();
            for (atom, rule) in &rules {
                let Ok(next) = self.replaced(&rest, *atom, rule) else { return Vec::new() };
                rest = next;
            }
            let uses = |atom: &u32| flat.iter().filter(|(_, rates)| rates.atoms().contains(atom)).count();
            let is_rate = |atom: &u32| matches!(self.graph.view(self.node(*atom)), View::TimeFunction(..));
            let rare = rest.atoms().into_iter().rev().filter(is_rate).min_by_key(uses);
            let Some(atom) = rare else { continue };
            let Some(factor) = rest.coefficient(&Monomial::power(atom, 1)).and_then(|c| c.recip().ok())
            else {
                continue;
            };
            // sum = ... + c rate, so rate = (sum - ...) / c.
            rest.add_scaled(sum, &Number::integer(-1));
            let mut rule = rest.scaled(&factor.neg());
            rule.add_term(Monomial::power(atom, 1), &Number::integer(1));
            rules.push((atom, rule));
        }
        rules
    }

    /// A polynomial with an atom replaced; its negative powers stay.
    fn replaced(
        &mut self,
        polynomial: &Polynomial,
        atom: u32,
        rule: &Polynomial,
    ) -> Result<Polynomial, Error> {
        let mut result = Polynomial::default();
        for (power, cofactor) in grouped(polynomial, |other| other == atom) {
            let exponent = power.exponent(atom);
            let term = if exponent > 0 {
                let power = self.power(rule, exponent.unsigned_abs())?;
                self.times(&cofactor, &power)?
            } else {
                cofactor.shifted(&power, &Number::integer(1))
            };
            result.add_scaled(&term, &Number::integer(1));
        }
        Ok(result)
    }

    fn form(&mut self, polynomial: Polynomial, trigonometry: Trigonometry) -> Result<Polynomial, Error> {
        match trigonometry {
            Trigonometry::Kept => Ok(polynomial),
            Trigonometry::Shortened => self.shortened(&polynomial),
            Trigonometry::Shortest => self.shortest_trig(&polynomial),
            Trigonometry::NoSines => self.eliminate_all(&polynomial, |(sin, cos)| (sin, cos)),
            Trigonometry::NoCosines => self.eliminate_all(&polynomial, |(sin, cos)| (cos, sin)),
            Trigonometry::Combined => self.combined(&polynomial),
        }
    }

    fn arranged(&mut self, polynomial: &Polynomial, kinds: &[Kind]) -> Result<Id, Error> {
        if kinds.is_empty() {
            return self.factored(polynomial);
        }
        let (monomial, factor, rest) = content(polynomial)?;
        let sum = self.collected(&rest, kinds)?;
        let outside = self.node_of(&Polynomial::term(monomial, factor))?;
        self.product_of(&[outside, sum])
    }

    /// The sum of products of these kinds times coefficients, each coefficient the simplest of its forms.
    fn by_coefficients(
        &mut self,
        polynomial: &Polynomial,
        kinds: &[Kind],
        depth: usize,
        search: &mut Search,
    ) -> Result<Option<Id>, Error> {
        let (monomial, factor, rest) = content(polynomial)?;
        let mut parts = Vec::new();
        let groups = grouped(&rest, |atom| kinds.iter().any(|&kind| self.is_kind(atom, kind)));
        if groups.len() == 1 {
            return Ok(None); // its only coefficient is the part itself
        }
        for (power, coefficient) in groups {
            let coefficient = self.node_of(&coefficient)?;
            let coefficient = self.graph.simplest(coefficient, depth - 1, search);
            let power = self.node_of(&Polynomial::term(power, Number::integer(1)))?;
            parts.push(self.product_of(&[power, coefficient])?);
        }
        let sum = self.sum_of(&parts);
        let flat = self.polynomial(sum, Opening::Sums)?;
        let sum = self.factored(&flat)?;
        let outside = self.node_of(&Polynomial::term(monomial, factor))?;
        self.product_of(&[outside, sum]).map(Some)
    }

    /// One simplified numerator over one denominator.
    fn as_fraction(&mut self, polynomial: &Polynomial, depth: usize, search: &mut Search) -> Option<Id> {
        let (numerator, denominator) = self.fraction(polynomial).ok()??;
        let numerator = self.graph.simplest(numerator, depth - 1, search);
        let denominator = self.graph.simplest(denominator, depth - 1, search);
        self.graph.product(&[(numerator, NumberId::ONE), (denominator, NumberId::MINUS_ONE)]).ok()
    }
}
