//! Solutions of linear systems, by elimination in a field.

use std::sync::Arc;

use crate::graph::{Graph, Id};
use crate::value::{Element, Field, FieldId, Key, Number, Quadratic, fingerprint};

use super::node::in_hash_lanes;

impl Graph {
    /// The solution of a linear system in a field, drawn where the matrix is singular.
    pub(super) fn solution_in(&self, system: Id, field: FieldId) -> Arc<[Quadratic]> {
        if let Some(known) = self.lanes.borrow().solution(system, field) {
            return known;
        }
        let (matrix, right) = self.parts_of_system(system);
        let values =
            |ids: Vec<Id>| -> Vec<Quadratic> { ids.into_iter().map(|id| self.value_in(id, field)).collect() };
        let (matrix, right) = (values(matrix), values(right));
        let f = field.field();
        let solution: Arc<[Quadratic]> = eliminate(matrix, right.clone(), f)
            .unwrap_or_else(|| {
                // Zero is the minimum-norm solution for a right side of zeros.
                let nothing = right.iter().all(Quadratic::is_zero);
                let key = |k| Key::new("solution").word(k);
                let draw = |k| f.opaque(key(k), &[&self.value_in(system, field)]);
                let count = right.len() as u64;
                (0..count).map(|k| if nothing { f.number(&Number::integer(0)) } else { draw(k) }).collect()
            })
            .into();
        self.lanes.borrow_mut().insert_solution(system, field, Arc::clone(&solution));
        solution
    }

    /// The fingerprints of the components of a solution.
    pub(crate) fn solution_fingerprints(&self, system: Id) -> Vec<Element> {
        let [first, second] = FieldId::HASH.map(|field| {
            let (matrix, right) = self.parts_of_system(system);
            for id in matrix.into_iter().chain(right) {
                self.value_in(id, field);
            }
            self.solution_in(system, field)
        });
        first.iter().zip(second.iter()).map(|(a, b)| fingerprint([a, b])).collect()
    }

    /// The fingerprint of a linear system, before its node is made.
    pub(crate) fn system_fingerprint(&self, parts: &[Id]) -> Element {
        in_hash_lanes(|field| self.opaque_in(Key::new("linear system"), parts.iter().copied(), field))
    }
}

/// Gauss's elimination; `None` for a singular matrix.
fn eliminate(mut matrix: Vec<Quadratic>, mut right: Vec<Quadratic>, f: &Field) -> Option<Vec<Quadratic>> {
    let n = right.len();
    for column in 0..n {
        let pivot = (column..n).find(|&row| !matrix[row * n + column].is_zero())?;
        for k in 0..n {
            matrix.swap(pivot * n + k, column * n + k);
        }
        right.swap(pivot, column);
        let inverse = f.inverse(&matrix[column * n + column]);
        for row in (0..n).filter(|&row| row != column) {
            let factor = f.mul(&matrix[row * n + column], &inverse);
            if factor.is_zero() {
                continue;
            }
            for k in column..n {
                matrix[row * n + k] = f.sub(&matrix[row * n + k], &f.mul(&factor, &matrix[column * n + k]));
            }
            right[row] = f.sub(&right[row], &f.mul(&factor, &right[column]));
        }
        right[column] = f.mul(&right[column], &inverse);
        for k in column..n {
            matrix[column * n + k] = f.mul(&matrix[column * n + k], &inverse);
        }
    }
    Some(right)
}
