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
    /// The rows of an operation for some expressions, each equal to that for what is known to be equal to the expression.
    ///
    /// Only expressions with one of the flags are compared: the values of others follow all equalities by themselves.
    ///
    /// # Errors
    /// Those of the operation, if it fails for what is known to be equal, too.
    pub(super) fn congruent(
        &mut self,
        ids: &[Id],
        flags: Flags,
        operation: impl Fn(&mut Self, &[Id]) -> Result<Vec<Vec<Id>>, Error>,
    ) -> Result<Vec<Vec<Id>>, Error> {
        let rows = operation(self, ids);
        let stand_in = |id: Id| if self.flags(id).has(flags) { self.representative(id) } else { id };
        let stand_ins: Vec<Id> = ids.iter().map(|&id| stand_in(id)).collect();
        if stand_ins == ids {
            return rows;
        }
        // outside of the derivation in progress, which takes its own form for all forms of a value
        let classes = self.classes.take();
        let others = operation(self, &stand_ins);
        self.classes = classes;
        let Ok(others) = others else { return rows };
        Ok(match rows {
            Ok(rows) => rows.into_iter().zip(others).map(|(row, other)| self.agreed(row, other)).collect(),
            Err(_) => others.into_iter().map(|row| self.agreed(row.clone(), row)).collect(),
        })
    }

    /// A row of results where it equals another one, entry by entry; the other one elsewhere.
    fn agreed(&mut self, row: Vec<Id>, other: Vec<Id>) -> Vec<Id> {
        let mut chosen = |(id, other)| if self.equal(id, other) { id } else { self.adopt(other) };
        row.into_iter().zip(other).map(&mut chosen).collect()
    }

    /// The same for operations that have one result for each expression.
    ///
    /// # Errors
    /// Those of the operation, if it fails for what is known to be equal, too.
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
}
