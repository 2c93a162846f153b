//! Derivatives: forward (one variable, many results), reverse (one result, many variables), in time.

use rustc_hash::FxHashMap;

use crate::error::Error;
use crate::graph::{Function, Graph, Id, NumberId, View, check_order};

use super::vanishing::Variables;

/// The variables on which each node depends: one row of bits per node.
struct Dependence {
    order: Vec<Id>,
    bits: FxHashMap<Id, Box<[u64]>>,
}

impl Dependence {
    /// Nodes that depend on variable `j`, children first.
    fn on(&self, j: usize) -> impl DoubleEndedIterator<Item = Id> {
        self.order.iter().copied().filter(move |id| self.bits[id][j / 64] >> (j % 64) & 1 == 1)
    }

    fn is_active(&self, id: Id) -> bool {
        self.bits.get(&id).is_some_and(|row| row.iter().any(|&word| word != 0))
    }
}

impl Graph {
    /// The derivative with respect to a variable: a symbol, t, or a function of time (whose derivatives are other
    /// variables). It is the partial one, except with respect to t: that derivative is the total one.
    ///
    /// # Errors
    /// If `variable` is not a variable.
    pub fn diff(&mut self, id: Id, variable: Id) -> Result<Id, Error> {
        Ok(self.diff_all(&[id], variable)?[0])
    }

    /// The n-th derivative: the partial one, and with respect to t the total one.
    ///
    /// # Errors
    /// If `variable` is not a variable, or n is larger than [`LARGEST_ORDER`](crate::LARGEST_ORDER).
    pub fn diff_times(&mut self, id: Id, variable: Id, n: u64) -> Result<Id, Error> {
        check_order(n)?;
        (0..n).try_fold(id, |id, _| self.diff(id, variable))
    }

    /// The derivatives of several expressions with respect to one variable: the partial ones, and with respect to t
    /// the total ones.
    ///
    /// # Errors
    /// If `variable` is not a variable.
    pub fn diff_all(&mut self, ids: &[Id], variable: Id) -> Result<Vec<Id>, Error> {
        self.check_variable(variable)?;
        if matches!(self.view(variable), View::Time) {
            return self.time_derivatives(ids);
        }
        self.partial_derivatives(ids, variable)
    }

    /// The partial derivatives of several expressions with respect to one variable. All other variables are constants,
    /// also with respect to t: functions of time are not differentiated.
    ///
    /// # Errors
    /// If `variable` is not a variable.
    pub fn partial_derivatives(&mut self, ids: &[Id], variable: Id) -> Result<Vec<Id>, Error> {
        self.check_variable(variable)?;
        let by = [variable];
        let rows = self.congruent_derivatives(ids, Variables::Each(&by), |graph, ids| {
            Ok(in_rows(graph.partial_tangents(ids, variable)?))
        })?;
        Ok(rows.concat())
    }

    fn partial_tangents(&mut self, ids: &[Id], variable: Id) -> Result<Vec<Id>, Error> {
        let ids: Vec<Id> = ids.iter().map(|&id| self.adopt(id)).collect();
        let dependence = self.dependence(&ids, &[variable]);
        if self.is_complex(variable) {
            self.check_no_moduli(dependence.on(0))?;
        }
        self.tangents(&ids, dependence.on(0), &mut |graph, id| {
            Ok(graph.same(id, variable).then_some(Id::ONE))
        })
    }

    /// The total derivatives with respect to time: x -> x', x' -> x''.
    ///
    /// # Errors
    /// If a divisor is identically zero.
    pub fn time_derivatives(&mut self, ids: &[Id]) -> Result<Vec<Id>, Error> {
        let rows = self.congruent_derivatives(ids, Variables::OfTime, |graph, ids| {
            Ok(in_rows(graph.total_tangents(ids)?))
        })?;
        Ok(rows.concat())
    }

    fn total_tangents(&mut self, ids: &[Id]) -> Result<Vec<Id>, Error> {
        let ids: Vec<Id> = ids.iter().map(|&id| self.adopt(id)).collect();
        let order = self.post_order_where(&ids, |id| self.depends_on_time(id));
        self.tangents(&ids, order.into_iter(), &mut |graph, id| {
            let next = match graph.view(id) {
                View::Time => return Ok(Some(Id::ONE)),
                View::TimeFunction(name, order, assumption) => (name.to_owned(), order + 1, assumption),
                _ => return Ok(None),
            };
            graph.derivative_of_function(&next.0, next.1, next.2).map(Some)
        })
    }

