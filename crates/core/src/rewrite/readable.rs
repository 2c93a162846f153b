//! The form that a textbook prints: flat sums, with common factors outside a whole sum only.
//!
//! Polynomials of the expression with different treatments of sines and cosines are arranged in a few ways, and the one
//! whose text is shortest is the result. What a reader stumbles over counts as further characters: a factor that
//! occurs again inside the brackets it stands before (Horner's nesting), multiples of angles, fractions inside
//! brackets, differences of parameters. The form may cost more operations; it is for the page, never for code.

use rustc_hash::FxHashSet;
use std::collections::{BTreeMap, BTreeSet};

use crate::error::Error;
use crate::graph::{Function, Graph, Id, NumberId, View};
use crate::polynomial::{Budget, Monomial, Polynomial};
use crate::print::compare_names;
use crate::value::Number;

use super::expand::Opening;
use super::factor_terms::content;
use super::ring::Ring;

/// Parts with more nodes, and polynomials with more terms, stay as they are.
const LARGEST_PART: usize = 1_500;
const TERMS: usize = 200;
/// The most terms of a sum of products of waves.
const JOINED: usize = 8;
/// The most terms handled for one part.
const WORK: usize = 30_000;
/// The polynomials that are arranged: those with the shortest flat texts; and the same for long ones.
const ARRANGED: [usize; 2] = [4, 2];
/// The factors that are tried as the first one to be taken out; and the same for long polynomials.
const FIRST_FACTORS: [usize; 2] = [10, 3];
/// The terms of a long polynomial, and of one whose sines and cosines stay as they are.
const LONG: usize = 16;
const LONG_WAVES: usize = 24;
/// The most levels of brackets.
const DEEPEST: usize = 3;

/// Characters by which a form is longer to a reader than its text: for each factor that occurs again in its brackets,
/// each multiple of an angle, each fraction inside brackets, and each negative term of a sum in which a parameter stands alone.
const NESTED: usize = 14;
const MULTIPLE: usize = 16;
const FRACTION: usize = 8;
const DIFFERENCE: usize = 12;

/// What a form is to a reader: the length of its text with all that is awkward, its operations, its text.
type Reading = (usize, u64, String);

impl Graph {
    /// The form of an expression for the reader: of the forms that are tried, the one that reads shortest. Its text is
    /// never longer than the given one, nor is that of any part.
    ///
    /// # Errors
    /// If a part cannot be rebuilt.
    pub fn readable(&mut self, id: Id) -> Result<Id, Error> {
        let found = self.form_for_reader(id, true)?;
        Ok(if self.is_no_longer(found, id) { found } else { id })
    }

    /// The form of an expression on the page of a textbook: the text may be longer than the given one where that has
    /// what a reader stumbles over.
    ///
    /// # Errors
    /// If a part cannot be rebuilt.
    pub fn textbook_form(&mut self, id: Id) -> Result<Id, Error> {
        self.form_for_reader(id, false)
    }

    fn form_for_reader(&mut self, id: Id, is_bounded: bool) -> Result<Id, Error> {
        if self.is_larger(id, LARGEST_PART) {
            return Ok(id); // nobody reads it
        }
        self.choose_form(|graph| {
            let joined = graph.inside_out(id, Self::push_enclosed_or_factors, &mut |graph, part| {
                let joined = graph.joined_waves(part)?;
                let is_taken = !is_bounded || graph.is_no_longer(joined, part);
                Ok(if is_taken { joined } else { part })
            })?;
            graph.inside_out(joined, Self::push_enclosed, &mut |graph, part| {
                Ok(graph.most_readable(part, is_bounded))
            })
        })
    }

    fn is_no_longer(&self, form: Id, given: Id) -> bool {
        let length = |id| self.to_text(id).chars().count();
        form == given || length(form) <= length(given)
    }

    /// A sum of products of two waves as one of waves of sums, if that has no more terms: a chain of rotations about one
    /// axis, from the innermost outwards, takes the sum of its angles, with little work.
    fn joined_waves(&mut self, part: Id) -> Result<Id, Error> {
        if !matches!(self.view(part), View::Sum(_)) {
            return Ok(part);
        }
        let mut ring = Ring::for_reader(self, Budget::new(JOINED, WORK), part);
        let Ok(sum) = ring.polynomial(part, Opening::Sums) else { return Ok(part) };
        if sum.len() > JOINED || !ring.is_of_pairs(&sum) {
            return Ok(part);
        }
        match ring.combined(&sum) {
            Ok(combined) if combined.len() < sum.len() && ring.is_linear_in_waves(&combined) => {
                ring.node_of(&combined)
            }
            _ => Ok(part),
        }
    }

