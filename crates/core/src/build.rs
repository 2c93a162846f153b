//! The canonical constructors: the only door into the graph for sums, products and multiples.
//!
//! A shared sum inside a sum stays a child (that sharing keeps recursive kinematics linear); like terms
//! merge one level deep, by value. A sum has its first term positive; the sign moves into a `Scale`.

use crate::error::Error;
use crate::field::{Element, Key};
use crate::function::Function;
use crate::graph::{Graph, LONGEST};
use crate::node::{Assumption, Flags, Id, Kind, NumberId, View};
use crate::number::Number;

/// Terms or factors up to this count are searched for cancellations with those of child sums.
const CANCELLATION_SEARCH: usize = 48;

type Term = (NumberId, Id);
type Factor = (Id, NumberId);

impl Graph {
    /// Enter a new row: values known to be plain numbers or known to the derivation give the known node.
    pub(crate) fn finish(&mut self, kind: Kind, flags: Flags, words: &[u32], value: Element) -> Id {
        if value.is_zero() {
            return Id::ZERO;
        }
        let (unsigned, negated) = value.unsigned();
        if let Some(&number) = self.plain_values.get(&unsigned) {
            let number = if negated { self.negated(number) } else { number };
            return self.number_node(number);
        }
        // Outside of derivations, and for constants, any simple number is recognised.
        if (self.classes.is_none() || flags.has(Flags::CONSTANT))
            && let Some(number) = value.to_simple_rational()
        {
            return self.number(&number);
        }
        if let Some(known) = self.known_value(value) {
            return known;
        }
        let id = self.intern(kind, flags, words, value);
        self.remember(id);
        id
    }

    /// A numeric multiple of a node.
    pub fn scale(&mut self, factor: NumberId, id: Id) -> Id {
        if factor == NumberId::ONE {
            return id;
        }
        if self.get_number(factor).is_zero() || id == Id::ZERO {
            return Id::ZERO;
        }
        match self.view(id) {
            View::Number(number) => {
                let product = self.get_number(factor).mul(self.get_number(number));
                self.number(&product)
            }
            View::Scale(inner, child) => {
                let product = self.get_number(factor).mul(self.get_number(inner));
                let product = self.number_id(&product);
                self.scale(product, child)
            }
            _ => {
                if self.get_number(factor).is_minus_one() {
                    return self.opposite(id);
                }
                let value = self.number_value(factor).mul(self.value(id));
                self.finish(Kind::Scale, self.flags(id), &[factor.0, id.0], value)
            }
        }
    }

    /// The opposite of a node, as a row of its own whatever the classes hold: they know values up to sign.
    pub(crate) fn opposite(&mut self, id: Id) -> Id {
        let (factor, child) = self.split_multiple(NumberId::MINUS_ONE, id);
        if child == Id::ONE {
            return self.number_node(factor);
        }
        if factor == NumberId::ONE {
            return child;
        }
        let (flags, value) = (self.flags(id), self.value(id).neg());
        self.intern(Kind::Scale, flags, &[factor.0, child.0], value)
    }

    /// The opposite of a node.
    pub fn neg(&mut self, id: Id) -> Id {
        let id = self.adopt(id);
        self.scale(NumberId::MINUS_ONE, id)
    }

    /// a + b.
    pub fn add(&mut self, a: Id, b: Id) -> Id {
        self.sum(&[(NumberId::ONE, a), (NumberId::ONE, b)])
    }

    /// a - b.
    pub fn sub(&mut self, a: Id, b: Id) -> Id {
        self.sum(&[(NumberId::ONE, a), (NumberId::MINUS_ONE, b)])
    }

    /// The sum of numeric multiples of nodes.
    pub fn sum(&mut self, terms: &[Term]) -> Id {
        let terms: Vec<Term> = terms.iter().map(|&(c, id)| (c, self.adopt(id))).collect();
        let value = self.terms_value(&terms);
        let plain = terms.iter().all(|&(_, id)| self.as_number(id).is_some());
        if value.is_zero() && !plain {
            return Id::ZERO;
        }
        if let Some(known) = self.known_value(value).filter(|_| !plain) {
            return known;
        }
        let terms = self.merge_terms(terms);
        let terms = self.cancel_terms(terms);
        let terms = if self.classes.is_some() { self.factor_fresh_products(terms) } else { terms };
        self.sum_of_merged(terms, value)
    }

