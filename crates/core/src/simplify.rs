//! The shortest of a fixed list of forms.
//!
//! Every candidate is a form that textbooks use: terms flattened or multiplied out, sines and cosines
//! brought to a few normal forms, common factors out, collected by accelerations, speeds, parameters or
//! angles. A candidate counts if its value is the same at the random point and it costs no more operations
//! than the input; of those the one that reads shortest is taken. The search never loops.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::collect::{Kind, grouped};
use crate::cost::Cost;
use crate::error::Error;
use crate::expand::Opening;
use crate::factor_terms::content;
use crate::graph::Graph;
use crate::node::{Id, NumberId, View};
use crate::number::Number;
use crate::polynomial::{Budget, Polynomial};
use crate::ring::Ring;

/// Terms of a polynomial, and terms handled for one part of an expression.
const TERMS: usize = 2_000;
const WORK: usize = 400_000;
/// Terms handled and nodes visited for a whole expression.
const TOTAL_WORK: usize = 2_000_000;
const LEAST_WORK: usize = 100_000;
const WORK_PER_NODE: usize = 5_000;
/// Parts with more nodes are left as they are.
const LARGEST_PART: usize = 4_000;
/// Coefficients within coefficients that are simplified on their own.
const DEEPEST: usize = 2;
/// Repetitions while the result gets cheaper.
const ROUNDS: usize = 3;

/// What is done to sines and cosines.
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

/// How long a form reads: operations, an addition as three of them because it makes one more term; among
/// equals, fewer additions, then fewer functions. (Then the smaller tree, then fewer terms outside brackets.)
fn length(cost: Cost) -> (u64, u64, u64) {
    (cost.total().saturating_add(cost.additions.saturating_mul(2)), cost.additions, cost.functions)
}

/// The state of one simplification.
struct Search {
    work: Budget,
    /// The results so far, by part and by the levels of coefficients that were open to it.
    known: FxHashMap<(Id, usize), Id>,
}

impl Graph {
    /// The shortest of a fixed list of forms of an expression.
    ///
    /// # Errors
    /// When a part cannot be rebuilt.
    pub fn simplify(&mut self, id: Id) -> Result<Id, Error> {
        self.choose_form(|graph| {
            let work = Budget::new(usize::MAX, graph.total_work(id));
            let mut search = Search { work, known: FxHashMap::default() };
            let mut best = id;
            for _ in 0..ROUNDS {
                let parts = |graph: &mut Self, part| Ok(graph.simplest(part, DEEPEST, &mut search));
                let next = graph.inside_out(best, Self::push_enclosed_or_factors, &mut { parts })?;
                let next = graph.shortest(best, &[next]);
                if next == best {
                    break;
                }
                best = next;
            }
            Ok(best)
        })
    }

    /// The candidate that reads shortest, of those with the value of `part` that cost no more than it.
    fn shortest(&self, part: Id, candidates: &[Id]) -> Id {
        let tree = |id: Id| (self.tree_cost(&[id]).total(), self.outer_terms(id));
        let bound = self.cost(&[part]);
        let mut best = (length(bound), part);
        for &candidate in candidates {
            let cost = self.cost(&[candidate]);
            if self.value(candidate) != self.value(part) || cost.total() > bound.total() {
                continue;
            }
            let order = length(cost).cmp(&best.0);
            if order.then_with(|| tree(candidate).cmp(&tree(best.1))).is_lt() {
                best = (length(cost), candidate);
            }
        }
        best.1
    }

    /// What a simplification may spend: in proportion to the size of what is simplified.
    fn total_work(&self, id: Id) -> usize {
        TOTAL_WORK.min(LEAST_WORK + WORK_PER_NODE * self.bounded_size(id, TOTAL_WORK / WORK_PER_NODE))
    }

    /// The terms that a reader meets first, before any bracket is opened.
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
        if let Some(&known) = search.known.get(&(part, depth)) {
            return known;
        }
        let mut best = part;
        let size = self.bounded_size(part, LARGEST_PART.min(search.work.left()));
        let affordable = search.work.spend(size).is_ok() && size <= LARGEST_PART;
        if affordable && size > 1 {
            let candidates = self.candidates(part, depth, search);
            let _ = search.work.spend(size * candidates.len());
            best = self.shortest(part, &candidates);
        }
        search.known.insert((part, depth), best);
        best
    }

    /// The number of nodes of a part; of more than `limit` the count stops.
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
        let polynomials = ring.polynomials(part);
        let mut candidates = Vec::new();
        for polynomial in &polynomials {
            // A form beyond the limits is no candidate.
            candidates.extend(ring.node_of(polynomial));
            for kinds in ARRANGEMENTS {
                candidates.extend(ring.arranged(polynomial, kinds));
            }
        }
        // Beyond the limit nothing is left to spend, which the next part sees.
        let _ = search.work.spend(allowed - ring.budget.left());
        if depth > 0 {
            for polynomial in polynomials.iter().take(2) {
                for kinds in COEFFICIENTS {
                    candidates.extend(ring.by_coefficients(polynomial, kinds, depth, search));
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
    fn polynomials(&mut self, part: Id) -> Vec<Polynomial> {
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
    ) -> Result<Id, Error> {
        let (monomial, factor, rest) = content(polynomial)?;
        let mut parts = Vec::new();
        for (power, coefficient) in grouped(&rest, |atom| kinds.iter().any(|&kind| self.is_kind(atom, kind)))
        {
            let coefficient = self.node_of(&coefficient)?;
            let coefficient = self.graph.simplest(coefficient, depth - 1, search);
            let power = self.node_of(&Polynomial::term(power, Number::integer(1)))?;
            parts.push(self.product_of(&[power, coefficient])?);
        }
        let sum = self.sum_of(&parts);
        let flat = self.polynomial(sum, Opening::Sums)?;
        let sum = self.factored(&flat)?;
        let outside = self.node_of(&Polynomial::term(monomial, factor))?;
        self.product_of(&[outside, sum])
    }

    /// One simplified numerator over one denominator.
    fn as_fraction(&mut self, polynomial: &Polynomial, depth: usize, search: &mut Search) -> Option<Id> {
        let (numerator, denominator) = self.fraction(polynomial).ok()??;
        let numerator = self.graph.simplest(numerator, depth - 1, search);
        let denominator = self.graph.simplest(denominator, depth - 1, search);
        self.graph.product(&[(numerator, NumberId::ONE), (denominator, NumberId::MINUS_ONE)]).ok()
    }
}
