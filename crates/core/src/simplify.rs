//! The shortest of a fixed list of forms.
//!
//! Every candidate is a form that textbooks use: terms flattened or multiplied out, sines and cosines
//! brought to a few normal forms, common factors out, collected by accelerations, speeds, parameters or
//! angles. A candidate counts if its value is the same at the random point and it costs no more operations
//! than the input; of those the one that reads shortest is taken. The search never loops.

use crate::collect::grouped;
use crate::error::Error;
use crate::expand::Opening;
use crate::graph::Graph;
use crate::node::{Id, NumberId, View};
use crate::number::Number;
use crate::polynomial::{Budget, Polynomial};
use crate::ring::Ring;

/// Terms of a polynomial, and terms handled for one part of an expression.
const TERMS: usize = 2_000;
const WORK: usize = 400_000;
/// Terms handled and nodes visited for a whole expression.
const TOTAL_WORK: usize = 4_000_000;
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

/// The kinds of atoms that a sum is collected by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Acceleration,
    Speed,
    Parameter,
    Wave,
}

/// The orders in which a sum is collected; common factors come out of what is left.
const ARRANGEMENTS: [&[Kind]; 4] =
    [&[], &[Kind::Acceleration, Kind::Speed], &[Kind::Parameter], &[Kind::Wave]];

/// The parts whose coefficients are simplified on their own.
const COEFFICIENTS: [&[Kind]; 2] = [&[Kind::Acceleration, Kind::Speed], &[Kind::Parameter]];

/// How long a form reads: operations, an addition as three of them because it makes one more term; among
/// equals, fewer additions, functions and printed operations.
type Measure = (u64, u64, u64, u64);

impl Graph {
    /// The shortest of a fixed list of forms of an expression.
    ///
    /// # Errors
    /// When a part cannot be rebuilt.
    pub fn simplify(&mut self, id: Id) -> Result<Id, Error> {
        self.choose_form(|graph| {
            let mut work = Budget::new(usize::MAX, TOTAL_WORK);
            let mut best = id;
            for _ in 0..ROUNDS {
                let parts = |graph: &mut Self, part| Ok(graph.simplest(part, DEEPEST, &mut work));
                let next = graph.inside_out(best, Self::push_enclosed_or_factors, &mut { parts })?;
                if next == best || !graph.is_better(next, best) {
                    break;
                }
                best = next;
            }
            Ok(best)
        })
    }

    /// Whether a candidate reads better, costs no more operations and has the same value.
    fn is_better(&self, candidate: Id, known: Id) -> bool {
        self.value(candidate) == self.value(known)
            && self.measure(candidate) < self.measure(known)
            && self.cost(&[candidate]).total() <= self.cost(&[known]).total()
    }

    fn measure(&self, id: Id) -> Measure {
        let cost = self.cost(&[id]);
        let length = cost.total().saturating_add(cost.additions.saturating_mul(2));
        (length, cost.additions, cost.functions, self.tree_cost(&[id]).total())
    }

    /// The best candidate for a part, or the part itself.
    fn simplest(&mut self, part: Id, depth: usize, work: &mut Budget) -> Id {
        if self.children(part).is_empty() || self.is_large(part, work) {
            return part;
        }
        let allowed = self.cost(&[part]).total();
        let mut best = (self.measure(part), part);
        for candidate in self.candidates(part, depth, work) {
            if self.value(candidate) != self.value(part) || self.cost(&[candidate]).total() > allowed {
                continue;
            }
            let measure = self.measure(candidate);
            if measure < best.0 {
                best = (measure, candidate);
            }
        }
        best.1
    }

    /// Whether a part has more nodes than may be looked at.
    fn is_large(&self, part: Id, work: &mut Budget) -> bool {
        let limit = LARGEST_PART.min(work.left());
        let mut seen: rustc_hash::FxHashSet<Id> = rustc_hash::FxHashSet::default();
        let mut stack = vec![part];
        while let Some(id) = stack.pop() {
            if seen.insert(id) {
                self.push_children(id, &mut stack);
            }
            if seen.len() > limit {
                break;
            }
        }
        work.spend(seen.len()).is_err() || seen.len() > limit
    }