    fn most_readable(&mut self, part: Id, is_bounded: bool) -> Id {
        if self.is_larger(part, LARGEST_PART) {
            return part;
        }
        // A sum that is kept closed takes the place of what equals it, so that each opening has a ring of its own.
        let budget = Budget::new(TERMS, WORK);
        let mut candidates = Ring::for_reader(self, budget, part).closed_forms(part);
        let mut ring = Ring::for_reader(self, budget, part);
        for polynomial in ring.flat_forms(part) {
            candidates.extend(ring.arrangements(&polynomial));
            candidates.extend(ring.over_common_denominator(&polynomial));
            if let Ok(Some(tangents)) = ring.in_tangents(&polynomial) {
                candidates.extend(ring.arrangements(&tangents));
            }
        }
        let mut best = (self.reading(part), part);
        let longest = if is_bounded { best.0.2.chars().count() } else { usize::MAX };
        let mut seen: FxHashSet<Id> = FxHashSet::default();
        for candidate in candidates {
            if seen.insert(candidate) && self.same(candidate, part) {
                let reading = self.reading(candidate);
                if reading < best.0 && reading.2.chars().count() <= longest {
                    best = (reading, candidate);
                }
            }
        }
        best.1
    }

    fn is_larger(&self, part: Id, limit: usize) -> bool {
        let mut seen: FxHashSet<Id> = FxHashSet::default();
        let mut stack = vec![part];
        while let Some(id) = stack.pop() {
            if seen.insert(id) {
                self.push_children(id, &mut stack);
            }
            if seen.len() > limit {
                return true;
            }
        }
        false
    }

