//! Linear systems that are solved at run time: x = A^-1 b as nodes.
//!
//! No symbolic pivot ever divides by zero: the numbers are eliminated with pivoting when they are known, and the
//! minimum-norm solution is taken where A is singular. At the random point the system is solved exactly, so a solution
//! equals whatever else has its value. The rules of differentiation hold where the rank of A is constant:
//! `dx = A^-1 (db - dA x)`.

use crate::error::Error;
use crate::graph::{Flags, Graph, Id, Kind, LONGEST, View, word};
use crate::value::Element;

/// Whether a linear system of n rows is small enough for a node.
///
/// # Errors
/// If it is too large.
pub fn check_rows(n: usize) -> Result<(), Error> {
    let found = n.saturating_mul(n.saturating_add(1));
    if found <= LONGEST {
        return Ok(());
    }
    Err(Error::Limit { what: "entries of a linear system", limit: LONGEST, found })
}

impl Graph {
    /// The solution of A x = b, given the matrix row by row.
    ///
    /// # Errors
    /// If the matrix is not square, its rows are not as many as those of the right side, or it is too large.
    pub fn linear_solve(&mut self, matrix: &[Id], right: &[Id]) -> Result<Vec<Id>, Error> {
        let system = self.linear_system(matrix, right)?;
        let components = self.components(system, right.len());
        let is_number = |id: &Id| matches!(self.view(*id), View::Number(_));
        let known: Vec<Option<Id>> = components.iter().map(|&id| is_number(&id).then_some(id)).collect();
        if known.iter().all(Option::is_none) || known.iter().all(Option::is_some) {
            return Ok(components);
        }
        let rest = self.rest_of_system(matrix, right, &known)?;
        let others = self.components(rest, right.len());
        let are_same = components.iter().zip(&others).all(|(&a, &b)| self.same(a, b));
        Ok(if are_same { others } else { components })
    }

    fn components(&mut self, system: Id, count: usize) -> Vec<Id> {
        (0..word(count)).map(|index| self.solution(system, index)).collect()
    }

    /// The system with numbers for the components that are known, so that its minimum-norm solution, where the matrix
    /// is singular, has these numbers, too.
    ///
    /// The equation of a known component becomes that number: its former equation follows from the others.
    fn rest_of_system(&mut self, matrix: &[Id], right: &[Id], known: &[Option<Id>]) -> Result<Id, Error> {
        let n = right.len();
        let (mut matrix, mut right) = (matrix.to_vec(), right.to_vec());
        for (j, value) in known.iter().enumerate().filter_map(|(j, value)| value.map(|value| (j, value))) {
            for i in (0..n).filter(|&i| i != j) {
                let share = self.mul(matrix[i * n + j], value)?;
                let opposite = self.neg(share);
                right[i] = self.add(right[i], opposite);
                matrix[i * n + j] = Id::ZERO;
                matrix[j * n + i] = Id::ZERO;
            }
            (matrix[j * n + j], right[j]) = (Id::ONE, value);
        }
        self.linear_system(&matrix, &right)
    }

    /// The node of a linear system; its parts are those of the matrix and then those of the right side.
    pub(crate) fn linear_system(&mut self, matrix: &[Id], right: &[Id]) -> Result<Id, Error> {
        let n = right.len();
        if matrix.len() != n * n {
            let shape = (matrix.len().checked_div(n).unwrap_or(0), n);
            return Err(Error::Shape { operation: "linear_solve", left: shape, right: (n, 1) });
        }
        check_rows(n)?;
        let parts: Vec<Id> = matrix.iter().chain(right).map(|&id| self.adopt(id)).collect();
        let flags = self.joined_flags(parts.iter().copied());
        let words: Vec<u32> = parts.iter().map(|id| id.0).collect();
        Ok(self.finish(Kind::LinearSystem, flags, &words, self.system_fingerprint(&parts)))
    }

    /// A component of the solution of a linear system.
    pub(crate) fn solution(&mut self, system: Id, index: u32) -> Id {
        let value = self.solution_value(system, index as usize);
        let flags = self.flags(system);
        self.finish(Kind::Solution, flags, &[system.0, index], value)
    }

    fn solution_value(&mut self, system: Id, index: usize) -> Element {
        if let Some(values) = self.solutions.get(&system) {
            return values[index];
        }
        let values = match self.plain_solution(system) {
            Some(values) => values,
            None => self.solution_fingerprints(system),
        };
        let value = values[index];
        self.solutions.insert(system, values);
        value
    }

