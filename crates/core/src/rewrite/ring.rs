//! The polynomial ring of an expression: the nodes that are its atoms, and the way back from polynomials to nodes.

use std::collections::hash_map::Entry;

use rustc_hash::FxHashMap;

use crate::error::Error;
use crate::graph::{ByValue, Function, Graph, Id, NumberId, View, word};
use crate::polynomial::{Budget, Monomial, Polynomial};
use crate::value::Number;

/// The atoms found so far, numbered in the order in which the expression shows them.
///
/// Invariant: no two atoms have equal or opposite values, so equal mathematics is one monomial.
pub(super) struct Ring<'g> {
    pub(crate) graph: &'g mut Graph,
    pub(crate) budget: Budget,
    nodes: Vec<Id>,
    index: ByValue<u32>,
    /// Atoms that are roots: the node under the root and the degree.
    pub(crate) roots: FxHashMap<u32, (Id, i64)>,
    /// Whether everything is opened that can be, as a user asks for, or only what may become shorter.
    pub(super) opens_all: bool,
    /// Whether `a**2 + 2*a*b + b**2` within a longer sum is arranged as a square.
    pub(super) completes_squares: bool,
    /// Arguments of sines and cosines as sums of atoms.
    pub(super) angles: FxHashMap<Id, Polynomial>,
    /// Sums with common factors taken out down to a depth, each with the work that this took.
    pub(super) factored: FxHashMap<(Polynomial, usize), (Id, usize)>,
    /// Products of waves as sums of waves, each with the work that this took.
    pub(super) sums_of_waves: FxHashMap<Monomial, (Polynomial, usize)>,
    /// For a sine the cosine of its angle, for a cosine the sine, and whether it is the opposite of the atom.
    partners: FxHashMap<u32, (u32, bool)>,
    /// The nodes of monomials.
    products: FxHashMap<Monomial, Id>,
}

impl<'g> Ring<'g> {
    pub(crate) fn new(graph: &'g mut Graph, budget: Budget) -> Self {
        Self {
            graph,
            budget,
            nodes: Vec::new(),
            index: ByValue::default(),
            roots: FxHashMap::default(),
            opens_all: false,
            completes_squares: false,
            angles: FxHashMap::default(),
            factored: FxHashMap::default(),
            sums_of_waves: FxHashMap::default(),
            partners: FxHashMap::default(),
            products: FxHashMap::default(),
        }
    }

    pub(crate) fn node(&self, atom: u32) -> Id {
        self.nodes[atom as usize]
    }

    /// The atom of a node, and whether the atom has the opposite value.
    pub(crate) fn atom(&mut self, id: Id) -> (u32, bool) {
        if let Some((&atom, is_opposite)) = self.graph.find_up_to_sign(&self.index, id) {
            return (atom, is_opposite);
        }
        let next = word(self.nodes.len());
        self.nodes.push(id);
        self.index.push(self.graph.value(id), id, next);
        (next, false)
    }

    /// The polynomial of a node that is not opened: a number, or a multiple of an atom.
    pub(super) fn leaf(&mut self, id: Id) -> Polynomial {
        let (factor, child) = self.graph.split_multiple(NumberId::ONE, id);
        let factor = self.graph.get_number(factor).clone();
        if child == Id::ONE {
            return Polynomial::constant(factor);
        }
        let (atom, opposite) = self.atom(child);
        Polynomial::atom(atom).scaled(&if opposite { factor.neg() } else { factor })
    }

    /// The sine or cosine that an atom is, and its argument.
    pub(super) fn wave(&self, atom: u32) -> Option<(Function, Id)> {
        match self.graph.view(self.node(atom)) {
            View::Function(shape @ (Function::Sin | Function::Cos), args) => Some((shape, args.get(0))),
            _ => None,
        }
    }

    /// The other wave of the angle of a sine or cosine, and whether its atom has the opposite value; None for other atoms.
    pub(super) fn partner_of(&mut self, atom: u32) -> Result<Option<(u32, bool)>, Error> {
        if let Some(&known) = self.partners.get(&atom) {
            return Ok(Some(known));
        }
        let Some((shape, angle)) = self.wave(atom) else { return Ok(None) };
        let other = if shape == Function::Sin { Function::Cos } else { Function::Sin };
        let partner = self.graph.apply(other, &[angle])?;
        let partner = self.atom(partner);
        self.partners.insert(atom, partner);
        Ok(Some(partner))
    }

    /// The sine and the cosine of the angles that occur, as atoms.
    pub(super) fn angles_in(&mut self, polynomial: &Polynomial) -> Result<Vec<(u32, u32)>, Error> {
        let mut pairs = Vec::new();
        for atom in polynomial.atoms() {
            let Some((shape, _)) = self.wave(atom) else { continue };
            let Some((partner, opposite)) = self.partner_of(atom)? else { continue };
            let pair = if shape == Function::Sin { (atom, partner) } else { (partner, atom) };
            if !opposite && self.wave(partner).is_some() && !pairs.contains(&pair) {
                pairs.push(pair);
            }
        }
        Ok(pairs)
    }

