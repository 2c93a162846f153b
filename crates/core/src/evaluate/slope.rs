//! On which variables a value depends: a sweep of derivatives at the random point, from the roots to the leaves.
//!
//! The derivative of an expression by a variable is an expression, so its value at the random point is zero if it is
//! zero as mathematics, and hardly ever otherwise. One reverse sweep [Griewank & Walther 2008, sec. 3.2] gives the values of
//! all derivatives of a sum of expressions, each times a random number. What has no derivative here, such as a modulus,
//! a power with a variable exponent, or the solution of a linear system, has a random one for each argument, which depends
//! on the values alone. So a variable may seem to be needed where it isn't, but not the other way round.
//!
//! In one lane, what holds signs is one branch of it: `k*max(0, x)` is zero there for one of the two signs of x, as if it
//! didn't hold k. So a variable of expressions with signs is idle if its slope is zero in each of the lanes.

use crate::graph::{Factors, Flags, Function, Graph, Id, Kind, NumberId, Terms, View, word};
use crate::interrupt::tick;
use crate::value::{FieldId, Key, Number, Quadratic, in_hash_lane};

/// The slopes of nodes in a lane by their places in the table, in pages that are made when they are needed.
///
/// Children come before their parents in the table, so the sweep goes through the places from the last one down.
struct Slopes {
    lane: FieldId,
    pages: Vec<Option<Box<[Option<Quadratic>; PAGE]>>>,
}

const PAGE: usize = 256;

impl Slopes {
    fn new(roots: &[Id], lane: FieldId) -> Self {
        let last = roots.iter().map(|root| root.0 as usize).max().unwrap_or(0);
        let mut pages = Vec::new();
        pages.resize_with(last / PAGE + 1, || None);
        Self { lane, pages }
    }

    fn add(&mut self, id: Id, slope: Quadratic) {
        let place = id.0 as usize;
        let page = self.pages[place / PAGE].get_or_insert_with(|| Box::new([const { None }; PAGE]));
        let known = &mut page[place % PAGE];
        *known = Some(match known.take() {
            Some(sum) => self.lane.field().add(&sum, &slope),
            None => slope,
        });
    }
}

impl Graph {
    /// The symbols and functions of time below the roots on which no root depends by value, ordered by structure.
    #[must_use]
    pub fn idle_variables(&self, roots: &[Id]) -> Vec<Id> {
        let mut idle = self.seemingly_idle_variables(roots);
        if self.have_branches(roots) {
            for lane in FieldId::others(0) {
                if idle.is_empty() {
                    break;
                }
                self.retain_idle(&mut idle, roots, lane);
            }
            self.lanes.borrow_mut().limit();
        }
        idle
    }

    /// Those that are idle in the hash lanes: all that are idle, and some others of roots that hold signs.
    #[must_use]
    pub fn seemingly_idle_variables(&self, roots: &[Id]) -> Vec<Id> {
        let mut idle = self.idle_in(roots, FieldId::HASH[0]);
        if !idle.is_empty() && self.have_branches(roots) {
            self.retain_idle(&mut idle, roots, FieldId::HASH[1]);
        }
        if idle.is_empty() {
            return idle; // as a rule
        }
        self.variables(roots).into_iter().filter(|id| idle.contains(id)).collect()
    }

    fn have_branches(&self, roots: &[Id]) -> bool {
        roots.iter().any(|&root| self.flags(root).has(Flags::BRANCH))
    }

    fn retain_idle(&self, idle: &mut Vec<Id>, roots: &[Id], lane: FieldId) {
        let here = self.idle_in(roots, lane);
        idle.retain(|id| here.contains(id));
    }

    /// The variables whose slopes are zero in a lane.
    fn idle_in(&self, roots: &[Id], lane: FieldId) -> Vec<Id> {
        let mut slopes = Slopes::new(roots, lane);
        for (&root, number) in roots.iter().zip(0..) {
            if !self.is_constant(root) {
                slopes.add(root, lane.draw(&Key::new("weight").word(number)));
            }
        }
        let mut idle = Vec::new();
        for number in (0..slopes.pages.len()).rev() {
            for slot in (0..PAGE).rev() {
                let Some(page) = &mut slopes.pages[number] else { break };
                let Some(slope) = page[slot].take() else { continue };
                let place = word(number * PAGE + slot);
                if self.is_idle(Id(place), &slope, &mut slopes) {
                    idle.push(Id(place));
                }
            }
        }
        idle
    }

    /// Whether a node is a variable whose slope is zero. Those of other nodes are passed on to their children.
    fn is_idle(&self, id: Id, slope: &Quadratic, slopes: &mut Slopes) -> bool {
        tick();
        match self.kind(id) {
            Kind::Symbol(_) | Kind::TimeFunction(_) => slope.is_zero(),
            _ => {
                self.pass_on(id, slope, slopes);
                false
            }
        }
    }

    /// Add the slope of a node, times its derivatives by its children, to their slopes.
    fn pass_on(&self, id: Id, slope: &Quadratic, slopes: &mut Slopes) {
        if let View::Sum(terms) = self.view(id) {
            return self.slopes_of_sum(terms, slope, slopes);
        }
        let lane = slopes.lane;
        let f = lane.field();
        let mut add = |child: Id, own: &Quadratic| {
            if !self.is_constant(child) {
                slopes.add(child, f.mul(slope, own));
            }
        };
        match self.view(id) {
            View::Scale(factor, child) => add(child, &self.image(factor, lane)),
            View::Product(factors) => self.slopes_of_product(factors, lane, add),
            View::Function(function, args) => match self.slope_of_function(function, args.get(0), id, lane) {
                Some(own) => add(args.get(0), &own),
                None => self.slopes_at_random(id, lane, add),
            },
            _ => self.slopes_at_random(id, lane, add),
        }
    }

