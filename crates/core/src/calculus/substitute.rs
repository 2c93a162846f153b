//! Simultaneous substitution by value: every node that equals a target is replaced.

use rustc_hash::FxHashMap;

use crate::error::Error;
use crate::graph::{ByValue, Flags, Function, Graph, Id, Kind, View};

impl Graph {
    /// The expressions with every target replaced, all at once.
    ///
    /// A replacement of x(t) also replaces x', x'', ... by its time derivatives, unless these have
    /// replacements of their own; a replacement of t turns x(t) into x(value). Doubles that stand for multiples
    /// of pi become such multiples where they are added to other terms of a sine, cosine or tangent.
    ///
    /// # Errors
    /// If a target is a number, or a divisor becomes zero.
    pub fn substitute(&mut self, roots: &[Id], pairs: &[(Id, Id)]) -> Result<Vec<Id>, Error> {
        let mut targets: ByValue<Id> = ByValue::default();
        let mut time = None;
        for &(target, replacement) in pairs {
            match self.kind(target) {
                Kind::Number => return Err(Error::NotAVariable(self.to_quotation(target))),
                Kind::Time => time = Some(replacement),
                _ => {}
            }
            targets.push(self.value(target), target, replacement);
        }
        let uncertain = Flags::BRANCH.with(Flags::INVERSE);
        self.congruent_values(roots, uncertain, |graph, roots| graph.replace(roots, &targets, time))
    }

    fn replace(&mut self, roots: &[Id], targets: &ByValue<Id>, time: Option<Id>) -> Result<Vec<Id>, Error> {
        let order = self.post_order_where(roots, |_| true);
        let mut done: FxHashMap<Id, Id> = FxHashMap::default();
        for id in order {
            let replaced = match self.find(targets, id) {
                Some(&replacement) => replacement,
                None => self.substitute_in(id, targets, time, &done)?,
            };
            done.insert(id, replaced);
        }
        Ok(roots.iter().map(|id| done[id]).collect())
    }

    fn substitute_in(
        &mut self,
        id: Id,
        targets: &ByValue<Id>,
        time: Option<Id>,
        done: &FxHashMap<Id, Id>,
    ) -> Result<Id, Error> {
        if let View::TimeFunction(name, order, assumption) = self.view(id) {
            let name = name.to_owned();
            for lower in (0..order).rev() {
                let base = self.derivative_of_function(&name, lower, assumption)?;
                if let Some(&replacement) = self.find(targets, base) {
                    let mut derivative = replacement;
                    for _ in lower..order {
                        derivative = self.time_derivative(derivative)?;
                    }
                    return Ok(derivative);
                }
            }
            return time.map_or(Ok(id), |t| self.application(&name, &[t], &[order]));
        }
        if self.children(id).iter().all(|child| done[child] == *child) {
            return Ok(id);
        }
        if let View::Function(function @ (Function::Sin | Function::Cos | Function::Tan), args) =
            self.view(id)
        {
            let argument = self.angle_beside_others(done[&args.get(0)]);
            return self.apply(function, &[argument]);
        }
        self.rebuild(id, &|_, child| done[&child])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Assumption;
    use crate::value::Number;

    #[test]
    fn derivatives_follow_their_coordinate() -> Result<(), Error> {
        let g = &mut Graph::new();
        let (x, v, y) = (g.time_function("x", 0)?, g.time_function("x", 1)?, g.time_function("y", 0)?);
        let sum = g.add(x, v);
        let square = g.mul(y, y)?;
        let replaced = g.substitute(&[sum], &[(x, square)])?[0];
        let rate = g.time_derivative(square)?;
        let expected = g.add(square, rate);
        assert!(g.equal(replaced, expected));
        Ok(())
    }

    #[test]
    fn substitution_is_simultaneous() -> Result<(), Error> {
        let g = &mut Graph::new();
        let (x, y) = (g.time_function("x", 0)?, g.time_function("y", 0)?);
        let quotient = g.div(x, y)?;
        let swapped = g.substitute(&[quotient], &[(x, y), (y, x)])?[0];
        assert_eq!(swapped, g.div(y, x)?);
        Ok(())
    }

    /// x > 0 and the opposite of x < 0 are equal but at zero, and |s|^2 z and (1 - x^2) z, with s = sqrt(1 - x^2), within
    /// [-1, 1]: elsewhere each is what it says, whichever was met first.
    #[test]
    fn forms_keep_their_values_at_jumps_and_beside_the_real_line() -> Result<(), Error> {
        let g = &mut Graph::new();
        let x = g.symbol("x", Assumption::Real);
        let above = g.apply(Function::Piecewise, &[Id::ONE, x, Id::ZERO])?;
        let opposite = g.neg(x);
        let not_below = g.apply(Function::Piecewise, &[Id::ONE, opposite, Id::ZERO])?;
        let not_below = g.sub(Id::ONE, not_below);
        for form in [above, not_below] {
            g.apply(Function::Sin, &[form])?; // so that one represents the other
        }
        assert!(g.equal(above, not_below));
        let at_zero = g.substitute(&[above, not_below], &[(x, Id::ZERO)])?;
        assert_eq!(at_zero, [Id::ZERO, Id::ONE]);

        let angle = g.apply(Function::Asin, &[x])?;
        let cosine = g.apply(Function::Cos, &[angle])?;
        g.apply(Function::Abs, &[cosine])?;
        let square = g.mul(x, x)?;
        let square = g.sub(Id::ONE, square);
        let root = g.pow_number(square, &Number::rational(1, 2))?;
        let modulus = g.apply(Function::Abs, &[root])?;
        let z = g.symbol("z", Assumption::Real);
        let square = g.mul(modulus, modulus)?;
        let product = g.mul(square, z)?;
        let two = g.number(&Number::integer(2));
        let three = g.number_id(&Number::integer(3));
        assert_eq!(g.substitute(&[product], &[(x, two)])?[0], g.scale(three, z));
        Ok(())
    }
}