    /// The sine or cosine of an angle: a multiple of an atom, or a number.
    pub(super) fn wave_of(&mut self, shape: Function, angle: &Polynomial) -> Result<Polynomial, Error> {
        let argument = self.node_of(angle)?;
        let node = self.graph.apply(shape, &[argument])?;
        Ok(self.leaf(node))
    }

    /// The factors of a monomial, as a product takes them.
    pub(crate) fn factors(&mut self, monomial: &Monomial) -> Vec<(Id, NumberId)> {
        let factors = monomial.factors().iter();
        factors
            .map(|&(atom, e)| {
                let exponent = match self.roots.get(&atom) {
                    Some(&(_, degree)) => Number::rational(e, degree),
                    None => Number::integer(e),
                };
                let base = self.roots.get(&atom).map_or(self.nodes[atom as usize], |&(base, _)| base);
                (base, self.graph.number_id(&exponent))
            })
            .collect()
    }

    /// The flat sum of products.
    pub(super) fn node_of(&mut self, polynomial: &Polynomial) -> Result<Id, Error> {
        let mut terms = Vec::with_capacity(polynomial.len());
        for (monomial, coefficient) in polynomial.iter() {
            let product = self.product(monomial)?;
            terms.push((self.graph.number_id(coefficient), product));
        }
        Ok(self.graph.sum(&terms))
    }

    fn product(&mut self, monomial: &Monomial) -> Result<Id, Error> {
        if let Some(&known) = self.products.get(monomial) {
            return Ok(known);
        }
        let factors = self.factors(monomial);
        let product = self.graph.product(&factors)?;
        self.products.insert(monomial.clone(), product);
        Ok(product)
    }

    /// Read an atom as a root from now on: the node under it, and the degree.
    pub(super) fn add_root(&mut self, atom: u32, base: Id, degree: i64) {
        if let Entry::Vacant(entry) = self.roots.entry(atom) {
            entry.insert((base, degree));
            self.products.clear();
            self.factored.clear();
        }
    }

    /// Take a polynomial's numeric and monomial content out and close the rest into an atom.
    pub(crate) fn closed(&mut self, sum: &Polynomial) -> Result<Polynomial, Error> {
        if sum.len() < 2 {
            return Ok(sum.clone());
        }
        let content = sum.lowest_powers();
        let (_, factor) = sum.iter().next_back().expect("a sum has two terms or more");
        let factor = factor.clone();
        let primitive = sum.shifted(&content.pow(-1), &factor.recip()?);
        let node = self.node_of(&primitive)?;
        Ok(self.leaf(node).shifted(&content, &factor))
    }

    /// A product, with integer powers of roots resolved.
    pub(crate) fn times(&mut self, a: &Polynomial, b: &Polynomial) -> Result<Polynomial, Error> {
        let product = a.times(b, &mut self.budget)?;
        self.resolve_roots(product)
    }

    /// A natural power, with roots resolved.
    pub(crate) fn power(&mut self, base: &Polynomial, n: u64) -> Result<Polynomial, Error> {
        let power = base.pow(n, &mut self.budget)?;
        self.resolve_roots(power)
    }

    /// Replace root(u, q)**q by u wherever it occurs.
    fn resolve_roots(&mut self, polynomial: Polynomial) -> Result<Polynomial, Error> {
        let overdue = |ring: &Self, m: &Monomial| {
            let is_whole =
                |&(atom, e): &(u32, i64)| ring.roots.get(&atom).is_some_and(|&(_, q)| e.abs() >= q);
            m.factors().iter().copied().find(is_whole)
        };
        if self.roots.is_empty() || !polynomial.iter().any(|(m, _)| overdue(self, m).is_some()) {
            return Ok(polynomial);
        }
        let mut resolved = Polynomial::default();
        for (monomial, coefficient) in polynomial.iter() {
            let mut term = Polynomial::term(monomial.clone(), coefficient.clone());
            if let Some((atom, exponent)) = overdue(self, monomial) {
                let (base, degree) = self.roots[&atom];
                let whole = exponent / degree;
                let base = self.leaf(base);
                let (power, factor) = single_power(&base, whole)?;
                term = term.shifted(&power.times(&Monomial::power(atom, -whole * degree)), &factor);
                term = self.resolve_roots(term)?;
            }
            resolved.add_scaled(&term, &Number::integer(1));
        }
        Ok(resolved)
    }
}

/// The power of a polynomial of one term.
pub(super) fn single_power(term: &Polynomial, n: i64) -> Result<(Monomial, Number), Error> {
    match term.single() {
        Some((monomial, coefficient)) => Ok((monomial.pow(n), coefficient.powi(n)?)),
        None => Err(Error::Limit { what: "terms under a closed power", limit: 1, found: term.len() }),
    }
}
