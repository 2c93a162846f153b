//! Derivatives and substitutions of equal expressions are equal.
//!
//! A derivative is found from the form of an expression, rule by rule. Two forms of one value have derivatives of one value,
//! as far as the lanes know the identities that make the forms equal. They do not know all of them: a root may not be real
//! in a lane, and no lane has an angle of pi/13. There, the result for the representative is taken instead, provided
//! that both results have the same real values in double precision.
//!
//! Wherever the lanes find both results equal, the result is that of the form that was asked for. So neither the text nor
//! the value of a result depends on which form was met first. At a jump, at a pole, and where an intermediate result is
//! not real, equal forms may have different values, and each keeps its own.

use crate::error::Error;
use crate::graph::{Assumption, Flags, Graph, Id, View};
use crate::tape::Evaluator;
use crate::value::Key;

/// The number of random points at which results are compared. Many are real only where variables are positive, or small.
const POINTS: u64 = 32;

/// The largest relative difference that is attributed to rounding.
const ROUNDING: f64 = 1e-6;

impl Graph {
    /// The rows of results of an operation, one for each expression; expressions that are equal have equal rows.
    ///
    /// Only expressions with one of the flags are checked: the lanes know the results of all others to be equal.
    ///
    /// # Errors
    /// Those of the operation.
    pub(super) fn congruent(
        &mut self,
        ids: &[Id],
        flags: Flags,
        operation: impl Fn(&mut Self, &[Id]) -> Result<Vec<Vec<Id>>, Error>,
    ) -> Result<Vec<Vec<Id>>, Error> {
        let rows = operation(self, ids)?;
        let stand_in = |id: Id| if self.flags(id).has(flags) { self.representative(id) } else { id };
        let stand_ins: Vec<Id> = ids.iter().map(|&id| stand_in(id)).collect();
        if stand_ins == ids {
            return Ok(rows);
        }
        // Outside of the derivation in progress, which would use its own form for all forms of a value.
        let classes = self.classes.take();
        let others = operation(self, &stand_ins);
        self.classes = classes;
        let Ok(others) = others else { return Ok(rows) };
        Ok(rows.into_iter().zip(others).map(|(row, other)| self.agreed(row, other)).collect())
    }

    /// The same for operations that have one result for each expression.
    ///
    /// # Errors
    /// Those of the operation.
    pub(super) fn congruent_each(
        &mut self,
        ids: &[Id],
        flags: Flags,
        operation: impl Fn(&mut Self, &[Id]) -> Result<Vec<Id>, Error>,
    ) -> Result<Vec<Id>, Error> {
        let one_each = |graph: &mut Self, ids: &[Id]| {
            Ok(operation(graph, ids)?.into_iter().map(|id| vec![id]).collect())
        };
        Ok(self.congruent(ids, flags, one_each)?.into_iter().flatten().collect())
    }

    /// A row of results. An entry that the lanes do not find equal to that of the other row, though both have the same real
    /// values, is replaced by it.
    fn agreed(&mut self, row: Vec<Id>, other: Vec<Id>) -> Vec<Id> {
        let mut chosen = |(id, other)| {
            let is_own = self.equal(id, other) || !self.agree_in_numbers(id, other);
            if is_own { id } else { self.adopt(other) }
        };
        row.into_iter().zip(other).map(&mut chosen).collect()
    }

    /// Whether two expressions have the same real values at random points: at each point both are real and equal, or neither
    /// is real; and both are real at one point at least.
    fn agree_in_numbers(&self, a: Id, b: Id) -> bool {
        let leaves = self.variables(&[a, b]);
        let [Ok(one), Ok(two)] = [a, b].map(|id| self.tape(&leaves, &[id])) else { return false };
        let [one, two] = [one, two].map(|tape| Evaluator::new(&tape));
        let mut are_same = false;
        for point in 0..POINTS {
            let inputs: Vec<f64> = leaves.iter().map(|&leaf| self.real_number_of(leaf, point)).collect();
            let [Ok(one), Ok(two)] = [&one, &two].map(|tape| tape.evaluate(&inputs)) else { continue };
            let (one, two) = (one[0], two[0]);
            let is_finite = one.is_finite();
            if is_finite != two.is_finite() || (one - two).abs() > ROUNDING * one.abs().max(two.abs()) {
                return false;
            }
            are_same |= is_finite;
        }
        are_same
    }

