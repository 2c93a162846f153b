//! What a form is to a reader: the length of its text, and what a reader stumbles over.

use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::{BTreeMap, BTreeSet};

use crate::graph::{Function, Graph, Id, NumberId, View};
use crate::value::Number;

/// Characters by which a form is longer to a reader than its text: for each factor that occurs again in its brackets,
/// each multiple of an angle, each fraction inside brackets, and each negative term of a sum in which a parameter stands alone.
const NESTED: usize = 14;
const MULTIPLE: usize = 16;
const FRACTION: usize = 8;
const DIFFERENCE: usize = 12;

/// The characters of a sign with its spaces, of a pair of brackets, of a power.
const SIGN: usize = 3;
const BRACKETS: usize = 2;
const POWER: usize = 3;

/// What a form is to a reader: the length of its text with all that is awkward, its operations, its text.
pub(super) type Reading = (usize, u64, String);

/// Where a sum stands. A factor is printed with either sign, since the product takes the other one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Context {
    Whole,
    Opposite,
    Factor,
}

/// The sign of a term in print.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sign {
    Plus,
    Minus,
    Either,
}

impl Context {
    const fn opposite(self) -> Self {
        match self {
            Self::Whole => Self::Opposite,
            Self::Opposite => Self::Whole,
            Self::Factor => Self::Factor,
        }
    }
}

impl Graph {
    pub(super) fn reading(&self, id: Id) -> Reading {
        let text = self.to_text(id);
        (text.chars().count() + self.awkwardness(id), self.tree_cost(&[id]).total(), text)
    }

    /// The characters that the text of a form has at least: its names, signs and brackets without numbers. `known` holds
    /// those of other nodes.
    pub(super) fn least_length(&self, root: Id, known: &mut FxHashMap<Id, usize>) -> usize {
        for id in self.post_order_where(&[root], |id| !known.contains_key(&id)) {
            let length = match self.view(id) {
                View::Number(_) => 0,
                View::Symbol(name, _) | View::TimeFunction(name, ..) => name.chars().count(),
                View::Scale(_, child) => known[&child],
                View::Sum(terms) => {
                    let inner: usize = terms.iter().map(|(_, term)| known[&term]).sum();
                    inner + SIGN * terms.iter().count().saturating_sub(1)
                }
                View::Product(factors) => {
                    let of_factor = |(base, exponent)| {
                        let is_power = self.get_number(exponent).to_i64().is_some_and(|e| e.abs() > 1);
                        let brackets = if self.is_sum(base) { BRACKETS } else { 0 };
                        known[&base] + brackets + if is_power { POWER } else { 0 }
                    };
                    let inner: usize = factors.iter().map(of_factor).sum();
                    inner + factors.iter().count().saturating_sub(1)
                }
                View::Function(..) => {
                    BRACKETS + self.children(id).iter().map(|child| known[child]).sum::<usize>()
                }
                _ => self.children(id).iter().map(|child| known[child]).sum(),
            };
            known.insert(id, length);
        }
        known[&root]
    }

    /// Whether a sum is a factor of a product.
    pub(super) fn has_closed_sums(&self, part: Id) -> bool {
        self.post_order(&[part]).into_iter().any(|id| match self.view(id) {
            View::Product(factors) => factors.iter().any(|(base, _)| self.is_sum(base)),
            _ => false,
        })
    }

