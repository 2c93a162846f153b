//! Expansions in powers of small variables, by Taylor's formula at every node, children first.
//!
//! A node has *parts*: its terms of degree 0, 1, ... in the small variables together. They are made from the parts of its
//! children by the rules for series ([`super::series`]), so that nothing of higher degree is ever built. Within a
//! derivation the parts are kept: whatever is made of truncated expressions needs a few operations more.

use rustc_hash::{FxHashMap, FxHashSet};

use super::series::{constant_series, without_constant};
use crate::error::{Error, quoted};
use crate::graph::{Assumption, Flags, Function, Graph, Id, NumberId, View};
use crate::value::Number;

/// The parts of nodes: terms of degree 0, 1, ..., n; nodes that are missing have no small variables.
type Parts = FxHashMap<Id, Box<[Id]>>;

/// The highest degree of an expansion: the terms of a function of several arguments are as many as its powers.
const LARGEST_DEGREE: u32 = 20;

/// What is small, and the parts of nodes up to an order.
struct Expansion {
    /// The small variables; `None` for those that are marked as small.
    variables: Option<FxHashSet<Id>>,
    order: usize,
    parts: Parts,
    /// The parts of the solutions of linear systems: for each degree, the components.
    solutions: FxHashMap<Id, Vec<Vec<Id>>>,
}

impl Expansion {
    /// The terms of degree k of a node.
    fn of(&self, id: Id, k: usize) -> Id {
        match self.parts.get(&id) {
            Some(parts) => parts[k],
            None if k == 0 => id,
            None => Id::ZERO,
        }
    }

    fn all_of(&self, id: Id) -> Vec<Id> {
        (0..=self.order).map(|k| self.of(id, k)).collect()
    }

    fn varies(&self, id: Id) -> bool {
        self.parts.contains_key(&id)
    }

    fn is_small(&self, graph: &Graph, id: Id) -> bool {
        match &self.variables {
            Some(variables) => variables.contains(&id),
            None => graph.is_variable(id) && graph.flags(id).has(Flags::SMALL),
        }
    }
}

impl Graph {
    /// Whether the node contains a variable that is marked as small.
    #[must_use]
    pub fn contains_small(&self, id: Id) -> bool {
        self.flags(id).has(Flags::SMALL)
    }

    /// The expressions without the terms of degree higher than `order` in small variables together.
    ///
    /// A function of time is small with its derivatives. An expression without such terms keeps its form.
    ///
    /// # Errors
    /// If an expression is singular where the small variables vanish, one of the `variables` is none, or the order is
    /// larger than 20.
    ///
    /// # Arguments
    /// `variables`: what is small; `None` for the variables that are marked as small.
    pub fn truncate(&mut self, roots: &[Id], variables: Option<&[Id]>, order: u32) -> Result<Vec<Id>, Error> {
        if variables.is_none() && !roots.iter().any(|&id| self.contains_small(id)) {
            return Ok(roots.to_vec());
        }
        if order > LARGEST_DEGREE {
            let (limit, found) = (LARGEST_DEGREE as usize, order as usize);
            return Err(Error::Limit { what: "degree of an expansion", limit, found });
        }
        let variables = variables.map(|given| self.small_leaves(roots, given)).transpose()?;
        let kept = self.take_expansions(variables.is_none(), order);
        let mut expansion =
            Expansion { variables, order: order as usize, parts: kept, solutions: FxHashMap::default() };
        let result = self.truncated(roots, &mut expansion);
        if expansion.variables.is_none()
            && let Some(classes) = self.classes.as_mut()
        {
            classes.expansions.insert(order, expansion.parts);
        }
        result
    }

    /// What the derivation in progress keeps of expressions: all, or the terms up to its order in small variables.
    ///
    /// # Errors
    /// If an expression is singular where small variables vanish.
    pub fn kept(&mut self, ids: Vec<Id>) -> Result<Vec<Id>, Error> {
        let order = self.classes.as_ref().and_then(|classes| classes.order);
        match order {
            Some(order) if ids.iter().any(|&id| self.contains_small(id)) => self.truncate(&ids, None, order),
            _ => Ok(ids),
        }
    }

