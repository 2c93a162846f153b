//! Laws of matrices: an inverse inverts, determinants multiply, and numbers agree with an elimination.

use symbody_core::{Assumption, Error, Evaluator, Function, Graph, Id, Matrix};

fn symbols(g: &mut Graph, rows: usize, columns: usize) -> Result<Matrix, Error> {
    let entries = (0..rows * columns).map(|i| g.symbol(&format!("a{i}"), Assumption::Real)).collect();
    Matrix::new(rows, columns, entries)
}

/// The determinant of numbers by Gaussian elimination with partial pivoting.
fn eliminate(mut a: Vec<Vec<f64>>) -> f64 {
    let n = a.len();
    let mut determinant = 1.0;
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs())).unwrap_or(k);
        if pivot != k {
            a.swap(pivot, k);
            determinant = -determinant;
        }
        determinant *= a[k][k];
        for i in k + 1..n {
            let factor = a[i][k] / a[k][k];
            let row = a[k].clone();
            a[i].iter_mut().zip(row).skip(k).for_each(|(entry, pivot)| *entry -= factor * pivot);
        }
    }
    determinant
}

#[test]
fn an_inverse_inverts() -> Result<(), Error> {
    for size in 1..=5 {
        let g = &mut Graph::new();
        let matrix = symbols(g, size, size)?;
        let inverse = g.inverse(&matrix)?;
        for product in [g.matrix_product(&matrix, &inverse)?, g.matrix_product(&inverse, &matrix)?] {
            assert_eq!(product, Matrix::identity(size), "{size}x{size}");
        }
    }
    Ok(())
}

#[test]
fn the_inverse_of_a_rotation_is_its_transpose() -> Result<(), Error> {
    let g = &mut Graph::new();
    let mut rotation = Matrix::identity(3);
    for (name, axis) in [("a", 0), ("b", 1), ("c", 2)] {
        let angle = g.time_function(name, 0)?;
        let (sin, cos) = (g.apply(Function::Sin, &[angle])?, g.apply(Function::Cos, &[angle])?);
        let minus = g.neg(sin);
        let mut entries = Matrix::identity(3).entries().to_vec();
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        for (row, column, entry) in [(i, i, cos), (j, j, cos), (i, j, minus), (j, i, sin)] {
            entries[3 * row + column] = entry;
        }
        rotation = g.matrix_product(&rotation, &Matrix::new(3, 3, entries)?)?;
    }
    assert_eq!(g.determinant(&rotation)?, Id::ONE);
    let (inverse, transpose) = (g.inverse(&rotation)?, rotation.transpose());
    for (&a, &b) in inverse.entries().iter().zip(transpose.entries()) {
        assert!(g.equal(a, b));
    }
    Ok(())
}

#[test]
fn determinants_multiply() -> Result<(), Error> {
    for size in 1..=4 {
        let g = &mut Graph::new();
        let a = symbols(g, size, size)?;
        let angle = g.time_function("q", 0)?;
        let entries = a.entries().iter().rev().map(|&entry| g.add(entry, angle)).collect();
        let b = Matrix::new(size, size, entries)?;
        let product = g.matrix_product(&a, &b)?;
        let (det_a, det_b) = (g.determinant(&a)?, g.determinant(&b)?);
        let (left, right) = (g.determinant(&product)?, g.mul(det_a, det_b)?);
        assert!(g.equal(left, right), "{size}x{size}");
        let transposed = g.determinant(&a.transpose())?;
        assert!(g.equal(det_a, transposed));
    }
    Ok(())
}

#[test]
fn determinants_agree_with_elimination() -> Result<(), Error> {
    for size in 1..=8 {
        let g = &mut Graph::new();
        let matrix = symbols(g, size, size)?;
        let determinant = g.determinant(&matrix)?;
        let numbers: Vec<f64> = (0_u32..).take(size * size).map(|i| ((i * i + 3 * i) % 17).into()).collect();
        let numbers: Vec<f64> = numbers.iter().map(|x: &f64| x.sin()).collect();
        let tape = g.tape(matrix.entries(), &[determinant])?;
        let found = Evaluator::new(&tape).evaluate(&numbers)?[0];
        let expected = eliminate(numbers.chunks(size).map(<[f64]>::to_vec).collect());
        assert!((found - expected).abs() < 1e-12 * (1.0 + expected.abs()), "{size}: {found} for {expected}");
    }
    Ok(())
}

#[test]
fn sparse_determinants_may_be_large() -> Result<(), Error> {
    // The tridiagonal matrix of 2 and -1 has the determinant size + 1.
    let g = &mut Graph::new();
    let a = g.symbol("a", Assumption::Real);
    let (twice, minus) = (g.add(a, a), g.neg(a));
    let size = 40;
    let entry = |row: usize, column: usize| match row.abs_diff(column) {
        0 => twice,
        1 => minus,
        _ => Id::ZERO,
    };
    let entries = (0..size * size).map(|i| entry(i / size, i % size)).collect();
    let determinant = g.determinant(&Matrix::new(size, size, entries)?)?;
    let value = Evaluator::new(&g.tape(&[a], &[determinant])?).evaluate(&[1.0])?[0];
    assert!((value - 41.0).abs() < 1e-9, "{value}");
    Ok(())
}

#[test]
fn what_cannot_be_done_is_said() -> Result<(), Error> {
    let g = &mut Graph::new();
    let (a, b) = (symbols(g, 2, 3)?, symbols(g, 2, 2)?);
    let message = |error: Option<Error>| error.map(|error| error.to_string()).unwrap_or_default();
    assert_eq!(
        message(g.matrix_product(&a, &b).err()),
        "product of a 2x3 and a 2x2 matrix: the shapes do not match"
    );
    assert!(matches!(g.determinant(&a), Err(Error::Shape { operation: "determinant", .. })));
    assert!(matches!(Matrix::new(2, 2, vec![Id::ONE]), Err(Error::Shape { .. })));
    let entries = vec![b.at(0, 0), b.at(0, 1), b.at(0, 0), b.at(0, 1)];
    assert_eq!(
        message(g.inverse(&Matrix::new(2, 2, entries)?).err()),
        "the 2x2 matrix has no inverse: its determinant is identically zero"
    );
    let large = symbols(g, 7, 7)?;
    assert_eq!(
        message(g.inverse(&large).err()),
        "rows of a matrix that is inverted in symbols (solve the linear system numerically): at most 6, found 7"
    );
    let dense = symbols(g, 13, 13)?;
    assert!(message(g.determinant(&dense).err()).starts_with("minors in the expansion of a determinant"));
    Ok(())
}