    fn terms_value(&self, terms: &[Term]) -> Element {
        terms.iter().fold(Element::ZERO, |sum, &(c, id)| sum.add(self.number_value(c).mul(self.value(id))))
    }

    fn sum_of_merged(&mut self, mut terms: Vec<Term>, value: Element) -> Id {
        if let [] = terms[..] {
            return Id::ZERO;
        }
        if let [(c, id)] = terms[..] {
            return self.scale(c, id);
        }
        while terms.len() * 2 > LONGEST {
            let rest = terms.split_off(terms.len() - LONGEST / 4);
            let rest_value = self.terms_value(&rest);
            terms.push((NumberId::ONE, self.sum_of_merged(rest, rest_value)));
        }
        let negative = self.get_number(terms[0].0).is_negative();
        if negative {
            for term in &mut terms {
                term.0 = self.negated(term.0);
            }
        }
        let flags = self.joined_flags(terms.iter().map(|&(_, id)| id));
        let words: Vec<u32> = terms.iter().flat_map(|&(c, id)| [c.0, id.0]).collect();
        let value = if negative { value.neg() } else { value };
        let id = self.finish(Kind::Sum, flags, &words, value);
        self.mark_used(terms.iter().map(|&(_, id)| id));
        if negative { self.scale(NumberId::MINUS_ONE, id) } else { id }
    }

    fn joined_flags(&self, ids: impl Iterator<Item = Id>) -> Flags {
        ids.map(|id| self.flags(id)).reduce(Flags::join).unwrap_or_default()
    }

    fn negated(&mut self, number: NumberId) -> NumberId {
        let opposite = self.get_number(number).neg();
        self.number_id(&opposite)
    }

    /// Bring terms to the form (coefficient, node that is no multiple), ordered by value, equal ones merged.
    pub(crate) fn merge_terms(&mut self, terms: Vec<Term>) -> Vec<Term> {
        let mut keyed: Vec<(Element, Term)> = Vec::with_capacity(terms.len());
        for (factor, id) in terms {
            let (coefficient, node) = self.split_multiple(factor, id);
            let (key, opposite) = self.value(node).unsigned();
            keyed.push((key, (coefficient, node)));
            debug_assert!(!opposite || key != self.value(node));
        }
        keyed.sort_by_key(|&(key, (_, node))| (node != Id::ONE, key));
        let mut merged: Vec<(Element, Term)> = Vec::with_capacity(keyed.len());
        for (key, (coefficient, node)) in keyed {
            match merged.last_mut() {
                Some((last_key, (last, kept))) if *last_key == key => {
                    let same = self.values_equal(*kept, node);
                    let addend = self.get_number(coefficient);
                    let addend = if same { addend.clone() } else { addend.neg() };
                    let total = self.get_number(*last).add(&addend);
                    *last = self.number_id(&total);
                }
                _ => merged.push((key, (coefficient, node))),
            }
        }
        merged.into_iter().map(|(_, term)| term).filter(|&(c, _)| !self.get_number(c).is_zero()).collect()
    }

    fn values_equal(&self, a: Id, b: Id) -> bool {
        self.value(a) == self.value(b)
    }

    /// factor * id as a multiple of a node that is itself none; numbers are multiples of the node 1.
    pub(crate) fn split_multiple(&mut self, factor: NumberId, id: Id) -> Term {
        let (inner, node) = match self.view(id) {
            View::Number(number) => (number, Id::ONE),
            View::Scale(inner, child) => (inner, child),
            _ => return (factor, id),
        };
        let product = self.get_number(factor).mul(self.get_number(inner));
        (self.number_id(&product), node)
    }