    /// The parts that the derivation in progress has made for marked variables.
    fn take_expansions(&mut self, is_marked: bool, order: u32) -> Parts {
        let classes = self.classes.as_mut().filter(|_| is_marked);
        classes.and_then(|classes| classes.expansions.remove(&order)).unwrap_or_default()
    }

    fn truncated(&mut self, roots: &[Id], expansion: &mut Expansion) -> Result<Vec<Id>, Error> {
        let is_marked = expansion.variables.is_none();
        let order = self.post_order_where(roots, |id| {
            !expansion.varies(id) && (!is_marked || self.flags(id).has(Flags::SMALL))
        });
        for id in order {
            if !expansion.is_small(self, id)
                && !self.children(id).iter().any(|&child| expansion.varies(child))
            {
                continue;
            }
            let mut parts = self.parts_of(id, expansion)?;
            parts.resize(expansion.order + 1, Id::ZERO);
            expansion.parts.insert(id, parts.into());
        }
        let mut results = Vec::with_capacity(roots.len());
        for &root in roots {
            if !expansion.varies(root) {
                results.push(root);
                continue;
            }
            let parts = expansion.all_of(root);
            let terms: Vec<(NumberId, Id)> = parts.iter().map(|&part| (NumberId::ONE, part)).collect();
            let sum = self.sum(&terms);
            let result = if self.equal(sum, root) { root } else { sum };
            let is_constant = parts[1..].iter().all(|&part| part == Id::ZERO);
            if !is_constant {
                expansion.parts.insert(result, parts.into());
            }
            results.push(result);
        }
        Ok(results)
    }

    /// The leaves below the roots that are among the variables, or derivatives of functions of time among them.
    fn small_leaves(&self, roots: &[Id], variables: &[Id]) -> Result<FxHashSet<Id>, Error> {
        let mut functions: FxHashMap<(&str, Assumption), u32> = FxHashMap::default();
        for &variable in variables {
            match self.view(variable) {
                View::TimeFunction(name, order, assumption) => {
                    let lowest = functions.entry((name, assumption)).or_insert(order);
                    *lowest = order.min(*lowest);
                }
                _ if self.is_variable(variable) => {}
                _ => return Err(Error::NotAVariable(self.to_quotation(variable))),
            }
        }
        let is_small = |&id: &Id| match self.view(id) {
            View::TimeFunction(name, order, assumption) => {
                functions.get(&(name, assumption)).is_some_and(|&lowest| order >= lowest)
            }
            _ => variables.iter().any(|&variable| self.same(id, variable)),
        };
        Ok(self.variables(roots).into_iter().filter(is_small).collect())
    }

    /// The parts of a node from those of its children.
    fn parts_of(&mut self, id: Id, expansion: &mut Expansion) -> Result<Vec<Id>, Error> {
        if expansion.is_small(self, id) {
            return Ok(vec![Id::ZERO, id]);
        }
        match self.view(id) {
            View::Scale(factor, child) => {
                Ok(expansion.all_of(child).into_iter().map(|part| self.scale(factor, part)).collect())
            }
            View::Sum(terms) => {
                let terms: Vec<(NumberId, Id)> = terms.iter().collect();
                Ok((0..=expansion.order).map(|k| self.sum_of_parts(&terms, k, expansion)).collect())
            }
            View::Product(factors) => {
                let factors: Vec<(Id, NumberId)> = factors.iter().collect();
                self.parts_of_product(id, &factors, expansion)
            }
            View::Function(Function::Piecewise, args) => {
                let args: Vec<Id> = args.iter().collect();
                self.parts_of_branches(id, &args, expansion)
            }
            View::Function(function, args) => {
                let args: Vec<Id> = args.iter().collect();
                self.parts_of_function(id, function, &args, expansion)
            }
            View::Application { name, args, orders } => {
                let (name, args, orders) =
                    (name.to_owned(), args.iter().collect::<Vec<_>>(), orders.to_vec());
                self.by_taylor(id, &args, expansion, &mut |graph, at, more| {
                    let orders: Vec<u32> = orders.iter().zip(more).map(|(a, b)| a + b).collect();
                    graph.application(&name, at, &orders)
                })
            }
            View::Solution(system, index) => {
                let parts = self.parts_of_solution(system, expansion)?;
                Ok(parts.iter().map(|components| components[index as usize]).collect())
            }
            // A linear system has no value by itself; its solutions look at its parts.
            _ => Ok(vec![id]),
        }
    }

