//! What goes by form obeys the law: derivatives and substitutions of equal expressions are equal.
//!
//! A derivative follows the form of an expression, rule by rule. Two forms of one value give the same value, as far as the
//! lanes know all that the equality of the forms rests on. Where they don't, as at moduli of what may not be real or at
//! parts of pi that no lane has, the result for the representative counts: it is equal to the other one as mathematics.
//!
//! The results of both forms are compared, and the form of the result is that of what was asked for wherever they agree. So
//! texts don't depend on which form was met first, except where the law would fail.

use crate::error::Error;
use crate::graph::{Flags, Graph, Id};

impl Graph {
    /// The rows of derivatives of some expressions, each equal to that of what is known to be equal to the expression.
    ///
    /// Only what holds signs or roots is compared: the values of others follow all equalities by themselves.
    ///
    /// # Errors
    /// Those of the operation, if it fails for what is known to be equal, too.
    pub(super) fn congruent(
        &mut self,
        ids: &[Id],
        operation: impl Fn(&mut Self, &[Id]) -> Result<Vec<Vec<Id>>, Error>,
    ) -> Result<Vec<Vec<Id>>, Error> {
        let rows = operation(self, ids);
        let Some(stand_ins) = self.stand_ins(ids, Flags::BRANCH) else { return rows };
        let Ok(others) = self.outside_derivation(|graph| operation(graph, &stand_ins)) else { return rows };
        Ok(match rows {
            Ok(rows) => rows.into_iter().zip(others).map(|(row, other)| self.agreed(row, other)).collect(),
            Err(_) => others.into_iter().map(|row| self.agreed(row.clone(), row)).collect(),
        })
    }

    /// The same for operations that have one result for each expression.
    ///
    /// # Errors
    /// Those of the operation, if it fails for what is known to be equal, too.
    pub(super) fn congruent_each(
        &mut self,
        ids: &[Id],
        operation: impl Fn(&mut Self, &[Id]) -> Result<Vec<Id>, Error>,
    ) -> Result<Vec<Id>, Error> {
        let one_each = |graph: &mut Self, ids: &[Id]| {
            Ok(operation(graph, ids)?.into_iter().map(|id| vec![id]).collect())
        };
        Ok(self.congruent(ids, one_each)?.into_iter().flatten().collect())
    }

    /// The representatives of expressions that have one of the flags, and the others; `None` if all represent themselves.
    pub(super) fn stand_ins(&self, ids: &[Id], flags: Flags) -> Option<Vec<Id>> {
        let stand_in = |id: Id| if self.flags(id).has(flags) { self.representative(id) } else { id };
        let stand_ins: Vec<Id> = ids.iter().map(|&id| stand_in(id)).collect();
        (stand_ins != ids).then_some(stand_ins)
    }

    /// The result of an operation outside of the derivation in progress, which takes its own form for all forms of a value.
    pub(super) fn outside_derivation<T>(&mut self, operation: impl FnOnce(&mut Self) -> T) -> T {
        let classes = self.classes.take();
        let result = operation(self);
        self.classes = classes;
        result
    }

    /// A row of results where it equals another one, entry by entry; the other one elsewhere.
    fn agreed(&mut self, row: Vec<Id>, other: Vec<Id>) -> Vec<Id> {
        let mut chosen = |(id, other)| if self.equal(id, other) { id } else { self.adopt(other) };
        row.into_iter().zip(other).map(&mut chosen).collect()
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
