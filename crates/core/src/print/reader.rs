//! From the graph to the reader's form.

use crate::graph::{Factors, Function, Graph, Id, Ids, Parity, Terms, View};
use crate::interrupt::tick;
use crate::value::Number;

use super::order;
use super::plan::{Piece, Plan, is_sign};
use super::tree::{Base, Sum, Term};
use super::usage::Usage;

/// Builds the trees of nodes, with names for the nodes that the plan names.
pub(super) struct Reader<'a> {
    graph: &'a Graph,
    plan: &'a Plan,
    usage: &'a Usage,
}

impl<'a> Reader<'a> {
    pub(super) fn new(graph: &'a Graph, plan: &'a Plan, usage: &'a Usage) -> Self {
        Self { graph, plan, usage }
    }

    /// The tree of a node: its name, if it has one.
    pub(super) fn expression(&self, id: Id) -> Sum {
        tick();
        let id = self.plan.written(id);
        match self.plan.name(id) {
            Some(name) => Sum::atom(Base::plain(name)),
            None => self.opened(id),
        }
    }

    /// The tree of a named quantity.
    pub(super) fn piece(&self, piece: &Piece) -> Sum {
        let Some(slice) = &piece.slice else { return self.opened(piece.id) };
        match self.graph.view(piece.id) {
            View::Sum(Terms(words)) => self.sum(Terms(&words[2 * slice.start..2 * slice.end])),
            View::Product(Factors(words)) => self.product(Factors(&words[2 * slice.start..2 * slice.end])),
            _ => self.opened(piece.id),
        }
    }

    fn opened(&self, id: Id) -> Sum {
        let slices = self.plan.slices(id);
        match (self.graph.view(id), slices) {
            (View::Sum(_), Some(slices)) => {
                Sum::new(slices.iter().flat_map(|slice| symbol(slice).terms).collect())
            }
            (_, Some(slices)) => {
                let mut product = Term::one();
                for slice in slices {
                    product.multiply(symbol(slice), &Number::integer(1));
                }
                product.into_sum()
            }
            (view, None) => self.view(view),
        }
    }

    fn view(&self, view: View<'_>) -> Sum {
        match view {
            View::Number(number) => Sum::number(self.graph.get_number(number).clone()),
            View::Pi => Sum::atom(Base::Pi),
            View::Time => Sum::atom(Base::Time),
            View::Symbol(name, assumption) => Sum::atom(Base::Symbol {
                name: name.to_owned(),
                assumption,
                explicit: self.plan.is_explicit(name, assumption),
                is_subtracted: self.usage.is_subtracted(name),
            }),
            View::TimeFunction(name, order, assumption) => Sum::atom(Base::TimeFunction {
                name: name.to_owned(),
                order,
                explicit: self.plan.is_ambiguous(name),
                mark: self.plan.mark(name, assumption),
                usage: self.usage.of(name),
            }),
            View::Application { name, args, orders } => Sum::atom(Base::Application {
                name: name.to_owned(),
                args: self.arguments(args),
                orders: orders.to_vec(),
            }),
            View::Scale(factor, child) => self.expression(child).times(self.graph.get_number(factor)),
            View::Sum(terms) => self.sum(terms),
            View::Product(factors) => self.product(factors),
            View::Function(function, args) => self.function(function, args),
            View::Solution(system, index) => self.solution(system, index),
            View::LinearSystem { .. } => Sum::atom(Base::plain("linear_system")),
        }
    }

    /// The tree of a function: of an odd or even one, the argument has the sign that reads best.
    fn function(&self, function: Function, args: Ids<'_>) -> Sum {
        let mut args = self.arguments(args);
        if matches!(function, Function::Min | Function::Max) {
            order::sort_sums(&mut args);
        }
        let mut sign = Number::integer(1);
        if let [arg] = &mut args[..]
            && function.parity() != Parity::Neither
            && arg.is_opposite_angle()
        {
            let opposite = Number::integer(-1);
            *arg = arg.clone().times(&opposite);
            if function.parity() == Parity::Odd {
                sign = opposite;
            }
        }
        Sum::atom(Base::Function(function, args)).times(&sign)
    }

    /// `linear_solution(i, a11, a12, ..., b1, b2, ...)`
    fn solution(&self, system: Id, index: u32) -> Sum {
        let index = Sum::number(Number::integer(i64::from(index)));
        let parts = self.graph.children(system).into_iter().map(|part| self.expression(part));
        let args: Vec<Sum> = std::iter::once(index).chain(parts).collect();
        let orders = vec![0; args.len()];
        Sum::atom(Base::Application { name: String::from("linear_solution"), args, orders })
    }

    fn arguments(&self, args: Ids<'_>) -> Vec<Sum> {
        args.iter().map(|arg| self.expression(arg)).collect()
    }

    /// Sums inside the sum are opened, however deep they nest.
    fn sum(&self, terms: Terms<'_>) -> Sum {
        let mut out = Vec::new();
        let mut open = vec![(Number::integer(1), terms)];
        while let Some((sign, terms)) = open.pop() {
            for (factor, node) in terms.iter() {
                let factor = self.graph.get_number(factor).mul(&sign);
                match self.graph.view(node) {
                    View::Sum(inner) if is_sign(&factor) && self.plan.is_open(node) => {
                        open.push((factor, inner));
                    }
                    _ => out.extend(self.expression(node).times(&factor).terms),
                }
            }
        }
        Sum::new(out)
    }

    /// Products inside the product are opened, however deep they nest.
    fn product(&self, factors: Factors<'_>) -> Sum {
        let mut out = Term::one();
        let mut open = vec![(Number::integer(1), factors)];
        while let Some((power, factors)) = open.pop() {
            for (base, exponent) in factors.iter() {
                let whole = self.graph.get_number(exponent).is_integer();
                let exponent = self.graph.get_number(exponent).mul(&power);
                match self.graph.view(base) {
                    View::Product(inner) if whole && self.plan.is_open(base) => open.push((exponent, inner)),
                    _ => out.multiply(self.expression(base), &exponent),
                }
            }
        }
        out.into_sum()
    }
}

fn symbol(piece: &Piece) -> Sum {
    Sum::atom(Base::plain(&piece.name))
}