    fn sum_of_parts(&mut self, terms: &[(NumberId, Id)], k: usize, expansion: &Expansion) -> Id {
        let parts: Vec<(NumberId, Id)> =
            terms.iter().map(|&(factor, term)| (factor, expansion.of(term, k))).collect();
        let parts: Vec<_> = parts.into_iter().filter(|&(_, part)| part != Id::ZERO).collect();
        self.sum(&parts)
    }

    fn parts_of_product(
        &mut self,
        id: Id,
        factors: &[(Id, NumberId)],
        expansion: &Expansion,
    ) -> Result<Vec<Id>, Error> {
        let constant: Vec<_> = factors.iter().copied().filter(|&(base, _)| !expansion.varies(base)).collect();
        let mut parts = constant_series(self.product(&constant)?, expansion.order);
        for &(base, exponent) in factors.iter().filter(|&&(base, _)| expansion.varies(base)) {
            let exponent = self.get_number(exponent).clone();
            let power = self.power_of_series(&expansion.all_of(base), &exponent)?;
            let Some(power) = power else { return Err(self.no_expansion(id, expansion)) };
            parts = self.product_of_series(&parts, &power)?;
        }
        Ok(parts)
    }

    fn parts_of_function(
        &mut self,
        id: Id,
        function: Function,
        args: &[Id],
        expansion: &Expansion,
    ) -> Result<Vec<Id>, Error> {
        match function {
            Function::Sin | Function::Cos => {
                return self.wave_of_series(function, &expansion.all_of(args[0]));
            }
            Function::Abs | Function::Sign if self.equal(expansion.of(args[0], 0), Id::ZERO) => {
                return Err(self.no_expansion(id, expansion));
            }
            Function::Min | Function::Max => self.check_extremum(id, args, expansion)?,
            _ => {}
        }
        let places: Vec<Id> =
            (0..args.len()).map(|k| self.symbol(&format!("argument {k}"), Assumption::Real)).collect();
        let general = self.apply(function, &places)?;
        self.by_taylor(id, args, expansion, &mut |graph, at, orders| {
            let mut slope = general;
            for (&place, &n) in places.iter().zip(orders) {
                slope = graph.diff_times(slope, place, n.into())?;
            }
            let pairs: Vec<(Id, Id)> = places.iter().copied().zip(at.iter().copied()).collect();
            Ok(graph.substitute(&[slope], &pairs)?[0])
        })
    }

    /// Two arguments that are equal where small variables vanish leave open which of them is the extremum.
    fn check_extremum(&mut self, id: Id, args: &[Id], expansion: &Expansion) -> Result<(), Error> {
        for (k, &a) in args.iter().enumerate() {
            for &b in &args[k + 1..] {
                if self.equal(expansion.of(a, 0), expansion.of(b, 0)) {
                    return Err(self.no_expansion(id, expansion));
                }
            }
        }
        Ok(())
    }

    /// Taylor's formula in several arguments. `slope` is a partial derivative of given orders at a place.
    fn by_taylor(
        &mut self,
        id: Id,
        args: &[Id],
        expansion: &Expansion,
        slope: &mut impl FnMut(&mut Self, &[Id], &[u32]) -> Result<Id, Error>,
    ) -> Result<Vec<Id>, Error> {
        let at: Vec<Id> = args.iter().map(|&arg| expansion.of(arg, 0)).collect();
        let mut terms = vec![Vec::new(); expansion.order + 1];
        let varying: Vec<usize> = (0..args.len()).filter(|&k| expansion.varies(args[k])).collect();
        for chosen in multi_indices(varying.len(), expansion.order) {
            let mut orders = vec![0; args.len()];
            for (&place, &n) in varying.iter().zip(&chosen) {
                orders[place] = n;
            }
            let mut power = constant_series(Id::ONE, expansion.order);
            let mut factor = Number::integer(1);
            for (&arg, &n) in args.iter().zip(&orders) {
                let deviation = without_constant(&expansion.all_of(arg));
                for m in 1..=n {
                    power = self.product_of_series(&power, &deviation)?;
                    factor = factor.mul(&Number::rational(1, m.into()));
                }
            }
            if power.iter().all(|&part| part == Id::ZERO) {
                continue;
            }
            let value = slope(self, &at, &orders).map_err(|error| match error {
                Error::DivisionByZero(_) | Error::Domain { .. } => self.no_expansion(id, expansion),
                other => other,
            })?;
            let factor = self.number_id(&factor);
            let value = self.scale(factor, value);
            for (k, &part) in power.iter().enumerate().filter(|&(_, &part)| part != Id::ZERO) {
                terms[k].push((NumberId::ONE, self.mul(value, part)?));
            }
        }
        Ok(terms.iter().map(|terms| self.sum(terms)).collect())
    }