    /// Open child sums whose terms cancel a term beside them, so that (a + b) - b is a.
    fn cancel_terms(&mut self, mut terms: Vec<Term>) -> Vec<Term> {
        for _ in 0..8 {
            let Some((first, second)) = self.cancelling_sum(&terms) else { break };
            let mut open = Vec::new();
            for (position, &(factor, id)) in terms.iter().enumerate() {
                match self.view(id) {
                    View::Sum(inner) if position == first || Some(position) == second => {
                        open.extend(inner.iter().map(|(c, node)| (factor, c, node)));
                    }
                    _ => open.push((factor, NumberId::ONE, id)),
                }
            }
            terms = open.into_iter().map(|(factor, c, node)| (self.times(factor, c), node)).collect();
            terms = self.merge_terms(terms);
        }
        terms
    }

    fn times(&mut self, a: NumberId, b: NumberId) -> NumberId {
        let product = self.get_number(a).mul(self.get_number(b));
        self.number_id(&product)
    }

    /// A child sum (and perhaps a second one) that holds a term which cancels another; positions.
    fn cancelling_sum(&self, terms: &[Term]) -> Option<(usize, Option<usize>)> {
        let mut seen: Vec<(Element, usize, bool)> = Vec::new();
        for (position, &(factor, id)) in terms.iter().enumerate() {
            let scaled = |c: NumberId, node: Id| {
                self.number_value(factor).mul(self.number_value(c)).mul(self.value(node))
            };
            seen.push((scaled(NumberId::ONE, id), position, false));
            if let View::Sum(inner) = self.view(id) {
                seen.extend(inner.iter().map(|(c, node)| (scaled(c, node), position, true)));
            }
            if seen.len() > CANCELLATION_SEARCH {
                return None;
            }
        }
        for (i, &(value, position, inner)) in seen.iter().enumerate() {
            let opposite = value.neg();
            for &(other, other_position, other_inner) in &seen[..i] {
                if other == opposite && other_position != position && (inner || other_inner) {
                    return Some(match (inner, other_inner) {
                        (true, true) => (other_position, Some(position)),
                        (true, false) => (position, None),
                        _ => (other_position, None),
                    });
                }
            }
        }
        None
    }

    /// a * b.
    pub fn mul(&mut self, a: Id, b: Id) -> Result<Id, Error> {
        self.product(&[(a, NumberId::ONE), (b, NumberId::ONE)])
    }

    /// a / b.
    ///
    /// # Errors
    /// When b is identically zero.
    pub fn div(&mut self, a: Id, b: Id) -> Result<Id, Error> {
        self.product(&[(a, NumberId::ONE), (b, NumberId::MINUS_ONE)])
    }

    /// base ** exponent with a numeric exponent.
    ///
    /// # Errors
    /// When zero is raised to a negative power, or the root of a negative number is taken.
    pub fn pow_number(&mut self, base: Id, exponent: &Number) -> Result<Id, Error> {
        let exponent = self.number_id(exponent);
        self.product(&[(base, exponent)])
    }

    /// The square root.
    ///
    /// # Errors
    /// When the argument is a negative number.
    pub fn sqrt(&mut self, base: Id) -> Result<Id, Error> {
        self.pow_number(base, &Number::rational(1, 2))
    }

    /// The product of numeric powers of nodes.
    ///
    /// # Errors
    /// When a divisor is identically zero, or an even root of a negative number is taken.
    pub fn product(&mut self, factors: &[Factor]) -> Result<Id, Error> {
        let factors: Vec<Factor> = factors.iter().map(|&(id, e)| (self.adopt(id), e)).collect();
        if let Some(known) = self.known_product(&factors) {
            return Ok(known);
        }
        let factors = if self.classes.is_some() { self.associate(factors) } else { factors };
        let mut collector =
            Collector { coefficient: Number::integer(1), factors: Vec::new(), radicand: None };
        for (base, exponent) in factors {
            let exponent = self.get_number(exponent).clone();
            self.collect_power(&mut collector, base, &exponent)?;
        }
        self.open_shared_products(&mut collector);
        self.finish_product(collector)
    }