    /// The total derivative with respect to time.
    ///
    /// # Errors
    /// If a divisor is identically zero.
    pub fn time_derivative(&mut self, id: Id) -> Result<Id, Error> {
        Ok(self.time_derivatives(&[id])?[0])
    }

    /// Check that derivatives with respect to `variables` have one meaning: with respect to t, those of an expression
    /// that contains functions of time are total or partial.
    ///
    /// # Errors
    /// If t is among the variables, and a function of time is in one of the expressions.
    pub fn check_unambiguous(&self, ids: &[Id], variables: &[Id]) -> Result<(), Error> {
        if !variables.iter().any(|&variable| matches!(self.view(variable), View::Time)) {
            return Ok(());
        }
        for &id in ids.iter().filter(|&&id| self.depends_on_time(id)) {
            let mut leaves = self.variables(&[id]).into_iter();
            if let Some(function) = leaves.find(|&leaf| matches!(self.view(leaf), View::TimeFunction(..))) {
                let (expression, function) = (self.to_quotation(id), self.to_text(function));
                return Err(Error::TwoTimeDerivatives { expression, function });
            }
        }
        Ok(())
    }

    fn check_variable(&self, variable: Id) -> Result<(), Error> {
        if self.is_variable(variable) {
            Ok(())
        } else {
            Err(Error::NotAVariable(self.to_quotation(variable)))
        }
    }

    fn dependence(&self, roots: &[Id], variables: &[Id]) -> Dependence {
        let width = variables.len().div_ceil(64);
        let position: FxHashMap<_, usize> =
            variables.iter().enumerate().map(|(j, &variable)| (self.value(variable), j)).collect();
        let order = self.post_order(roots);
        let mut bits: FxHashMap<Id, Box<[u64]>> = FxHashMap::default();
        let mut children = Vec::new();
        for &id in &order {
            let mut row = vec![0u64; width].into_boxed_slice();
            if self.is_variable(id)
                && let Some(&j) = position.get(&self.value(id))
            {
                row[j / 64] |= 1 << (j % 64);
            }
            children.clear();
            self.push_children(id, &mut children);
            for child in &children {
                for (word, below) in row.iter_mut().zip(&bits[child]) {
                    *word |= below;
                }
            }
            bits.insert(id, row);
        }
        Dependence { order, bits }
    }

    /// Forward differentiation over the nodes of `order`; all others have derivative zero.
    fn tangents(
        &mut self,
        roots: &[Id],
        order: impl Iterator<Item = Id>,
        seed: &mut impl FnMut(&mut Self, Id) -> Result<Option<Id>, Error>,
    ) -> Result<Vec<Id>, Error> {
        let mut tangent: FxHashMap<Id, Id> = FxHashMap::default();
        for id in order {
            let derivative = match seed(self, id)? {
                Some(derivative) => derivative,
                None => self.chain_rule(id, &tangent)?,
            };
            tangent.insert(id, derivative);
        }
        Ok(roots.iter().map(|id| tangent.get(id).copied().unwrap_or(Id::ZERO)).collect())
    }

    /// The derivative of a node from those of its children.
    fn chain_rule(&mut self, id: Id, tangent: &FxHashMap<Id, Id>) -> Result<Id, Error> {
        let of = |child: Id| tangent.get(&child).copied().filter(|&d| d != Id::ZERO);
        if let View::Function(Function::Piecewise, args) = self.view(id) {
            let args: Vec<Id> = args.iter().collect();
            let branches: Vec<Id> = args
                .iter()
                .enumerate()
                .map(|(k, &arg)| if k % 2 == 1 { arg } else { of(arg).unwrap_or(Id::ZERO) })
                .collect();
            return self.apply(Function::Piecewise, &branches);
        }
        match self.view(id) {
            View::Function(function @ (Function::Abs | Function::Sign), args) => {
                let argument = args.get(0);
                if let Some(derivative) = of(argument).filter(|_| self.is_complex(argument)) {
                    return self.modulus_tangent(function, argument, derivative, id);
                }
            }
            View::LinearSystem { .. } => return self.system_tangent(id, tangent),
            View::Solution(system, index) => {
                return Ok(of(system).map_or(Id::ZERO, |tangent| self.solution(tangent, index)));
            }
            _ => {}
        }
        let mut terms = Vec::new();
        for (k, child) in self.children(id).into_iter().enumerate() {
            let Some(derivative) = of(child) else { continue };
            let (factor, partial) = self.partial(id, k)?;
            let term = if partial == Id::ONE { derivative } else { self.mul(partial, derivative)? };
            terms.push((factor, term));
        }
        Ok(self.sum(&terms))
    }

