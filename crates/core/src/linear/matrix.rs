//! Dense matrices of expressions.

use crate::error::Error;
use crate::graph::{Graph, Id, NumberId};

use super::minor::first_columns;
use super::rank::Equation;

/// The largest matrix that is inverted in symbols.
const LARGEST_INVERSE: usize = 6;

/// The most rows, columns, and entries of a product; factors without entries may have a product of any size.
const MOST_ROWS: usize = 1 << 20;
const MOST_ENTRIES: usize = 1 << 24;

/// A matrix, its entries row by row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Matrix {
    rows: usize,
    columns: usize,
    entries: Vec<Id>,
}

impl Matrix {
    /// The matrix of these entries, row by row.
    ///
    /// # Errors
    /// If their number is not rows * columns, or there are too many rows or columns.
    pub fn new(rows: usize, columns: usize, entries: Vec<Id>) -> Result<Self, Error> {
        if rows.checked_mul(columns) == Some(entries.len()) {
            let found = rows.max(columns);
            if found > MOST_ROWS {
                return Err(Error::Limit { what: "rows or columns of a matrix", limit: MOST_ROWS, found });
            }
            return Ok(Self { rows, columns, entries });
        }
        let (left, right) = ((1, entries.len()), (rows, columns));
        Err(Error::Shape { operation: "arrangement", left, right })
    }

    /// The identity.
    #[must_use]
    pub fn identity(size: usize) -> Self {
        let entry = |i: usize| if i.is_multiple_of(size + 1) { Id::ONE } else { Id::ZERO };
        Self { rows: size, columns: size, entries: (0..size * size).map(entry).collect() }
    }

    /// Rows and columns.
    #[must_use]
    pub const fn shape(&self) -> (usize, usize) {
        (self.rows, self.columns)
    }

    /// All entries, row by row.
    #[must_use]
    pub fn entries(&self) -> &[Id] {
        &self.entries
    }

    /// The entry in a row and a column, counted from 0.
    #[must_use]
    pub fn at(&self, row: usize, column: usize) -> Id {
        self.entries[row * self.columns + column]
    }

    /// The transpose.
    #[must_use]
    pub fn transpose(&self) -> Self {
        let columns = (0..self.columns).flat_map(|column| (0..self.rows).map(move |row| (row, column)));
        let entries = columns.map(|(row, column)| self.at(row, column)).collect();
        Self { rows: self.columns, columns: self.rows, entries }
    }

    fn row(&self, row: usize) -> &[Id] {
        &self.entries[row * self.columns..(row + 1) * self.columns]
    }

    /// The entries of a row other than zero, with their columns.
    fn filled(&self, row: usize) -> Vec<(usize, Id)> {
        let entries = self.row(row).iter().copied().enumerate();
        entries.filter(|&(_, entry)| entry != Id::ZERO).collect()
    }

    fn check_square(&self, operation: &'static str) -> Result<(), Error> {
        if self.rows == self.columns {
            return Ok(());
        }
        Err(Error::Shape { operation, left: self.shape(), right: (self.rows, self.rows) })
    }
}

impl Graph {
    /// The rank of a matrix at almost every point: the rank of its values at the random point.
    pub fn matrix_rank(&self, matrix: &Matrix) -> usize {
        let rows = matrix.entries.chunks(matrix.columns.max(1));
        let equations: Vec<Equation> = rows.map(|row| row.iter().copied().enumerate().collect()).collect();
        self.rank_of(&equations, matrix.columns).independent.len()
    }

    /// The product of two matrices.
    ///
    /// # Errors
    /// If the shapes do not match, or the product is too large.
    pub fn matrix_product(&mut self, a: &Matrix, b: &Matrix) -> Result<Matrix, Error> {
        if a.columns != b.rows {
            return Err(Error::Shape { operation: "product", left: a.shape(), right: b.shape() });
        }
        let found = a.rows * b.columns; // of two numbers up to 2^20
        if found > MOST_ENTRIES {
            return Err(Error::Limit { what: "entries of a matrix", limit: MOST_ENTRIES, found });
        }
        let mut entries = Vec::with_capacity(a.rows * b.columns);
        let filled: Vec<Vec<(usize, Id)>> = (0..b.rows).map(|row| b.filled(row)).collect();
        for row in 0..a.rows {
            let mut factors: Vec<Vec<(Id, Id)>> = vec![Vec::new(); b.columns];
            for (k, left) in a.filled(row) {
                for &(column, right) in &filled[k] {
                    factors[column].push((left, right));
                }
            }
            for pairs in factors {
                let mut terms = Vec::with_capacity(pairs.len());
                for (left, right) in pairs {
                    terms.push((NumberId::ONE, self.mul(left, right)?));
                }
                entries.push(self.sum(&terms));
            }
        }
        Matrix::new(a.rows, b.columns, entries)
    }

    /// The determinant, by cofactors.
    ///
    /// # Errors
    /// If the matrix is not square, or the expansion has too many minors.
    pub fn determinant(&mut self, matrix: &Matrix) -> Result<Id, Error> {
        matrix.check_square("determinant")?;
        let rows: Vec<Vec<Id>> = (0..matrix.rows).map(|row| matrix.row(row).to_vec()).collect();
        // Minors that are zero drop out.
        Ok(self.minors(&rows)?.get(&first_columns(matrix.rows)).copied().unwrap_or(Id::ZERO))
    }

    /// The inverse, by cofactors over the determinant.
    ///
    /// # Errors
    /// If the matrix is not square, singular, or larger than 6x6.
    pub fn inverse(&mut self, matrix: &Matrix) -> Result<Matrix, Error> {
        matrix.check_square("inverse")?;
        let size = matrix.rows;
        if size > LARGEST_INVERSE {
            let what = "rows of a matrix that is inverted in symbols (solve the linear system numerically)";
            return Err(Error::Limit { what, limit: LARGEST_INVERSE, found: size });
        }
        let determinant = self.determinant(matrix)?;
        if determinant == Id::ZERO {
            let text =
                format!("the {size}x{size} matrix has no inverse: its determinant is identically zero");
            return Err(Error::Singular(text));
        }
        let mut entries = vec![Id::ZERO; size * size];
        for row in 0..size {
            for (column, cofactor) in self.cofactors(matrix, row)?.into_iter().enumerate() {
                entries[column * size + row] = self.div(cofactor, determinant)?;
            }
        }
        Matrix::new(size, size, entries)
    }

    /// The cofactors of one row: the minors of the other rows, with their signs.
    fn cofactors(&mut self, matrix: &Matrix, row: usize) -> Result<Vec<Id>, Error> {
        let size = matrix.rows;
        let others = (0..size).filter(|&other| other != row);
        let others: Vec<Vec<Id>> = others.map(|other| matrix.row(other).to_vec()).collect();
        let minors = self.minors(&others)?;
        let all = first_columns(size);
        let cofactor = |column: usize| {
            let minor = minors.get(&(all & !(1 << column))).copied().unwrap_or(Id::ZERO);
            if (row + column) % 2 == 1 { self.neg(minor) } else { minor }
        };
        Ok((0..size).map(cofactor).collect())
    }
}