    /// The derivation's node for a product of integer powers, found by its value alone.
    fn known_product(&mut self, factors: &[Factor]) -> Option<Id> {
        self.classes.as_ref()?;
        let mut value = Element::ONE;
        for &(base, exponent) in factors {
            let exponent = self.get_number(exponent).to_i64().filter(|e| *e > 0)?;
            value = value.mul(self.value(base).powi(exponent));
        }
        if value.is_zero() {
            return Some(Id::ZERO);
        }
        self.known_value(value)
    }

    fn finish_product(&mut self, collector: Collector) -> Result<Id, Error> {
        let Collector { mut coefficient, mut factors, radicand } = collector;
        if coefficient.is_zero() {
            return Ok(Id::ZERO);
        }
        if let Some(radicand) = radicand {
            let (outside, inside) = square_part(&radicand);
            coefficient = coefficient.mul(&outside);
            if !inside.is_one() {
                factors.push((self.number(&inside), Number::rational(1, 2)));
            }
        }
        self.open_even_moduli(&mut factors);
        let coefficient = self.number_id(&coefficient);
        if let [(base, exponent)] = &factors[..]
            && exponent.is_one()
        {
            return Ok(self.scale(coefficient, *base));
        }
        if factors.is_empty() {
            return Ok(self.number_node(coefficient));
        }
        factors.sort_by_key(|&(base, _)| self.value(base).unsigned().0);
        let mut value = Element::ONE;
        let mut root = false;
        for (base, exponent) in &factors {
            value = value.mul(self.power_value(*base, exponent));
            root |= !exponent.is_integer();
        }
        let mut flags = self.joined_flags(factors.iter().map(|&(base, _)| base));
        root |= factors.iter().any(|&(base, _)| self.flags(base).has(Flags::ROOT));
        if root {
            flags = flags.with(Flags::ROOT);
        }
        let words: Vec<u32> = factors.iter().flat_map(|(base, e)| [base.0, self.number_id(e).0]).collect();
        let id = self.finish(Kind::Product, flags, &words, value);
        self.mark_used(factors.iter().map(|&(base, _)| base));
        Ok(self.scale(coefficient, id))
    }

    /// |u|**2k is u**2k.
    fn open_even_moduli(&self, factors: &mut [(Id, Number)]) {
        for (base, exponent) in factors {
            if let View::Function(Function::Abs, args) = self.view(*base)
                && is_even(exponent)
            {
                *base = args.get(0);
            }
        }
    }

    /// Take base ** exponent into the collector: numbers out, inner powers and multiples resolved.
    fn collect_power(&mut self, out: &mut Collector, base: Id, exponent: &Number) -> Result<(), Error> {
        if exponent.is_zero() {
            return Ok(());
        }
        if base == Id::ZERO {
            if exponent.is_negative() {
                return Err(Error::DivisionByZero("0".into()));
            }
            out.coefficient = Number::integer(0);
            return Ok(());
        }
        match self.view(base) {
            View::Number(number) => {
                let number = self.get_number(number).clone();
                self.collect_number(out, &number, exponent)
            }
            View::Scale(number, child) => {
                let number = self.get_number(number).clone();
                if exponent.is_integer() {
                    self.collect_number(out, &number, exponent)?;
                    return self.collect_power(out, child, exponent);
                }
                self.collect_number(out, &number.abs(), exponent)?;
                if number.is_negative() {
                    let opposite = self.scale(NumberId::MINUS_ONE, child);
                    out.push(self, opposite, exponent);
                    return Ok(());
                }
                self.collect_power(out, child, exponent)
            }
            View::Product(factors) => {
                let inner: Vec<(Id, Number)> =
                    factors.iter().map(|(id, e)| (id, self.get_number(e).clone())).collect();
                self.collect_product_power(out, base, &inner, exponent)
            }
            View::Function(Function::Exp, args) if !exponent.is_integer() => {
                let argument = args.get(0);
                let factor = self.number_id(exponent);
                let argument = self.scale(factor, argument);
                let power = self.apply(Function::Exp, &[argument])?;
                out.push(self, power, &Number::integer(1));
                Ok(())
            }
            View::Function(Function::Abs, args) if is_even(exponent) => {
                let argument = args.get(0);
                self.collect_power(out, argument, exponent)
            }
            _ => {
                out.push(self, base, exponent);
                Ok(())
            }
        }
    }

