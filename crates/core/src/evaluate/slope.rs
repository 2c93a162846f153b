//! On which variables a value depends: a sweep of derivatives at the random point, from the roots to the leaves.
//!
//! The derivative of an expression by a variable is an expression, so its value at the random point is zero if it is
//! zero as mathematics, and hardly ever otherwise. One reverse sweep [Griewank & Walther 2008, sec. 3.2] gives the values of
//! all derivatives of a sum of expressions, each times a random number. What has no derivative here, such as a modulus,
//! a power with a variable exponent, or the solution of a linear system, has a random one for each argument, which depends
//! on the values alone. So a variable may seem to be needed where it isn't, but not the other way round.

use crate::graph::{Factors, Flags, Function, Graph, Id, Kind, NumberId, Terms, View, word};
use crate::interrupt::tick;
use crate::value::{FieldId, Key, Number, Quadratic, in_hash_lane};

const LANE: FieldId = FieldId::HASH[0];

/// The slopes of nodes by their places in the table, in pages that are made when they are needed.
///
/// Children come before their parents in the table, so the sweep goes through the places from the last one down.
struct Slopes {
    pages: Vec<Option<Box<[Option<Quadratic>; PAGE]>>>,
}

const PAGE: usize = 256;

impl Slopes {
    fn new(roots: &[Id]) -> Self {
        let last = roots.iter().map(|root| root.0 as usize).max().unwrap_or(0);
        let mut pages = Vec::new();
        pages.resize_with(last / PAGE + 1, || None);
        Self { pages }
    }

    fn add(&mut self, id: Id, slope: Quadratic) {
        let place = id.0 as usize;
        let page = self.pages[place / PAGE].get_or_insert_with(|| Box::new([const { None }; PAGE]));
        let known = &mut page[place % PAGE];
        *known = Some(match known.take() {
            Some(sum) => LANE.field().add(&sum, &slope),
            None => slope,
        });
    }
}

impl Graph {
    /// The symbols and functions of time below the roots on which no root depends by value, ordered by structure.
    #[must_use]
    pub fn idle_variables(&self, roots: &[Id]) -> Vec<Id> {
        let mut slopes = Slopes::new(roots);
        for (&root, number) in roots.iter().zip(0..) {
            if !self.is_constant(root) {
                slopes.add(root, LANE.draw(&Key::new("weight").word(number)));
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
        if idle.is_empty() {
            return idle; // as a rule
        }
        self.variables(roots).into_iter().filter(|id| idle.contains(id)).collect()
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
        let f = LANE.field();
        let mut add = |child: Id, own: &Quadratic| {
            if !self.is_constant(child) {
                slopes.add(child, f.mul(slope, own));
            }
        };
        match self.view(id) {
            View::Scale(factor, child) => add(child, &self.image(factor)),
            View::Product(factors) => self.slopes_of_product(factors, add),
            View::Function(function, args) => match self.slope_of_function(function, args.get(0), id) {
                Some(own) => add(args.get(0), &own),
                None => self.slopes_at_random(id, add),
            },
            _ => self.slopes_at_random(id, add),
        }
    }

    /// The value of a node: that in the table, as a rule.
    fn value_here(&self, id: Id) -> Quadratic {
        if self.flags(id).has(Flags::BRANCH) {
            self.value_in(id, LANE)
        } else {
            in_hash_lane(self.value(id), 0)
        }
    }

    fn image(&self, number: NumberId) -> Quadratic {
        in_hash_lane(self.number_value(number), 0)
    }

    fn slopes_of_sum(&self, terms: Terms<'_>, slope: &Quadratic, slopes: &mut Slopes) {
        let f = LANE.field();
        for (factor, child) in terms.iter() {
            if !self.is_constant(child) {
                let is_one = factor == NumberId::ONE;
                slopes.add(child, if is_one { slope.clone() } else { f.mul(slope, &self.image(factor)) });
            }
        }
    }

    fn slopes_of_product(&self, factors: Factors<'_>, mut add: impl FnMut(Id, &Quadratic)) {
        let f = LANE.field();
        let power = |base: Id, exponent: NumberId| {
            if exponent == NumberId::ONE {
                self.value_here(base)
            } else {
                self.power_in(base, self.get_number(exponent), LANE)
            }
        };
        for (k, (base, exponent)) in factors.iter().enumerate() {
            let mut slope = self.slope_of_power(base, exponent);
            for (other, (base, exponent)) in factors.iter().enumerate() {
                if other != k {
                    slope = f.mul(&slope, &power(base, exponent));
                }
            }
            add(base, &slope);
        }
    }

    /// The derivative of a power by its base.
    fn slope_of_power(&self, base: Id, exponent: NumberId) -> Quadratic {
        let f = LANE.field();
        if exponent == NumberId::ONE {
            return f.one();
        }
        let (value, number) = (self.value_here(base), self.get_number(exponent));
        let less = if number.is_integer() {
            f.power(&value, &number.add(&Number::integer(-1)))
        } else {
            f.div(&self.power_in(base, number, LANE), &value)
        };
        f.mul(&self.image(exponent), &less)
    }

    /// The derivative of a function of one argument, if it is known.
    fn slope_of_function(&self, function: Function, argument: Id, id: Id) -> Option<Quadratic> {
        let f = LANE.field();
        let at = |function| match self.known_function(function, argument) {
            Some(known) => self.value_here(known),
            None => self.function_in(function, &[argument], LANE),
        };
        let square = || f.power(&self.value_in(id, LANE), &Number::integer(2));
        Some(match function {
            Function::Sin => at(Function::Cos),
            Function::Cos => f.neg(&at(Function::Sin)),
            Function::Tan => f.add(&f.one(), &square()),
            Function::Exp => self.value_in(id, LANE),
            Function::Sinh => at(Function::Cosh),
            Function::Cosh => at(Function::Sinh),
            Function::Tanh => f.sub(&f.one(), &square()),
            Function::Log => f.inverse(&self.value_here(argument)),
            _ => return None,
        })
    }

    /// Random derivatives by all children, which depend on the value of the node alone.
    fn slopes_at_random(&self, id: Id, mut add: impl FnMut(Id, &Quadratic)) {
        let [first, second] = self.value(id).words();
        let mut children = Vec::new();
        self.push_children(id, &mut children);
        for (child, place) in children.into_iter().zip(0..) {
            add(child, &LANE.draw(&Key::new("slope").word(first).word(second).word(place)));
        }
    }
}
