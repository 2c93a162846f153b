//! Products: equal bases merge by value, and numbers and signs are taken out.

use crate::error::Error;
use crate::evaluate::{Pending, makes_units};
use crate::graph::{Factors, Flags, Function, Graph, Id, Kind, LONGEST, NumberId, View};
use crate::value::Number;

use super::collector::Collector;

/// Factors up to this count are searched for ones that merge with those of child products.
const MERGE_SEARCH: usize = 48;

type Factor<E = NumberId> = (Id, E);

impl Graph {
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
        let factors: Vec<Factor> = factors
            .iter()
            .map(|&(id, e)| {
                let id = self.adopt(id);
                if e == NumberId::ONE {
                    return (id, e);
                }
                (if self.get_number(e).is_integer() { self.settled(id) } else { self.decided(id) }, e)
            })
            .collect();
        if factors.iter().any(|&(id, e)| id == Id::ZERO && self.get_number(e).is_negative()) {
            return Err(self.zero_divisor(&factors));
        }
        if let Some(known) = self.known_product(&factors).or_else(|| self.quotient_of_equals(&factors)) {
            return Ok(known);
        }
        let associated =
            if self.classes.is_some() { self.associate(factors.clone()) } else { factors.clone() };
        let mut collector = Collector::new(Vec::new());
        for (base, exponent) in associated {
            let exponent = self.get_number(exponent).clone();
            self.collect_power(&mut collector, base, &exponent)?;
        }
        self.open_powers_of_numbers(&mut collector)?;
        self.open_shared_products(&mut collector);
        self.merge_moduli(&mut collector)?;
        self.merge_drawn_roots(&mut collector);
        let product = self.finish_product(collector);
        Ok(if self.keeps_value(&factors, product) { product } else { self.plain_product(&factors) })
    }

    /// A quotient of equal or opposite nodes: it is 1 or -1, also if both are zero for some signs, as x + |x| is.
    fn quotient_of_equals(&mut self, factors: &[Factor]) -> Option<Id> {
        let &[(a, one), (b, other)] = factors else { return None };
        let is_quotient = [(one, other), (other, one)].contains(&(NumberId::ONE, NumberId::MINUS_ONE));
        let has_signs = [a, b].iter().all(|&id| self.flags(id).has(Flags::BRANCH));
        if !is_quotient || !has_signs {
            return None;
        }
        let is_opposite = !self.same(a, b);
        if is_opposite && !self.opposite_values(a, b) {
            return None;
        }
        Some(if is_opposite { self.neg(Id::ONE) } else { Id::ONE })
    }

    /// Whether the rules that made a product have kept the value: those of roots inside roots, which may be complex in
    /// some lanes, need not, nor those of roots of exponentials, whose arguments may be known in other forms.
    fn keeps_value(&self, factors: &[Factor], product: Id) -> bool {
        let is_doubtful = |&(base, exponent): &Factor| {
            let is_root = !self.get_number(exponent).is_integer();
            is_root && self.kind(base) == Kind::Function(Function::Exp)
                || self.flags(base).has(Flags::BRANCH) && (is_root || self.is_root_of_root(base))
        };
        !factors.iter().any(is_doubtful)
            || self.product_fingerprint(factors) == self.value(product)
                && self.agrees(Pending::Product(factors), product, false)
    }

    fn is_root_of_root(&self, id: Id) -> bool {
        let branches = |id: Id| self.flags(id).has(Flags::BRANCH);
        match self.view(id) {
            View::Product(factors) => factors.iter().any(|(base, exponent)| {
                branches(base) && (!self.get_number(exponent).is_integer() || self.is_root_of_root(base))
            }),
            View::Function(Function::Abs, args) => branches(args.get(0)),
            View::Scale(_, child) => self.is_root_of_root(child),
            _ => false,
        }
    }

    /// The product as it is written: each root is a node of its own.
    fn plain_product(&mut self, factors: &[Factor]) -> Id {
        let mut collector = Collector::new(Vec::new());
        for &(base, exponent) in factors {
            let (factor, node) = self.split_multiple(NumberId::ONE, base);
            let exponent = self.get_number(exponent).clone();
            let power = exponent.to_i64().and_then(|n| self.get_number(factor).powi(n).ok());
            if let Some(power) = power {
                collector.coefficient = collector.coefficient.mul(&power);
                if node != Id::ONE {
                    collector.push(self, node, &exponent);
                }
            } else {
                let root = self.finish_product(Collector::new(vec![(base, exponent)]));
                collector.push(self, root, &Number::integer(1));
            }
        }
        self.merge_drawn_roots(&mut collector);
        self.finish_product(collector)
    }

    /// The error that names the dividend.
    fn zero_divisor(&mut self, factors: &[Factor]) -> Error {
        let dividend: Vec<Factor> = factors.iter().copied().filter(|&(id, _)| id != Id::ZERO).collect();
        match self.product(&dividend) {
            Ok(dividend) => Error::DivisionByZero(self.to_quotation(dividend)),
            Err(error) => error,
        }
    }

    /// The node of the derivation that has the value of a product of integer powers.
    fn known_product(&mut self, factors: &[Factor]) -> Option<Id> {
        self.classes.as_ref()?;
        if factors.iter().all(|&(base, _)| self.as_number(base).is_some()) {
            return None;
        }
        if factors.iter().any(|&(_, exponent)| self.get_number(exponent).to_i64().is_none_or(|e| e <= 0)) {
            return None;
        }
        let value = self.product_fingerprint(factors);
        if value.is_zero() && self.is_number_everywhere(Pending::Product(factors), &Number::integer(0)) {
            return Some(Id::ZERO);
        }
        self.known_value(value, Pending::Product(factors))
    }

    fn finish_product(&mut self, mut collector: Collector) -> Id {
        if collector.coefficient.is_zero() {
            return Id::ZERO;
        }
        self.settle_primes(&mut collector);
        let Collector { coefficient, mut factors, .. } = collector;
        let coefficient = self.number_id(&coefficient);
        if let [(base, exponent)] = &factors[..]
            && exponent.is_one()
        {
            return self.scale(coefficient, *base);
        }
        if factors.is_empty() {
            return self.number_node(coefficient);
        }
        factors.sort_by(|(a, _), (b, _)| self.compare_values(*a, *b));
        while factors.len() * 2 > LONGEST {
            let factors_of_part = factors.split_off(factors.len() - LONGEST / 4);
            factors.push((self.finish_product(Collector::new(factors_of_part)), Number::integer(1)));
        }
        let mut root = factors.iter().any(|(_, exponent)| !exponent.is_integer());
        let mut flags = self.joined_flags(factors.iter().map(|&(base, _)| base));
        if factors.iter().any(|(base, exponent)| self.is_branching(*base, exponent)) {
            flags = flags.with(Flags::BRANCH);
            if factors.iter().any(|(base, e)| makes_units(e) && self.is_branching(*base, e)) {
                flags = flags.with(Flags::UNITS);
            }
        }
        // Moduli merge to squares as roots do.
        root |= factors.iter().any(|&(base, _)| {
            self.flags(base).has(Flags::ROOT) || self.kind(base) == Kind::Function(Function::Abs)
        });
        if root {
            flags = flags.with(Flags::ROOT);
        }
        let factors: Vec<Factor> = factors.into_iter().map(|(base, e)| (base, self.number_id(&e))).collect();
        let words: Vec<u32> = factors.iter().flat_map(|&(base, e)| [base.0, e.0]).collect();
        let value = self.product_fingerprint(&factors);
        let id = self.finish(Kind::Product, flags, &words, value);
        if self.holds_drawn_root(id) {
            self.representative(id); // so that it stands for the sums of its value
        }
        self.mark_used(factors.iter().map(|&(base, _)| base));
        self.scale(coefficient, id)
    }

    /// Leave at most one modulus: |a| |b| is |a b|, |a|**3 is a**2 |a|. So equal products of moduli have one value.
    fn merge_moduli(&mut self, out: &mut Collector) -> Result<(), Error> {
        let is_modulus = |graph: &Self, (base, exponent): &(Id, Number)| {
            graph.kind(*base) == Kind::Function(Function::Abs)
                && graph.children(*base).first().is_some_and(|&argument| graph.has_real_values(argument))
                && exponent.is_integer()
        };
        if !out.factors.iter().any(|factor| is_modulus(self, factor)) {
            return Ok(());
        }
        let (moduli, rest): (Vec<_>, Vec<_>) =
            out.factors.drain(..).partition(|factor| is_modulus(self, factor));
        out.factors = rest;
        if let [(modulus, exponent)] = &moduli[..]
            && exponent.is_one()
        {
            out.push(self, *modulus, exponent);
            return Ok(());
        }
        let mut inside = Vec::new();
        for (modulus, exponent) in &moduli {
            let View::Function(_, args) = self.view(*modulus) else { continue };
            let (argument, odd) = (args.get(0), !exponent.is_even());
            let even = if odd { exponent.sub(&Number::integer(1)) } else { exponent.clone() };
            self.collect_power(out, argument, &even)?;
            if odd {
                inside.push((argument, NumberId::ONE));
            }
        }
        if !inside.is_empty() {
            let inside = self.product(&inside)?;
            let modulus = self.apply(Function::Abs, &[inside])?;
            let (factor, modulus) = self.split_multiple(NumberId::ONE, modulus);
            out.coefficient = out.coefficient.mul(self.get_number(factor));
            if modulus != Id::ONE {
                out.push(self, modulus, &Number::integer(1));
            }
        }
        Ok(())
    }

    /// The factors of nested products, as far as their exponents are integers.
    pub(crate) fn opened(&self, factors: &[(Id, Number)]) -> Vec<(Id, Number)> {
        let mut out = Vec::new();
        let mut open: Vec<(Id, Number)> = factors.iter().rev().cloned().collect();
        while let Some((base, exponent)) = open.pop() {
            match self.view(base) {
                View::Product(inner) if exponent.is_integer() => {
                    open.extend(
                        inner.iter().rev().map(|(node, e)| (node, self.get_number(e).mul(&exponent))),
                    );
                }
                _ => out.push((base, exponent)),
            }
        }
        out
    }

    /// Open the powers of products of roots of numbers that equal factors have made: the roots become numbers again.
    fn open_powers_of_numbers(&mut self, out: &mut Collector) -> Result<(), Error> {
        let is_power = |graph: &Self, (base, exponent): &(Id, Number)| {
            !exponent.is_one() && exponent.is_integer() && graph.is_product_of_numbers(*base)
        };
        let (powers, rest): (Vec<_>, Vec<_>) =
            out.factors.drain(..).partition(|factor| is_power(self, factor));
        out.factors = rest;
        powers.iter().try_for_each(|(base, exponent)| self.collect_power(out, *base, exponent))
    }

    fn is_product_of_numbers(&self, id: Id) -> bool {
        self.kind(id) == Kind::Product
            && self.inner_factors(id).all(|(inner, _)| self.as_number(inner).is_some())
    }

    /// Open child products that share a base with a factor beside them where that cancels or merges roots.
    fn open_shared_products(&mut self, out: &mut Collector) {
        for _ in 0..MERGE_SEARCH {
            let beside = !out.primes.is_empty()
                || out.factors.iter().any(|&(base, _)| self.kind(base) == Kind::Function(Function::Abs));
            let Some(position) = self.product_to_open(&out.factors, beside) else { return };
            let (product, outer) = out.factors.remove(position);
            let inner: Vec<(Id, Number)> = self.inner_factors(product).collect();
            for (node, exponent) in inner {
                let exponent = exponent.mul(&outer);
                match self.as_number(node).cloned() {
                    Some(number) => out.push_power_of_number(&number, &exponent),
                    None => out.push(self, node, &exponent),
                }
            }
        }
    }

    /// The first child product to open. One with the root of a number or a modulus is opened only where others may merge
    /// with it: in a second such product, or `beside` the products. So sqrt(3) x / l stays shared in all its multiples.
    fn product_to_open(&self, factors: &[(Id, Number)], beside: bool) -> Option<usize> {
        if let [(base, exponent)] = factors {
            // Radicals of numbers beside a product: what may merge with them is all of it, or it stays shared.
            let is_of_numbers = exponent.is_one() && self.is_product_of_numbers(*base);
            return (beside && is_of_numbers).then_some(0);
        }
        if factors.len() > MERGE_SEARCH {
            return None;
        }
        let has_radicals = |(base, exponent): &(Id, Number)| {
            exponent.is_one() && self.kind(*base) == Kind::Product && self.holds_number_or_modulus(*base)
        };
        let radicals_merge = beside || factors.iter().filter(|factor| has_radicals(factor)).count() > 1;
        let within: Vec<Vec<(Id, Number)>> =
            factors.iter().map(|factor| self.factors_within(factor)).collect();
        let merge =
            |(a, e): &(Id, Number), (b, f): &(Id, Number)| Self::merges(e, f) && self.same_up_to_sign(*a, *b);
        let merges_beside = |position: usize| {
            let others = (0..factors.len()).filter(|&other| other != position);
            let beside: Vec<_> =
                others.flat_map(|other| within[other].iter().chain([&factors[other]])).collect();
            within[position].iter().any(|factor| beside.iter().any(|other| merge(factor, other)))
        };
        (0..factors.len()).find(|&k| {
            radicals_merge && has_radicals(&factors[k]) || !within[k].is_empty() && merges_beside(k)
        })
    }

    /// The factors inside of a factor that is a whole power of a product, and those of the products among them. In a
    /// derivation, whose results share products, only the factors of a product itself.
    fn factors_within(&self, (base, exponent): &(Id, Number)) -> Vec<(Id, Number)> {
        let mut found = Vec::new();
        let is_deep = self.classes.is_none();
        if self.kind(*base) != Kind::Product || !exponent.is_integer() || !(is_deep || exponent.is_one()) {
            return found;
        }
        let mut products = vec![(*base, exponent.clone())];
        while let Some((product, outer)) = products.pop()
            && found.len() < 2 * MERGE_SEARCH
        {
            for (node, exponent) in self.inner_factors(product) {
                let exponent = exponent.mul(&outer);
                if is_deep && self.kind(node) == Kind::Product && exponent.is_integer() {
                    products.push((node, exponent.clone()));
                }
                found.push((node, exponent));
            }
        }
        found
    }

    /// Whether a product has factors that merge with others of their kind: roots of numbers, and moduli.
    fn holds_number_or_modulus(&self, product: Id) -> bool {
        self.flags(product).has(Flags::ROOT)
            && self.inner_factors(product).any(|(base, _)| {
                self.as_number(base).is_some() || self.kind(base) == Kind::Function(Function::Abs)
            })
    }

    fn inner_factors(&self, product: Id) -> impl Iterator<Item = (Id, Number)> {
        let factors = match self.view(product) {
            View::Product(factors) => Some(factors),
            _ => None,
        };
        factors.into_iter().flat_map(Factors::iter).map(|(id, e)| (id, self.get_number(e).clone()))
    }

    /// Whether to merge two exponents of one base: they cancel in part, or one is that of a root.
    fn merges(a: &Number, b: &Number) -> bool {
        a.is_negative() != b.is_negative() || !a.is_integer() || !b.is_integer()
    }
}