    /// Check that there are no moduli or signs of what is complex: these have no derivative by a complex variable.
    fn check_no_moduli(&self, mut nodes: impl Iterator<Item = Id>) -> Result<(), Error> {
        let argument = |id: Id| match self.view(id) {
            View::Function(Function::Abs | Function::Sign, args) => Some(args.get(0)),
            _ => None,
        };
        match nodes.find(|&id| argument(id).is_some_and(|u| self.is_complex(u))) {
            Some(id) => Err(Error::NoDerivative {
                expression: self.to_quotation(id),
                symbol: self.complex_symbol(id),
            }),
            None => Ok(()),
        }
    }

    /// The partial derivatives of one expression with respect to many variables, by one reverse sweep; with respect to
    /// t, too.
    ///
    /// # Errors
    /// If one of them is not a variable.
    pub fn gradient(&mut self, id: Id, variables: &[Id]) -> Result<Vec<Id>, Error> {
        for &variable in variables {
            self.check_variable(variable)?;
        }
        let rows = self.congruent_derivatives(&[id], Variables::Each(variables), |graph, ids| {
            ids.iter().map(|&id| graph.gradient_of_form(id, variables)).collect()
        })?;
        Ok(rows.into_iter().flatten().collect())
    }

    fn gradient_of_form(&mut self, id: Id, variables: &[Id]) -> Result<Vec<Id>, Error> {
        let root = self.adopt(id);
        let dependence = self.dependence(&[root], variables);
        if self.has_complex_moduli(&dependence) {
            return self.gradient_forward(root, variables);
        }
        match self.adjoints(root, &dependence, variables) {
            // a partial derivative by what is constant may have no value: asin(u) where u = sqrt(3/2)
            Err(_) => self.gradient_forward(root, variables),
            gradient => gradient,
        }
    }

    fn gradient_forward(&mut self, root: Id, variables: &[Id]) -> Result<Vec<Id>, Error> {
        variables.iter().map(|&variable| Ok(self.partial_tangents(&[root], variable)?[0])).collect()
    }

    /// Whether moduli or signs of what is complex depend on the variables: their derivatives are those by a variable.
    fn has_complex_moduli(&self, dependence: &Dependence) -> bool {
        dependence.order.iter().any(|&id| match self.view(id) {
            View::Function(Function::Abs | Function::Sign, args) => {
                dependence.is_active(id) && self.is_complex(args.get(0))
            }
            _ => false,
        })
    }

    fn adjoints(&mut self, root: Id, dependence: &Dependence, variables: &[Id]) -> Result<Vec<Id>, Error> {
        let mut contributions: FxHashMap<Id, Vec<(NumberId, Id)>> = FxHashMap::default();
        let mut result: FxHashMap<_, Id> = FxHashMap::default();
        let mut of_solutions: FxHashMap<Id, Vec<(u32, Id)>> = FxHashMap::default();
        contributions.insert(root, vec![(NumberId::ONE, Id::ONE)]);
        for &id in dependence.order.iter().rev() {
            if !dependence.is_active(id) {
                continue;
            }
            if let Some(adjoints) = of_solutions.remove(&id) {
                for (part, share) in self.system_adjoints(id, &adjoints)? {
                    if dependence.is_active(part) && share != Id::ZERO {
                        contributions.entry(part).or_default().push((NumberId::ONE, share));
                    }
                }
                continue;
            }
            let Some(terms) = contributions.remove(&id) else { continue };
            let adjoint = self.sum(&terms);
            if adjoint == Id::ZERO {
                continue;
            }
            if self.is_variable(id) {
                result.insert(self.value(id), adjoint);
            }
            if let View::Solution(system, index) = self.view(id) {
                of_solutions.entry(system).or_default().push((index, adjoint));
                continue;
            }
            for (k, child) in self.children(id).into_iter().enumerate() {
                if dependence.is_active(child) {
                    let (factor, partial) = self.partial(id, k)?;
                    let term = if partial == Id::ONE { adjoint } else { self.mul(partial, adjoint)? };
                    contributions.entry(child).or_default().push((factor, term));
                }
            }
        }
        Ok(variables.iter().map(|&v| result.get(&self.value(v)).copied().unwrap_or(Id::ZERO)).collect())
    }