    /// Whether an expression is real at all random points, such as a length that is not known to be real by value.
    pub(super) fn is_real_in_numbers(&self, id: Id) -> bool {
        let leaves = self.variables(&[id]);
        let Ok(tape) = self.tape(&leaves, &[id]) else { return false };
        let evaluator = Evaluator::new(&tape);
        (0..POINTS).all(|point| {
            let inputs: Vec<f64> = leaves.iter().map(|&leaf| self.real_number_of(leaf, point)).collect();
            evaluator.evaluate(&inputs).is_ok_and(|values| values[0].is_finite())
        })
    }

    /// The value of a variable at a random point: at most two, and of either sign unless the variable is positive.
    fn real_number_of(&self, leaf: Id, point: u64) -> f64 {
        let [first, second] = self.value(leaf).words();
        let drawn = Key::new("real number").word(first).word(second).draw_word(point);
        let size = f64::from(1 + drawn % 1999) / 1000.0;
        let is_positive = matches!(self.view(leaf), View::Symbol(_, Assumption::Positive));
        if is_positive || (drawn / 1999).is_multiple_of(2) { size } else { -size }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Assumption, Classes, Function};
    use crate::value::Number;

    /// |1/(sqrt(y) + x)| and 1/|sqrt(y) + x|, whose sum is not real where y is negative.
    fn moduli(g: &mut Graph) -> Result<[Id; 2], Error> {
        let [x, y] = ["x", "y"].map(|name| g.symbol(name, Assumption::Real));
        let root = g.pow_number(y, &Number::rational(1, 2))?;
        let sum = g.add(root, x);
        let reciprocal = g.div(Id::ONE, sum)?;
        let one = g.apply(Function::Abs, &[reciprocal])?;
        let modulus = g.apply(Function::Abs, &[sum])?;
        Ok([one, g.div(Id::ONE, modulus)?])
    }

    #[test]
    fn derivatives_of_equals_are_equal() -> Result<(), Error> {
        for order in [[0, 1], [1, 0]] {
            let g = &mut Graph::new();
            let forms = moduli(g)?;
            assert!(g.equal(forms[0], forms[1]));
            let x = g.symbol("x", Assumption::Real);
            let [one, two] = order.map(|k| forms[k]);
            let slope = g.diff(one, x)?;
            g.enter(Box::<Classes>::default());
            let in_derivation = [g.diff(two, x)?, g.gradient(two, &[x])?[0], g.jacobian(&[two], &[x])?[0][0]];
            assert!(in_derivation.into_iter().all(|other| g.equal(slope, other)));
        }
        Ok(())
    }

    /// cos(pi x + 1) and 1 - 2 sin(pi x/2 + 1/2)^2 at x = 19/13: no lane has an angle of pi/13.
    #[test]
    fn substitutions_of_equals_are_equal() -> Result<(), Error> {
        let g = &mut Graph::new();
        let x = g.symbol("x", Assumption::Real);
        let turned = g.mul(Id::PI, x)?;
        let angle = g.add(turned, Id::ONE);
        let cosine = g.apply(Function::Cos, &[angle])?;
        let half = g.number_id(&Number::rational(1, 2));
        let half = g.scale(half, angle);
        let sine = g.apply(Function::Sin, &[half])?;
        let square = g.mul(sine, sine)?;
        let minus_two = g.number_id(&Number::integer(-2));
        let twice = g.scale(minus_two, square);
        let other = g.add(Id::ONE, twice);
        assert!(g.equal(cosine, other));
        let number = g.number(&Number::rational(19, 13));
        let [one, two] = [cosine, other].map(|form| g.substitute(&[form], &[(x, number)]).map(|ids| ids[0]));
        assert!(g.equal(one?, two?));
        Ok(())
    }
}
