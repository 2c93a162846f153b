//! Derivatives and substitutions of equal expressions are equal.
//!
//! A derivative is found from the form of an expression, rule by rule. Two forms of one value have derivatives of one value,
//! as far as the lanes know the identities that make the forms equal. They do not know all of them: a root may not be real
//! in a lane, and no lane has an angle of pi/13. There, the result for the representative is taken instead. A derivative is
//! a function of the value alone, so that is one of the form that was asked for, unless double precision shows another number
//! where this form is real. A substitution may meet a jump, so both results must have the same real values.
//!
//! Wherever the lanes find both results equal, the result is that of the form that was asked for. So neither the text nor
//! the value of a result depends on which form was met first. At a jump, at a pole, and where an intermediate result is
//! not real, equal forms may have different values, and each keeps its own.

use crate::error::Error;
use crate::graph::{Assumption, Flags, Graph, Id, View};
use crate::tape::Evaluator;
use crate::value::Key;

use super::vanishing::Variables;

/// The number of random points at which results are compared. Many are real only where variables are positive, or small.
const POINTS: u64 = 32;

/// The largest relative difference that is attributed to rounding.
const ROUNDING: f64 = 1e-6;

/// Larger values are those at a pole.
const POLE: f64 = 1e12;

/// Whether the result for another form of an expression may take the place of its own result.
type Judge = fn(&Graph, of: Id, own: Id, other: Id) -> bool;

impl Graph {
    /// The rows of derivatives of expressions; expressions that are equal have equal rows.
    ///
    /// Only expressions with signs or roots are checked: the lanes know the derivatives of all others to be equal.
    ///
    /// # Errors
    /// Those of the operation.
    pub(super) fn congruent_derivatives(
        &mut self,
        ids: &[Id],
        variables: Variables<'_>,
        operation: impl Fn(&mut Self, &[Id]) -> Result<Vec<Vec<Id>>, Error>,
    ) -> Result<Vec<Vec<Id>>, Error> {
        let operation = |graph: &mut Self, ids: &[Id]| {
            let mut rows = operation(graph, ids)?;
            for (row, &id) in rows.iter_mut().zip(ids) {
                if graph.flags(id).has(Flags::BRANCH) {
                    graph.settle_vanishing(id, variables, row);
                }
            }
            Ok(rows)
        };
        self.congruent(ids, Flags::BRANCH, Self::is_no_other_derivative, operation)
    }

    /// The results of an operation that has one value for each expression; expressions that are equal have equal results.
    ///
    /// Only expressions with one of the flags are checked: the lanes know the results of all others to be equal.
    ///
    /// # Errors
    /// Those of the operation.
    pub(super) fn congruent_values(
        &mut self,
        ids: &[Id],
        flags: Flags,
        operation: impl Fn(&mut Self, &[Id]) -> Result<Vec<Id>, Error>,
    ) -> Result<Vec<Id>, Error> {
        let one_each = |graph: &mut Self, ids: &[Id]| {
            Ok(operation(graph, ids)?.into_iter().map(|id| vec![id]).collect())
        };
        let judge: Judge = |graph, _, own, other| graph.agree_in_numbers(own, other);
        Ok(self.congruent(ids, flags, judge, one_each)?.concat())
    }

    fn congruent(
        &mut self,
        ids: &[Id],
        flags: Flags,
        may_replace: Judge,
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
        let mut chosen = |id, (own, other)| {
            let is_own = self.equal(own, other) || !may_replace(self, id, own, other);
            if is_own { own } else { self.adopt(other) }
        };
        let pairs = ids.iter().zip(rows.into_iter().zip(others));
        Ok(pairs
            .map(|(&id, (own, other))| own.into_iter().zip(other).map(|pair| chosen(id, pair)).collect())
            .collect())
    }

    /// Whether a derivative of an expression, and one of another form of it, are nowhere seen to be different numbers: at no
    /// random point where the expression is real and has no pole. What cancels is small beside the expression.
    fn is_no_other_derivative(&self, of: Id, own: Id, other: Id) -> bool {
        self.numbers_at_points(&[of, own, other]).is_some_and(|mut points| {
            points.all(|values| {
                let [of, own, other] = [values[0], values[1], values[2]];
                let size = of.abs() + own.abs().max(other.abs());
                let has_value = of.abs() < POLE && own.is_finite();
                !has_value || (own - other).abs() <= ROUNDING * size
            })
        })
    }

    /// Whether two expressions have the same real values at random points: at each point both are real and equal, or neither
    /// is real; and both are real at one point at least.
    fn agree_in_numbers(&self, a: Id, b: Id) -> bool {
        let Some(points) = self.numbers_at_points(&[a, b]) else { return false };
        let mut are_same = false;
        for values in points {
            let [a, b] = [values[0], values[1]];
            if a.is_finite() != b.is_finite() || (a - b).abs() > ROUNDING * a.abs().max(b.abs()) {
                return false;
            }
            are_same |= a.is_finite();
        }
        are_same
    }

    /// Whether an expression is real at all random points, such as a length that is not known to be real by value.
    pub(super) fn is_real_in_numbers(&self, id: Id) -> bool {
        self.numbers_at_points(&[id]).is_some_and(|mut points| points.all(|values| values[0].is_finite()))
    }

    /// The values of expressions at random points, which are no finite numbers where they are not real.
    pub(super) fn numbers_at_points<'a>(
        &'a self,
        ids: &[Id],
    ) -> Option<impl Iterator<Item = Vec<f64>> + use<'a>> {
        let (leaves, count) = (self.variables(ids), ids.len());
        let evaluator = Evaluator::new(&self.tape(&leaves, ids).ok()?);
        Some((0..POINTS).map(move |point| {
            let inputs: Vec<f64> = leaves.iter().map(|&leaf| self.real_number_of(leaf, point)).collect();
            evaluator.evaluate(&inputs).unwrap_or_else(|_| vec![f64::NAN; count])
        }))
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

    /// tan(Max(pi/2, x)) and sin/cos of it, at the pole for x < pi/2, where the lanes know the values of neither derivative.
    #[test]
    fn derivatives_at_a_pole_are_equal() -> Result<(), Error> {
        for is_tangent_first in [true, false] {
            let g = &mut Graph::new();
            let x = g.symbol("x", Assumption::Real);
            let half = g.number_id(&Number::rational(1, 2));
            let quarter = g.scale(half, Id::PI);
            let angle = g.apply(Function::Max, &[quarter, x])?;
            let [tan, sin, cos] = [Function::Tan, Function::Sin, Function::Cos].map(|f| g.apply(f, &[angle]));
            let (tan, quotient) = (tan?, g.div(sin?, cos?)?);
            let [one, two] = if is_tangent_first { [tan, quotient] } else { [quotient, tan] };
            let slopes = [g.diff(one, x)?, g.diff(two, x)?];
            assert!(g.equal(slopes[0], slopes[1]), "{} {}", g.to_text(slopes[0]), g.to_text(slopes[1]));
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