    /// (product of powers) ** exponent: what may be distributed is, the rest stays one base.
    fn collect_product_power(
        &mut self,
        out: &mut Collector,
        base: Id,
        inner: &[(Id, Number)],
        exponent: &Number,
    ) -> Result<(), Error> {
        let single = inner.len() == 1;
        if exponent.is_integer() {
            let distribute = single || self.flags(base).has(Flags::ROOT);
            if !distribute {
                out.push(self, base, exponent);
                return Ok(());
            }
            for (node, e) in inner {
                self.collect_power(out, *node, &e.mul(exponent))?;
            }
            return Ok(());
        }
        let mut rest = Vec::new();
        for (node, e) in inner {
            if self.is_positive(*node) {
                self.collect_power(out, *node, &e.mul(exponent))?;
            } else if single && is_even(e) {
                // (u**2k)**r = |u|**(2kr) for real u.
                let modulus = self.apply(Function::Abs, &[*node])?;
                out.push(self, modulus, &e.mul(exponent));
            } else {
                rest.push((*node, self.number_id(e)));
            }
        }
        if rest.len() == inner.len() {
            out.push(self, base, exponent);
        } else if !rest.is_empty() {
            let rest = self.product(&rest)?;
            self.collect_power(out, rest, exponent)?;
        }
        Ok(())
    }

    /// Whether the node is positive by what the user promised.
    pub(crate) fn is_positive(&self, id: Id) -> bool {
        match self.view(id) {
            View::Number(number) => !self.get_number(number).is_negative() && id != Id::ZERO,
            View::Pi
            | View::Symbol(_, Assumption::Positive)
            | View::Function(Function::Exp | Function::Cosh, _) => true,
            View::Scale(number, child) => {
                !self.get_number(number).is_negative()
                    && matches!(self.kind(child), Kind::Symbol(Assumption::Positive) | Kind::Pi)
            }
            View::Product(factors) => factors.iter().all(|(base, _)| {
                matches!(self.kind(base), Kind::Symbol(Assumption::Positive) | Kind::Pi)
                    || matches!(self.view(base), View::Number(n) if !self.get_number(n).is_negative())
            }),
            _ => false,
        }
    }

    fn collect_number(
        &mut self,
        out: &mut Collector,
        number: &Number,
        exponent: &Number,
    ) -> Result<(), Error> {
        if let Some(n) = exponent.to_i64() {
            out.coefficient = out.coefficient.mul(&number.powi(n)?);
            return Ok(());
        }
        if number.is_one() {
            return Ok(());
        }
        if number.is_negative() {
            return Err(Error::Domain { function: "the root", argument: number.to_string() });
        }
        let Some((num, den)) = exponent.to_small() else {
            return Err(Error::NumberTooLarge(format!("{number}**({exponent})")));
        };
        let whole = num.div_euclid(den);
        out.coefficient = out.coefficient.mul(&number.powi(whole)?);
        let fraction = Number::rational(num.rem_euclid(den), den);
        if den == 2 {
            out.radicand = Some(out.radicand.as_ref().map_or_else(|| number.clone(), |r| r.mul(number)));
        } else if let Some(root) = exact_root(number, den) {
            out.coefficient = out.coefficient.mul(&root.powi(num.rem_euclid(den))?);
        } else {
            let base = self.number(number);
            out.push(self, base, &fraction);
        }
        Ok(())
    }

    /// Open child products that share a base with a factor beside them where that cancels or merges roots.
    fn open_shared_products(&mut self, out: &mut Collector) {
        for _ in 0..8 {
            let Some(position) = self.product_to_open(&out.factors) else { return };
            let (product, _) = out.factors.remove(position);
            let View::Product(inner) = self.view(product) else { return };
            let inner: Vec<(Id, Number)> =
                inner.iter().map(|(id, e)| (id, self.get_number(e).clone())).collect();
            for (node, exponent) in inner {
                match (self.as_number(node).cloned(), exponent == Number::rational(1, 2)) {
                    (Some(number), true) => {
                        out.radicand =
                            Some(out.radicand.as_ref().map_or_else(|| number.clone(), |r| r.mul(&number)));
                    }
                    _ => out.push(self, node, &exponent),
                }
            }
        }
    }

