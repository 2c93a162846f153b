//! Minors of a matrix: determinants by expansion; every minor is computed once, and nothing is divided.
//!
//! Row by row, the minors of the rows so far are kept by the set of their columns (a dynamic programme over
//! Laplace's expansion along the last row); zero minors drop out, so sparse matrices stay cheap.

use std::collections::BTreeMap;

use crate::error::Error;
use crate::graph::{Graph, Id, NumberId};

/// The most minors kept for one row: all those of 12 rows and columns.
const MOST_MINORS: usize = 1024;
/// Columns are members of a set of bits.
const MOST_COLUMNS: usize = 64;

/// A set of columns, a bit each.
type Columns = u64;

/// The set of the first n columns, of which [`Graph::minors`] takes no more than the set has bits.
pub(super) fn first_columns(n: usize) -> Columns {
    (0..n).fold(0, |set, column| set | 1 << column)
}

impl Graph {
    /// The minors of all rows that are not zero, by their columns.
    ///
    /// # Errors
    /// If there are too many.
    pub(super) fn minors(&mut self, rows: &[Vec<Id>]) -> Result<BTreeMap<Columns, Id>, Error> {
        let found = rows.iter().map(Vec::len).max().unwrap_or(0);
        if found > MOST_COLUMNS {
            return Err(Error::Limit { what: "columns of a determinant", limit: MOST_COLUMNS, found });
        }
        let mut minors = BTreeMap::from([(0, Id::ONE)]);
        for row in rows {
            minors = self.expand_along(row, &minors)?;
        }
        Ok(minors)
    }

    /// The minors with another row, from those without it.
    fn expand_along(
        &mut self,
        row: &[Id],
        minors: &BTreeMap<Columns, Id>,
    ) -> Result<BTreeMap<Columns, Id>, Error> {
        let mut terms: BTreeMap<Columns, Vec<(NumberId, Id)>> = BTreeMap::new();
        for (&columns, &minor) in minors {
            for (column, &entry) in row.iter().enumerate() {
                if entry == Id::ZERO || columns >> column & 1 == 1 {
                    continue;
                }
                let odd = (columns >> column).count_ones() % 2 == 1;
                let sign = if odd { NumberId::MINUS_ONE } else { NumberId::ONE };
                let product = self.mul(entry, minor)?;
                terms.entry(columns | 1 << column).or_default().push((sign, product));
            }
        }
        let found = terms.len();
        if found > MOST_MINORS {
            let what =
                "minors in the expansion of a determinant (give it numbers, or solve the system instead)";
            return Err(Error::Limit { what, limit: MOST_MINORS, found });
        }
        let sums = terms.into_iter().map(|(columns, terms)| (columns, self.sum(&terms)));
        Ok(sums.filter(|&(_, minor)| minor != Id::ZERO).collect())
    }

    /// The solution of a small system with a determinant that is not zero, by Cramer's rule.
    ///
    /// Each row ends with the right-hand side. The determinant is the only divisor, so the result is defined wherever
    /// the system has a unique solution: no pivot vanishes there.
    ///
    /// # Errors
    /// If the determinant is zero.
    pub(crate) fn cramer(&mut self, mut rows: Vec<Vec<Id>>) -> Result<Vec<Id>, Error> {
        let unknowns = rows.len();
        self.divide_rows(&mut rows)?;
        let contents = self.divide_columns(&mut rows)?;
        // Short rows first: fewer minors. The order of the equations does not change the solution.
        rows.sort_by_key(|row| row.iter().filter(|&&entry| entry != Id::ZERO).count());
        let minors = self.minors(&rows)?;
        let all = first_columns(unknowns + 1);
        let minor = |column: usize| minors.get(&(all & !(1 << column))).copied().unwrap_or(Id::ZERO);
        let mut solution = Vec::with_capacity(unknowns);
        for (column, content) in contents.into_iter().enumerate() {
            let factors = [
                (minor(column), NumberId::ONE),
                (minor(unknowns), NumberId::MINUS_ONE),
                (content, NumberId::MINUS_ONE),
            ];
            let quotient = self.product(&factors)?;
            // The right-hand side moves from the last column to the unknown's.
            let odd = (unknowns - 1 - column) % 2 == 1;
            solution.push(if odd { self.neg(quotient) } else { quotient });
        }
        Ok(solution)
    }
}