    /// The characters that count in addition to those of the text.
    pub(super) fn awkwardness(&self, root: Id) -> usize {
        let mut total = 0;
        let whole = self.without_number(root);
        let mut stack = vec![(root, Context::Whole)];
        while let Some((id, context)) = stack.pop() {
            match self.view(id) {
                View::Sum(_) => {
                    let terms = self.flat_terms(id);
                    total += self.awkwardness_of_sum(&terms, context);
                    for (factor, term) in terms {
                        let is_fraction = !factor.is_integer() && !factor.is_decimal();
                        total += FRACTION * usize::from(context == Context::Factor && is_fraction);
                        total += FRACTION * self.cancelled_terms(&factor, term);
                        stack.push((term, context));
                    }
                }
                View::Product(factors) => {
                    total += NESTED * self.repeated_factors(id, id == whole);
                    stack.extend(factors.iter().map(|(base, _)| (base, Context::Factor)));
                }
                View::Function(Function::Sin | Function::Cos, args) => {
                    total += MULTIPLE * usize::from(self.is_multiple(args.get(0)));
                }
                View::Scale(NumberId::MINUS_ONE, child) if context != Context::Factor => {
                    stack.push((child, context.opposite()));
                }
                View::Scale(factor, child) => {
                    total += FRACTION * self.cancelled_terms(self.get_number(factor), child);
                    stack.push((child, context));
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

    pub(super) fn is_sum(&self, id: Id) -> bool {
        matches!(self.view(id), View::Sum(_))
    }

    pub(super) fn without_number(&self, mut id: Id) -> Id {
        while let View::Scale(_, child) = self.view(id) {
            id = child;
        }
        id
    }

    /// The number of factors of a product that occur again inside the sums among its factors; a sum counts twice. Before
    /// a whole sum, sines and cosines don't count, nor do parameters if the sum is a place and no moment of inertia:
    /// `l*m*cos(q)*(R + l*sin(q))` and `m*R*(R - r)`, but `m*(c**2 + c*l)`.
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
        let is_wave = |id: Id| matches!(self.view(id), View::Function(..));
        let is_place = is_whole
            && factors.iter().any(|&(base, is_plain)| is_wave(base) || is_plain && self.has_negative(base));
        let is_parameter = |id: Id| matches!(self.view(id), View::Symbol(..));
        let is_outside = |id: Id| is_whole && is_wave(id) || is_place && is_parameter(id);
        let counts =
            |base: Id| inner.contains(&base) && !is_outside(base) && (is_motion(base) || !has_motion);
        let weight = |base: Id| 1 + usize::from(self.is_sum(base));
        factors.iter().filter(|&&(base, _)| counts(base)).map(|&(base, _)| weight(base)).sum()
    }

    /// Whether a sum has a negative term.
    fn has_negative(&self, sum: Id) -> bool {
        self.is_sum(sum) && self.flat_terms(sum).iter().any(|(factor, _)| factor.is_negative())
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
    /// difference, and `l2**2 - l1**2` is nothing in a mechanism; `R - l*cos(q)` is a place, `a*m1 - b*m2` a moment.
    fn awkwardness_of_negative(&self, term: Id) -> usize {
        match self.view(term) {
            View::Product(factors) => {
                let is_odd = |(base, exponent)| {
                    matches!(self.view(base), View::Function(..)) && !self.get_number(exponent).is_even()
                };
                let flat = self.flat_factors(term);
                let has_sum = flat.iter().any(|&(base, _)| self.is_sum(base));
                let is_symbol =
                    |&(base, is_plain): &(Id, bool)| is_plain && matches!(self.view(base), View::Symbol(..));
                let is_moment = flat.len() > 1 && flat.iter().all(is_symbol);
                if !has_sum && factors.iter().any(is_odd) || is_moment { 0 } else { DIFFERENCE }
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

    /// Characters for each factor that all terms of a sum have, and for each negative term of a sum in which a parameter
    /// stands by itself, but for such factors: `l2**2 - l1**2`, `l1*m1*cos(q) - l2*m2*cos(q)`.
    fn awkwardness_of_sum(&self, terms: &[(Number, Id)], context: Context) -> usize {
        let is_motion =
            |&(base, _): &(Id, bool)| !matches!(self.view(base), View::Symbol(..) | View::Number(_));
        let bases_of = |term| self.flat_factors(term).into_iter().filter(is_motion).map(|(base, _)| base);
        let motions: Vec<BTreeSet<Id>> = terms.iter().map(|&(_, term)| bases_of(term).collect()).collect();
        let is_shared = |base: &Id| motions.iter().all(|others| others.contains(base));
        let is_function = |base: &Id| matches!(self.view(*base), View::Function(..));
        let shared = motions
            .first()
            .map_or(0, |bases| bases.iter().filter(|&base| is_function(base) && is_shared(base)).count());
        let has_parameter = motions.iter().any(|bases| bases.iter().all(is_shared));
        let signs: Vec<Sign> = terms.iter().map(|(factor, term)| self.printed_sign(factor, *term)).collect();
        // A coordinate has a zero of its own: `x - a` is a place.
        let is_place = terms.iter().any(|&(_, term)| matches!(self.view(term), View::TimeFunction(..)));
        let is_name = |term| matches!(self.view(term), View::TimeFunction(..) | View::Symbol(..));
        let difference = |sign: Sign| -> usize {
            let signed =
                terms.iter().zip(&signs).filter(|&(_, &known)| known == sign).map(|(each, _)| each.1);
            let awkward = signed.filter(|&term| !(is_place && is_name(term)));
            awkward.map(|term| self.awkwardness_of_negative(term)).sum()
        };
        let difference = match context {
            Context::Whole => difference(Sign::Minus),
            Context::Opposite => difference(Sign::Plus),
            Context::Factor => difference(Sign::Minus).min(difference(Sign::Plus)),
        };
        let is_difference = signs.iter().any(|&sign| sign != signs[0]);
        let shared = shared + usize::from(is_difference && self.have_common_parameter(terms));
        NESTED * shared * usize::from(terms.len() > 1) + difference * usize::from(has_parameter)
    }

    /// The sign with which a term is printed: a sum among its factors is written with the fewer minus signs, and takes
    /// the sign of the term if it has as many of both.
    fn printed_sign(&self, factor: &Number, term: Id) -> Sign {
        let mut is_negative = factor.is_negative();
        let mut is_even = false;
        for (sum, is_plain) in self.flat_factors(term) {
            if !is_plain || !self.is_sum(sum) {
                continue;
            }
            let terms = self.flat_terms(sum);
            let negatives = 2 * terms.iter().filter(|(factor, _)| factor.is_negative()).count();
            is_negative ^= negatives > terms.len();
            is_even |= negatives == terms.len();
        }
        match (is_negative, is_even) {
            (_, true) => Sign::Either,
            (true, false) => Sign::Minus,
            (false, false) => Sign::Plus,
        }
    }

    /// Whether the terms are products of parameters and coordinates that share one: `R**2 - R*r`, which is `R*(R - r)`.
    fn have_common_parameter(&self, terms: &[(Number, Id)]) -> bool {
        let is_symbol = |base: Id| matches!(self.view(base), View::Symbol(..) | View::TimeFunction(..));
        let bases_of =
            |term| self.flat_factors(term).into_iter().map(|(base, _)| base).collect::<BTreeSet<Id>>();
        let all: Vec<BTreeSet<Id>> = terms.iter().map(|&(_, term)| bases_of(term)).collect();
        let has_divisor = |id: Id| match self.view(id) {
            View::Product(factors) => factors.iter().any(|(_, e)| self.get_number(e).is_negative()),
            _ => false,
        };
        all.iter().flatten().all(|&base| is_symbol(base))
            && !terms.iter().any(|&(_, term)| has_divisor(term))
            && all
                .first()
                .is_some_and(|first| first.iter().any(|b| all.iter().all(|other| other.contains(b))))
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