    /// The value of a node: that in the table, as a rule.
    fn value_here(&self, id: Id, lane: FieldId) -> Quadratic {
        match lane.hash_lane() {
            Some(which) if !self.flags(id).has(Flags::BRANCH) => in_hash_lane(self.value(id), which),
            _ => self.value_in(id, lane),
        }
    }

    fn image(&self, number: NumberId, lane: FieldId) -> Quadratic {
        match lane.hash_lane() {
            Some(which) => in_hash_lane(self.number_value(number), which),
            None => lane.field().number(self.get_number(number)),
        }
    }

    fn slopes_of_sum(&self, terms: Terms<'_>, slope: &Quadratic, slopes: &mut Slopes) {
        let lane = slopes.lane;
        let f = lane.field();
        for (factor, child) in terms.iter() {
            if !self.is_constant(child) {
                let is_one = factor == NumberId::ONE;
                slopes
                    .add(child, if is_one { slope.clone() } else { f.mul(slope, &self.image(factor, lane)) });
            }
        }
    }

    fn slopes_of_product(&self, factors: Factors<'_>, lane: FieldId, mut add: impl FnMut(Id, &Quadratic)) {
        let f = lane.field();
        let power = |base: Id, exponent: NumberId| {
            if exponent == NumberId::ONE {
                self.value_here(base, lane)
            } else {
                self.power_in(base, self.get_number(exponent), lane)
            }
        };
        for (k, (base, exponent)) in factors.iter().enumerate() {
            let mut slope = self.slope_of_power(base, exponent, lane);
            for (other, (base, exponent)) in factors.iter().enumerate() {
                if other != k {
                    slope = f.mul(&slope, &power(base, exponent));
                }
            }
            add(base, &slope);
        }
    }

    /// The derivative of a power by its base.
    fn slope_of_power(&self, base: Id, exponent: NumberId, lane: FieldId) -> Quadratic {
        let f = lane.field();
        if exponent == NumberId::ONE {
            return f.one();
        }
        let (value, number) = (self.value_here(base, lane), self.get_number(exponent));
        let less = if number.is_integer() {
            f.power(&value, &number.add(&Number::integer(-1)))
        } else {
            f.div(&self.power_in(base, number, lane), &value)
        };
        f.mul(&self.image(exponent, lane), &less)
    }

    /// The derivative of a function of one argument, if it is known.
    fn slope_of_function(
        &self,
        function: Function,
        argument: Id,
        id: Id,
        lane: FieldId,
    ) -> Option<Quadratic> {
        let f = lane.field();
        let at = |function| match self.known_function(function, argument) {
            Some(known) => self.value_here(known, lane),
            None => self.function_in(function, &[argument], lane),
        };
        let square = || f.power(&self.value_in(id, lane), &Number::integer(2));
        Some(match function {
            Function::Sin => at(Function::Cos),
            Function::Cos => f.neg(&at(Function::Sin)),
            Function::Tan => f.add(&f.one(), &square()),
            Function::Exp => self.value_in(id, lane),
            Function::Sinh => at(Function::Cosh),
            Function::Cosh => at(Function::Sinh),
            Function::Tanh => f.sub(&f.one(), &square()),
            Function::Log => f.inverse(&self.value_here(argument, lane)),
            _ => return None,
        })
    }

    /// Random derivatives by all children, which depend on the value of the node alone.
    fn slopes_at_random(&self, id: Id, lane: FieldId, mut add: impl FnMut(Id, &Quadratic)) {
        let [first, second] = self.value(id).words();
        let mut key = Key::new("slope").word(first).word(second);
        if lane.hash_lane().is_none() {
            key = self.value_in(id, lane).words().iter().fold(key, |key, &word| key.word(word));
        }
        let mut children = Vec::new();
        self.push_children(id, &mut children);
        for (child, place) in children.into_iter().zip(0..) {
            add(child, &lane.draw(&key.word(place)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::graph::Assumption;

    #[test]
    fn a_variable_of_one_branch_is_not_idle() -> Result<(), Error> {
        let g = &mut Graph::new();
        let (k, a, b) = (
            g.symbol("k", Assumption::Real),
            g.symbol("a", Assumption::Real),
            g.symbol("b", Assumption::Real),
        );
        for name in 0..16 {
            let x = g.symbol(&format!("x{name}"), Assumption::Real);
            let size = g.apply(Function::Abs, &[x])?;
            let twice = g.add(x, size);
            let loads = g.mul(k, twice)?;
            assert_eq!(g.idle_variables(&[loads]), []);

            let (first, second, sum) = (g.mul(a, loads)?, g.mul(b, loads)?, g.add(a, b));
            let both = g.add(first, second);
            let mean = g.div(both, sum)?;
            let idle = g.idle_variables(&[mean]);
            assert!(idle.len() == 2 && idle.contains(&a) && idle.contains(&b), "{idle:?}");
        }
        Ok(())
    }
}