    fn reading(&self, id: Id) -> Reading {
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
                    total += NESTED * self.repeated_factors(id);
                    stack.extend(factors.iter().map(|(base, _)| (base, true)));
                }
                View::Function(Function::Sin | Function::Cos, args) => {
                    total += MULTIPLE * usize::from(self.is_multiple(args.get(0)));
                }
                View::Scale(_, child) => stack.push((child, is_inner)),
                _ => {}
            }
        }
        total
    }

    /// The factors of a product that occur again inside the sums among its factors.
    fn repeated_factors(&self, product: Id) -> usize {
        let factors = self.flat_factors(product);
        let is_sum = |id: Id| matches!(self.view(id), View::Sum(_));
        let mut inner: FxHashSet<Id> = FxHashSet::default();
        for &(base, is_plain) in factors.iter().filter(|&&(base, _)| is_sum(base)) {
            if is_plain {
                let mut stack = vec![base];
                while let Some(id) = stack.pop() {
                    match self.view(id) {
                        View::Sum(terms) => stack.extend(terms.iter().map(|(_, term)| term)),
                        View::Product(factors) => stack.extend(factors.iter().map(|(base, _)| base)),
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
        let counts = |base: Id| !is_sum(base) && inner.contains(&base) && (is_motion(base) || !has_motion);
        factors.iter().filter(|&&(base, _)| counts(base)).count()
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
        let negatives = terms.iter().filter(|(factor, _)| factor.is_negative()).count();
        NESTED * usize::from(shared && terms.len() > 1) + DIFFERENCE * negatives * usize::from(has_parameter)
    }

    /// Whether an angle has a term with a whole number other than one before it.
    fn is_multiple(&self, angle: Id) -> bool {
        let is_whole = |factor: &Number| factor.is_integer() && !factor.abs().is_one();
        let is_symbolic = |id: Id| !matches!(self.view(id), View::Pi | View::Number(_));
        match self.view(angle) {
            View::Scale(factor, child) => is_whole(self.get_number(factor)) && is_symbolic(child),
            View::Sum(terms) => {
                terms.iter().any(|(factor, term)| is_whole(self.get_number(factor)) && is_symbolic(term))
            }
            _ => false,
        }
    }
}

impl<'g> Ring<'g> {
    /// A ring in which the atoms of a part are numbered by kind and name, so that among equal arrangements names decide
    /// and not the order in which the part was put together.
    fn for_reader(graph: &'g mut Graph, budget: Budget, part: Id) -> Self {
        let mut named: Vec<(u8, String, Id)> = Vec::new();
        for id in graph.post_order(&[part]) {
            let kind = match graph.view(id) {
                View::Symbol(..) => 0,
                View::TimeFunction(..) => 1,
                View::Application { .. } => 2,
                View::Function(..) => 3,
                _ => continue,
            };
            named.push((kind, graph.to_text(id), id));
        }
        named.sort_by(|(a, x, _), (b, y, _)| {
            a.cmp(b).then_with(|| compare_names(x, y)).then_with(|| x.cmp(y))
        });
        let mut ring = Self::new(graph, budget);
        for (_, _, id) in named {
            ring.atom(id);
        }
        ring
    }
}

impl Ring<'_> {
    /// Forms in which the sums among the factors of products stay closed, such as `R - r`.
    fn closed_forms(&mut self, part: Id) -> Vec<Id> {
        match self.polynomial(part, Opening::Sums) {
            Ok(polynomial) => self.arrangements(&polynomial),
            Err(_) => Vec::new(),
        }
    }

    /// The polynomials of a part whose flat texts read shortest.
    fn flat_forms(&mut self, part: Id) -> Vec<Polynomial> {
        let Ok(flat) = self.polynomial(part, Opening::Products) else { return Vec::new() }; // beyond the limits
        if self.is_linear_in_waves(&flat) {
            return vec![flat];
        }
        let combined = if flat.len() <= 2 * LONG_WAVES { self.combined(&flat).ok() } else { None };
        // Of a planar mechanism, this is what the books print.
        if let Some(combined) = &combined
            && combined.len() <= flat.len()
            && self.is_linear_in_waves(combined)
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
        let mut read: Vec<(Reading, Polynomial)> = Vec::new();
        for polynomial in forms {
            if let Ok(node) = self.node_of(&polynomial) {
                read.push((self.graph.reading(node), polynomial));
            }
        }
        read.sort_by(|(a, _), (b, _)| a.cmp(b));
        let is_long = read.first().is_some_and(|(_, shortest)| shortest.len() >= LONG);
        read.truncate(ARRANGED[usize::from(is_long)]);
        read.into_iter().map(|(_, polynomial)| polynomial).collect()
    }

    /// Whether each term has two sines or cosines.
    fn is_of_pairs(&self, polynomial: &Polynomial) -> bool {
        polynomial.iter().all(|(monomial, _)| self.waves_of(monomial) == 2)
    }

    /// The number of sines and cosines in a product.
    fn waves_of(&self, monomial: &Monomial) -> u64 {
        let waves = monomial.factors().iter().filter(|&&(atom, _)| self.wave(atom).is_some());
        waves.map(|&(_, exponent)| exponent.unsigned_abs()).sum()
    }

    /// Whether each term has one sine or cosine at most, and none of a multiple of an angle.
    fn is_linear_in_waves(&self, polynomial: &Polynomial) -> bool {
        let is_plain = |atom: u32| self.wave(atom).is_none_or(|(_, angle)| !self.graph.is_multiple(angle));
        polynomial.atoms().into_iter().all(is_plain)
            && polynomial.iter().all(|(monomial, _)| self.waves_of(monomial) <= 1)
    }

    /// The arrangements of a polynomial, with its content outside.
    fn arrangements(&mut self, polynomial: &Polynomial) -> Vec<Id> {
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
        if let Ok(id) = self.grouped_sum(polynomial, None, DEEPEST) {
            made.push(id);
        }
        made
    }

    /// The polynomial with tangents for quotients of sines and cosines, if there are any.
    fn in_tangents(&mut self, polynomial: &Polynomial) -> Result<Option<Polynomial>, Error> {
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

    /// The square of a sum, if the polynomial is one.
    fn squared(&mut self, polynomial: &Polynomial) -> Result<Id, Error> {
        let root = polynomial.square_root(&mut self.budget).filter(|root| root.len() > 1);
        let Some(root) = root else { return self.node_of(polynomial) };
        let root = self.grouped_sum(&root, None, DEEPEST)?;
        self.graph.pow_number(root, &Number::integer(2))
    }

    /// Numerator over denominator, both in their most readable forms.
    fn over_common_denominator(&mut self, polynomial: &Polynomial) -> Option<Id> {
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
            let columns = match self.whole_square(&columns, depth)? {
                Some(square) => square,
                None => self.grouped_sum(&columns, None, depth - 1)?,
            };
            parts.push(self.product_of(&[outside, columns])?);
        }
        parts.push(self.node_of(&rest)?);
        Ok(self.sum_of(&parts))
    }

    fn whole_square(&mut self, polynomial: &Polynomial, depth: usize) -> Result<Option<Id>, Error> {
        if polynomial.len() < 3 {
            return Ok(None);
        }
        let Some(root) = polynomial.square_root(&mut self.budget) else { return Ok(None) };
        let root = self.grouped_sum(&root, None, depth - 1)?;
        self.graph.pow_number(root, &Number::integer(2)).map(Some)
    }

    /// The group that saves most factors; among equal ones, that of the smallest atom.
    fn best_group(&mut self, polynomial: &Polynomial) -> Result<Option<(Monomial, Polynomial)>, Error> {
        let mut best: Option<(u64, (Monomial, Polynomial))> = None;
        for factor in factors_of(polynomial) {
            if let Some((outside, columns)) = self.group_of(polynomial, factor)? {
                let saving = self.width(&outside) * (columns.len() as u64 - 1);
                if best.as_ref().is_none_or(|(most, _)| saving > *most) {
                    best = Some((saving, (outside, columns)));
                }
            }
        }
        Ok(best.map(|(_, group)| group))
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
        (atom, exponent): (u32, i64),
    ) -> Result<Option<(Monomial, Polynomial)>, Error> {
        self.budget.spend(polynomial.len())?;
        let mut holders = Polynomial::default();
        for (monomial, coefficient) in polynomial.iter() {
            match monomial.exponent(atom) {
                0 => {}
                found if found == exponent => holders.add_term(monomial.clone(), coefficient),
                _ => return Ok(None), // a quadratic form stays flat
            }
        }
        if holders.len() < 2 {
            return Ok(None);
        }
        let (monomial, _, columns) = content(&holders)?;
        let inner: BTreeSet<u32> = columns.atoms().into_iter().collect();
        let (outside, _) = monomial.split(|atom| !inner.contains(&atom));
        let columns = holders.shifted(&outside.pow(-1), &Number::integer(1));
        Ok(Some((outside, columns)))
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
    let (monomial, _, _) = content(polynomial)?;
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