    /// The Jacobian, row by row: partial derivatives, with respect to t, too. It is computed by rows in reverse mode if
    /// there are fewer expressions than variables, and otherwise by columns in forward mode; both visit only nodes that
    /// depend on the variables.
    ///
    /// # Errors
    /// If one of them is not a variable.
    pub fn jacobian(&mut self, ids: &[Id], variables: &[Id]) -> Result<Vec<Vec<Id>>, Error> {
        if ids.len() < variables.len() {
            return ids.iter().map(|&id| self.gradient(id, variables)).collect();
        }
        for &variable in variables {
            self.check_variable(variable)?;
        }
        self.congruent_derivatives(ids, Variables::Each(variables), |graph, ids| {
            graph.columns(ids, variables)
        })
    }

    /// The Jacobian by columns, in forward mode.
    fn columns(&mut self, ids: &[Id], variables: &[Id]) -> Result<Vec<Vec<Id>>, Error> {
        let ids: Vec<Id> = ids.iter().map(|&id| self.adopt(id)).collect();
        let dependence = self.dependence(&ids, variables);
        let mut rows = vec![vec![Id::ZERO; variables.len()]; ids.len()];
        for (j, &variable) in variables.iter().enumerate() {
            if self.is_complex(variable) {
                self.check_no_moduli(dependence.on(j))?;
            }
            let column = self.tangents(&ids, dependence.on(j), &mut |graph, id| {
                Ok(graph.same(id, variable).then_some(Id::ONE))
            })?;
            for (row, derivative) in rows.iter_mut().zip(column) {
                row[j] = derivative;
            }
        }
        Ok(rows)
    }
}

/// One entry in each row.
fn in_rows(ids: Vec<Id>) -> Vec<Vec<Id>> {
    ids.into_iter().map(|id| vec![id]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Assumption;

    #[test]
    fn forward_and_reverse_agree() -> Result<(), Error> {
        let g = &mut Graph::new();
        let (x, y) = (g.symbol("x", Assumption::Real), g.symbol("y", Assumption::Real));
        let sine = g.apply(Function::Sin, &[x])?;
        let product = g.mul(sine, y)?;
        let sum = g.add(product, x);
        let quotient = g.div(sum, y)?;
        let gradient = g.gradient(quotient, &[x, y])?;
        for (variable, derivative) in [x, y].into_iter().zip(gradient) {
            let forward = g.diff(quotient, variable)?;
            assert!(g.equal(forward, derivative));
        }
        Ok(())
    }

    /// q t has the partial derivative q and the total one q + q' t with respect to t.
    #[test]
    fn the_derivative_by_time_is_total_and_partial_ones_are_named_so() -> Result<(), Error> {
        let g = &mut Graph::new();
        let (q, v, t) = (g.time_function("q", 0)?, g.time_function("q", 1)?, g.time());
        let product = g.mul(q, t)?;
        let carried = g.mul(v, t)?;
        let total = g.add(q, carried);
        assert_eq!(g.diff(product, t)?, total);
        assert_eq!(g.partial_derivatives(&[product], t)?, [q]);
        assert_eq!(g.gradient(product, &[q, t])?, [t, q]);
        assert_eq!(g.jacobian(&[product, t], &[t])?, [[q], [Id::ONE]]);
        assert!(matches!(g.check_unambiguous(&[product], &[q, t]), Err(Error::TwoTimeDerivatives { .. })));
        assert!(g.check_unambiguous(&[product], &[q, v]).is_ok());
        assert!(g.check_unambiguous(&[t], &[q, t]).is_ok());
        Ok(())
    }

    #[test]
    fn a_coordinate_and_its_derivatives_are_linked_by_time() -> Result<(), Error> {
        let g = &mut Graph::new();
        let (x, v, a) = (g.time_function("x", 0)?, g.time_function("x", 1)?, g.time_function("x", 2)?);
        let square = g.mul(v, v)?;
        let energy = g.mul(square, x)?;
        assert_eq!(g.diff(energy, x)?, square);
        let power = g.time_derivative(energy)?;
        let (cube, force) = (g.mul(square, v)?, g.mul(x, v)?);
        let force = g.mul(force, a)?;
        let expected = g.sum(&[(NumberId::ONE, cube), (NumberId::ONE, force), (NumberId::ONE, force)]);
        assert!(g.equal(power, expected));
        Ok(())
    }
}