    fn candidates(&mut self, part: Id, depth: usize, work: &mut Budget) -> Vec<Id> {
        let allowed = WORK.min(work.left());
        let mut ring = Ring::new(self, Budget::new(TERMS, allowed));
        let mut known: Vec<Polynomial> = Vec::new();
        let mut candidates = Vec::new();
        for (opening, trigonometry) in POLYNOMIALS {
            // A form beyond the limits is no candidate.
            let Ok(polynomial) = ring.form(part, opening, trigonometry) else { continue };
            if known.contains(&polynomial) {
                continue;
            }
            candidates.extend(ring.to_node(&polynomial));
            for kinds in ARRANGEMENTS {
                candidates.extend(ring.arranged(&polynomial, kinds));
            }
            known.push(polynomial);
        }
        let _ = work.spend(allowed - ring.budget.left());
        if depth > 0 {
            for polynomial in known.iter().take(2) {
                for kinds in COEFFICIENTS {
                    candidates.extend(ring.by_coefficients(polynomial, kinds, depth, work));
                }
                candidates.extend(ring.as_fraction(polynomial, depth, work));
            }
        }
        candidates
    }
}

impl Ring<'_> {
    fn form(&mut self, part: Id, opening: Opening, trigonometry: Trigonometry) -> Result<Polynomial, Error> {
        let polynomial = self.polynomial(part, opening)?;
        match trigonometry {
            Trigonometry::Kept => Ok(polynomial),
            Trigonometry::Shortened => self.shortened(&polynomial),
            Trigonometry::Shortest => self.shortest_trig(&polynomial),
            Trigonometry::NoSines => self.eliminate_all(&polynomial, |(sin, cos)| (sin, cos)),
            Trigonometry::NoCosines => self.eliminate_all(&polynomial, |(sin, cos)| (cos, sin)),
            Trigonometry::Combined => self.combined(&polynomial),
        }
    }

    fn is_kind(&self, atom: u32, kind: Kind) -> bool {
        match kind {
            Kind::Wave => self.wave(atom).is_some(),
            Kind::Acceleration => {
                matches!(self.graph.view(self.node(atom)), View::TimeFunction(_, order) if order > 1)
            }
            Kind::Speed => matches!(self.graph.view(self.node(atom)), View::TimeFunction(_, 1)),
            Kind::Parameter => matches!(self.graph.view(self.node(atom)), View::Symbol(..)),
        }
    }

    fn arranged(&mut self, polynomial: &Polynomial, kinds: &[Kind]) -> Result<Id, Error> {
        if kinds.is_empty() {
            return self.factored(polynomial);
        }
        let (monomial, factor, rest) = crate::factor_terms::content(polynomial)?;
        let choices: Vec<Box<dyn Fn(&Self, u32) -> bool>> = kinds
            .iter()
            .map(|&kind| Box::new(move |ring: &Self, atom| ring.is_kind(atom, kind)) as Box<_>)
            .collect();
        let choices: Vec<&dyn Fn(&Self, u32) -> bool> = choices.iter().map(AsRef::as_ref).collect();
        let sum = self.collected(&rest, &choices)?;
        let content = self.to_node(&Polynomial::term(monomial, factor))?;
        self.product_of(&[content, sum])
    }

    /// The sum of products of these kinds times coefficients, each coefficient the simplest of its forms.
    fn by_coefficients(
        &mut self,
        polynomial: &Polynomial,
        kinds: &[Kind],
        depth: usize,
        work: &mut Budget,
    ) -> Result<Id, Error> {
        let (monomial, factor, rest) = crate::factor_terms::content(polynomial)?;
        let mut parts = Vec::new();
        for (power, coefficient) in grouped(&rest, |atom| kinds.iter().any(|&kind| self.is_kind(atom, kind)))
        {
            let coefficient = self.to_node(&coefficient)?;
            let coefficient = self.graph.simplest(coefficient, depth - 1, work);
            let power = self.to_node(&Polynomial::term(power, Number::integer(1)))?;
            parts.push(self.product_of(&[power, coefficient])?);
        }
        let sum = self.sum_of(&parts);
        let flat = self.polynomial(sum, Opening::Sums)?;
        let sum = self.factored(&flat)?;
        let content = self.to_node(&Polynomial::term(monomial, factor))?;
        self.product_of(&[content, sum])
    }

    /// One simplified numerator over one denominator.
    fn as_fraction(&mut self, polynomial: &Polynomial, depth: usize, work: &mut Budget) -> Option<Id> {
        let (numerator, denominator) = self.fraction(polynomial).ok()??;
        let numerator = self.graph.simplest(numerator, depth - 1, work);
        let denominator = self.graph.simplest(denominator, depth - 1, work);
        self.graph.product(&[(numerator, NumberId::ONE), (denominator, NumberId::MINUS_ONE)]).ok()
    }
}
