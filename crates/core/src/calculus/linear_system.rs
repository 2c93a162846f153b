//! Derivatives of the solution of a linear system, where the rank of A is constant: `dx = A^-1 (db - dA x)`.

use rustc_hash::FxHashMap;

use crate::error::Error;
use crate::graph::{Graph, Id, NumberId, word};

impl Graph {
    /// The system of the derivative, dx = A^-1 (db - dA x); `Id::ZERO` if the derivative vanishes.
    pub(super) fn system_tangent(&mut self, id: Id, tangent: &FxHashMap<Id, Id>) -> Result<Id, Error> {
        let (matrix, right) = self.parts_of_system(id);
        let of = |id: &Id| tangent.get(id).copied().unwrap_or(Id::ZERO);
        let mut changes = Vec::with_capacity(right.len());
        for (row, entry) in matrix.chunks_exact(right.len()).zip(&right) {
            let mut terms = vec![(NumberId::ONE, of(entry))];
            for (column, coefficient) in (0..).zip(row) {
                let slope = of(coefficient);
                if slope != Id::ZERO {
                    let component = self.solution(id, column);
                    terms.push((NumberId::MINUS_ONE, self.mul(slope, component)?));
                }
            }
            changes.push(self.sum(&terms));
        }
        if changes.iter().all(|&change| change == Id::ZERO) {
            return Ok(Id::ZERO);
        }
        self.linear_system(&matrix, &changes)
    }

    /// The adjoints of a system's parts from those of its solution, x': with y = A^-T x', A gets -y x^T and b gets y.
    pub(super) fn system_adjoints(&mut self, id: Id, adjoints: &[(u32, Id)]) -> Result<Vec<(Id, Id)>, Error> {
        let (matrix, right) = self.parts_of_system(id);
        let n = right.len();
        let transposed: Vec<Id> = (0..n * n).map(|k| matrix[k % n * n + k / n]).collect();
        let mut collected = vec![Vec::new(); n];
        for &(index, adjoint) in adjoints {
            collected[index as usize].push((NumberId::ONE, adjoint));
        }
        let collected: Vec<Id> = collected.iter().map(|terms| self.sum(terms)).collect();
        let multipliers = self.linear_solve(&transposed, &collected)?;
        let mut shares = Vec::new();
        for (k, &entry) in matrix.iter().enumerate() {
            let component = self.solution(id, word(k % n));
            let product = self.mul(multipliers[k / n], component)?;
            shares.push((entry, self.neg(product)));
        }
        shares.extend(right.into_iter().zip(multipliers));
        Ok(shares)
    }
}