    fn product_to_open(&self, factors: &[(Id, Number)]) -> Option<usize> {
        if factors.len() < 2 || factors.len() > CANCELLATION_SEARCH {
            // One factor alone, or radicals of numbers beside a product that holds one.
            return None;
        }
        let opens =
            |&(base, ref exponent): &(Id, Number)| exponent.is_one() && self.kind(base) == Kind::Product;
        factors.iter().position(|factor| {
            opens(factor)
                && (self.flags(factor.0).has(Flags::ROOT)
                    || self.inner_factors(factor.0).any(|(node, e)| {
                        factors.iter().any(|(other, other_e)| {
                            (self.same_base(*other, node) && self.merges(&e, other_e))
                                || (opens(&(*other, other_e.clone()))
                                    && *other != factor.0
                                    && self
                                        .inner_factors(*other)
                                        .any(|(n, f)| self.same_base(n, node) && self.merges(&e, &f)))
                        })
                    }))
        })
    }

    fn inner_factors(&self, product: Id) -> impl Iterator<Item = (Id, Number)> {
        let factors = match self.view(product) {
            View::Product(factors) => Some(factors),
            _ => None,
        };
        factors.into_iter().flat_map(|f| f.iter()).map(|(id, e)| (id, self.get_number(e).clone()))
    }

    fn same_base(&self, a: Id, b: Id) -> bool {
        self.value(a).unsigned().0 == self.value(b).unsigned().0
    }

    /// Whether two exponents of one base are better merged: they cancel in part, or one is a root.
    fn merges(&self, a: &Number, b: &Number) -> bool {
        a.is_negative() != b.is_negative() || !a.is_integer() || !b.is_integer()
    }

    /// The value of base ** exponent at the random point.
    pub(crate) fn power_value(&self, base: Id, exponent: &Number) -> Element {
        if exponent.is_integer() {
            return self.value(base).power(exponent);
        }
        if self.is_positive(base) && matches!(self.kind(base), Kind::Symbol(_)) {
            return self.value(base).pow_rational(exponent);
        }
        let whole = exponent.floor();
        let fraction = exponent.sub(&whole);
        let integral = self.value(base).power(&whole);
        if let Some(number) = self.as_number(base)
            && fraction == Number::rational(1, 2)
        {
            return integral.mul(radical_value(number));
        }
        let key = Key::new("root").element(self.value(base));
        integral.mul(Element::draw_exponential(&key).pow_rational(&fraction))
    }
}

/// The parts of a product while it is collected.
struct Collector {
    coefficient: Number,
    factors: Vec<(Id, Number)>,
    /// The product of all numbers under a square root.
    radicand: Option<Number>,
}

impl Collector {
    /// Multiply by base ** exponent; a base with the same or the opposite value takes the exponent.
    fn push(&mut self, graph: &Graph, base: Id, exponent: &Number) {
        let value = graph.value(base);
        for (position, (known, total)) in self.factors.iter_mut().enumerate() {
            let same = graph.value(*known) == value;
            let opposite = !same && graph.value(*known) == value.neg() && exponent.is_integer();
            if !(same || opposite) {
                continue;
            }
            if opposite && !is_even(exponent) {
                self.coefficient = self.coefficient.neg();
            }
            *total = total.add(exponent);
            if total.is_zero() {
                self.factors.remove(position);
            }
            return;
        }
        self.factors.push((base, exponent.clone()));
    }
}

fn is_even(exponent: &Number) -> bool {
    exponent.to_i64().is_some_and(|n| n % 2 == 0)
}