    /// The parts of the branch that is chosen where the small variables vanish.
    fn parts_of_branches(&mut self, id: Id, args: &[Id], expansion: &Expansion) -> Result<Vec<Id>, Error> {
        let is_condition = |k: usize| k % 2 == 1 && k + 1 < args.len();
        for (_, &condition) in args.iter().enumerate().filter(|&(k, _)| is_condition(k)) {
            if expansion.varies(condition) && self.equal(expansion.of(condition, 0), Id::ZERO) {
                return Err(self.no_expansion(id, expansion));
            }
        }
        (0..=expansion.order)
            .map(|degree| {
                let branches: Vec<Id> = args
                    .iter()
                    .enumerate()
                    .map(|(k, &arg)| expansion.of(arg, if is_condition(k) { 0 } else { degree }))
                    .collect();
                self.apply(Function::Piecewise, &branches)
            })
            .collect()
    }

    /// The parts of the solution of A x = b: `A_0 x_k = b_k - sum_j A_j x_(k-j)`.
    fn parts_of_solution(&mut self, system: Id, expansion: &mut Expansion) -> Result<Vec<Vec<Id>>, Error> {
        if let Some(known) = expansion.solutions.get(&system) {
            return Ok(known.clone());
        }
        let (matrix, right) = self.parts_of_system(system);
        let resting: Vec<Id> = matrix.iter().map(|&entry| expansion.of(entry, 0)).collect();
        let mut found: Vec<Vec<Id>> = Vec::new();
        for k in 0..=expansion.order {
            let mut changes = Vec::with_capacity(right.len());
            for (row, &entry) in matrix.chunks_exact(right.len()).zip(&right) {
                let mut terms = vec![(NumberId::ONE, expansion.of(entry, k))];
                for j in 1..=k {
                    for (&coefficient, &component) in row.iter().zip(&found[k - j]) {
                        let slope = expansion.of(coefficient, j);
                        if slope != Id::ZERO && component != Id::ZERO {
                            terms.push((NumberId::MINUS_ONE, self.mul(slope, component)?));
                        }
                    }
                }
                changes.push(self.sum(&terms));
            }
            let linear = self.linear_system(&resting, &changes)?;
            if !self.flags(linear).has(Flags::BRANCH) && self.plain_solution(linear).is_none() {
                return Err(self.no_expansion(system, expansion));
            }
            found.push(self.linear_solve(&resting, &changes)?);
        }
        expansion.solutions.insert(system, found.clone());
        Ok(found)
    }

    /// The error for a node that is singular where small variables vanish.
    fn no_expansion(&self, id: Id, expansion: &Expansion) -> Error {
        let expression = match self.view(id) {
            View::LinearSystem { .. } => "the solution of a linear system".to_owned(),
            _ => self.to_quotation(id),
        };
        let mut names: Vec<String> = Vec::new();
        for leaf in self.variables(&[id]) {
            let name = self.to_text(leaf);
            if expansion.is_small(self, leaf) && !names.contains(&name) {
                names.push(name);
            }
        }
        Error::NoExpansion { expression, variables: quoted(&names.join(", ")) }
    }
}

/// All tuples of `length` orders whose sum is at most `most`.
fn multi_indices(length: usize, most: usize) -> Vec<Vec<u32>> {
    let mut found = vec![Vec::new()];
    for _ in 0..length {
        found = found
            .into_iter()
            .flat_map(|orders: Vec<u32>| {
                let left = most - orders.iter().sum::<u32>() as usize;
                (0_u32..).take(left + 1).map(move |n| [&orders[..], &[n]].concat())
            })
            .collect();
    }
    found
}