    /// The values of a solution without signs and roots; `None` for a singular matrix.
    pub(crate) fn plain_solution(&self, system: Id) -> Option<Vec<Element>> {
        if self.flags(system).has(Flags::BRANCH) {
            return None;
        }
        let (matrix, right) = self.parts_of_system(system);
        let values_of = |ids: &[Id]| -> Vec<Element> { ids.iter().map(|&id| self.value(id)).collect() };
        eliminate(values_of(&matrix), values_of(&right))
    }

    /// The matrix of a linear system, row by row, and its right side.
    pub(crate) fn parts_of_system(&self, id: Id) -> (Vec<Id>, Vec<Id>) {
        let View::LinearSystem { matrix, right } = self.view(id) else {
            unreachable!("a solution is that of a linear system");
        };
        (matrix.iter().collect(), right.iter().collect())
    }
}

/// Gauss's elimination in the field; `None` for a singular matrix.
fn eliminate(mut matrix: Vec<Element>, mut right: Vec<Element>) -> Option<Vec<Element>> {
    let n = right.len();
    for column in 0..n {
        let pivot = (column..n).find(|&row| !matrix[row * n + column].is_singular())?;
        for k in 0..n {
            matrix.swap(pivot * n + k, column * n + k);
        }
        right.swap(pivot, column);
        let inverse = matrix[column * n + column].inverse();
        for row in (0..n).filter(|&row| row != column) {
            let factor = matrix[row * n + column] * inverse;
            if factor.is_zero() {
                continue;
            }
            for k in column..n {
                matrix[row * n + k] = matrix[row * n + k] - factor * matrix[column * n + k];
            }
            right[row] = right[row] - factor * right[column];
        }
        right[column] = right[column] * inverse;
        for k in column..n {
            matrix[column * n + k] = matrix[column * n + k] * inverse;
        }
    }
    Some(right)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Assumption;

    fn symbols(g: &mut Graph, names: &str) -> Vec<Id> {
        names.split(' ').map(|name| g.symbol(name, Assumption::Real)).collect()
    }

    #[test]
    fn a_solution_satisfies_its_system_by_value() -> Result<(), Error> {
        let g = &mut Graph::new();
        let (matrix, right) = (symbols(g, "a b c d"), symbols(g, "e f"));
        let x = g.linear_solve(&matrix, &right)?;
        for (row, &entry) in matrix.chunks_exact(2).zip(&right) {
            let (first, second) = (g.mul(row[0], x[0])?, g.mul(row[1], x[1])?);
            let sum = g.add(first, second);
            assert_eq!(g.sub(sum, entry), Id::ZERO);
        }
        Ok(())
    }

    #[test]
    fn forward_and_reverse_derivatives_agree_with_cramer() -> Result<(), Error> {
        let g = &mut Graph::new();
        let all = symbols(g, "a b c d e f");
        let x = g.linear_solve(&all[..4], &all[4..])?;
        let (ad, bc) = (g.mul(all[0], all[3])?, g.mul(all[1], all[2])?);
        let (ed, bf) = (g.mul(all[4], all[3])?, g.mul(all[1], all[5])?);
        let (numerator, determinant) = (g.sub(ed, bf), g.sub(ad, bc));
        let cramer = g.div(numerator, determinant)?;
        assert!(g.equal(x[0], cramer));
        let gradient = g.gradient(x[0], &all)?;
        for (&variable, reverse) in all.iter().zip(gradient) {
            let expected = g.diff(cramer, variable)?;
            let forward = g.diff(x[0], variable)?;
            assert!(g.equal(forward, expected) && g.equal(reverse, expected));
        }
        Ok(())
    }

    #[test]
    fn a_singular_system_is_opaque() -> Result<(), Error> {
        let g = &mut Graph::new();
        let all = symbols(g, "a b e");
        let x = g.linear_solve(&[all[0], all[1], all[0], all[1]], &[all[2], all[2]])?;
        assert!(g.as_number(x[0]).is_none());
        let nothing = g.linear_solve(&[all[0], all[1], all[0], all[1]], &[Id::ZERO, Id::ZERO])?;
        assert_eq!(nothing, [Id::ZERO, Id::ZERO]);
        Ok(())
    }
}