/// number = outside^2 * inside, with a square-free integer inside as far as trial division tells.
fn square_part(number: &Number) -> (Number, Number) {
    let decimal = number.is_decimal();
    let mut inside = number.numerator() * number.denominator();
    let mut outside = num_bigint::BigInt::from(1);
    for q in 2u32..2000 {
        let square = num_bigint::BigInt::from(q) * q;
        if square > inside {
            break;
        }
        while (&inside % &square).bits() == 0 {
            inside /= &square;
            outside *= q;
        }
    }
    let root = inside.sqrt();
    if &root * &root == inside {
        outside *= root;
        inside = num_bigint::BigInt::from(1);
    }
    let outside = Number::from_big(outside, number.denominator()).unwrap_or_else(|_| Number::integer(1));
    let inside = Number::from_big(inside, num_bigint::BigInt::from(1)).unwrap_or_else(|_| Number::integer(1));
    (outside.with_decimal(decimal), inside)
}

/// The exact root of a number, if it has one.
fn exact_root(number: &Number, degree: i64) -> Option<Number> {
    let degree = u32::try_from(degree).ok()?;
    let (num, den) = (number.numerator().nth_root(degree), number.denominator().nth_root(degree));
    let root = Number::from_big(num, den).ok()?.with_decimal(number.is_decimal());
    root.powi(i64::from(degree)).ok()?.same_value(number).then_some(root)
}

/// The value of sqrt(number): the product of the roots of its primes.
fn radical_value(number: &Number) -> Element {
    let mut rest = number.numerator() * number.denominator();
    let mut value =
        Element::from_number(&Number::from_big(1.into(), number.denominator()).unwrap_or(Number::integer(1)));
    for q in 2u32..2000 {
        while (&rest % q).bits() == 0 {
            rest /= q;
            value = value.mul(crate::angle::prime_root(q));
        }
    }
    if rest == num_bigint::BigInt::from(1) {
        return value;
    }
    let rest = Number::from_big(rest, 1.into()).unwrap_or(Number::integer(1));
    value.mul(crate::angle::free_root(&rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn symbols(graph: &mut Graph) -> (Id, Id, Id) {
        let mut symbol = |name| graph.symbol(name, Assumption::Real);
        (symbol("a"), symbol("b"), symbol("c"))
    }

    #[test]
    fn zero_is_seen_when_it_is_made() -> Result<(), Error> {
        let g = &mut Graph::new();
        let (a, b, _) = symbols(g);
        let sum = g.add(a, b);
        let back = g.sub(sum, b);
        assert_eq!(back, a);
        assert_eq!(g.sub(back, a), Id::ZERO);
        let (s, c) = (g.apply(Function::Sin, &[a])?, g.apply(Function::Cos, &[a])?);
        let (s2, c2) = (g.mul(s, s)?, g.mul(c, c)?);
        assert_eq!(g.add(s2, c2), Id::ONE);
        Ok(())
    }

    #[test]
    fn division_by_a_hidden_zero_is_an_error() {
        let g = &mut Graph::new();
        let (a, b, _) = symbols(g);
        let sum = g.add(a, b);
        let difference = g.sub(sum, a);
        let zero = g.sub(difference, b);
        assert!(matches!(g.div(a, zero), Err(Error::DivisionByZero(_))));
    }

    #[test]
    fn roots_keep_their_branch() -> Result<(), Error> {
        let g = &mut Graph::new();
        let (a, b, _) = symbols(g);
        let square = g.mul(a, a)?;
        let root = g.sqrt(square)?;
        assert!(!g.equal(root, a));
        assert_eq!(g.mul(root, root)?, square);
        let root = g.sqrt(a)?;
        let product = g.mul(root, b)?;
        let product = g.mul(product, root)?;
        let expected = g.mul(a, b)?;
        assert!(g.equal(product, expected));
        Ok(())
    }

    #[test]
    fn a_derivation_returns_the_node_that_has_the_value() -> Result<(), Error> {
        let g = &mut Graph::new();
        let (a, b, c) = symbols(g);
        g.enter(Box::default());
        let sum = g.add(b, c);
        let short = g.mul(a, sum)?;
        let (ab, ac) = (g.mul(a, b)?, g.mul(a, c)?);
        let long = g.add(ab, ac);
        assert_eq!(short, long);
        let opposite = g.neg(ab);
        let difference = g.sub(opposite, ac);
        assert_eq!(difference, g.neg(short));
        g.leave();
        Ok(())
    }
}
