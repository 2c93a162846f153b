//! Factorisations without pivoting: they solve what they take, and leave alone what they can't be sure of.

use symbody_core::factorization::workspace;
use symbody_core::{factorization, positive_definite};

/// Numbers between -1 and 1 that look random.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from((self.0 >> 33) as u32) / f64::from(1_u32 << 30) - 1.0
    }
}

/// `B B^T` for a random B with so many columns, in units that differ by powers of ten from row to row.
fn gram(n: usize, columns: usize, units: f64, noise: &mut Noise) -> Vec<f64> {
    let mut scale = 1.0;
    let rows: Vec<Vec<f64>> = (0..n)
        .map(|_| {
            scale *= units;
            (0..columns).map(|_| scale * noise.next()).collect()
        })
        .collect();
    rows.iter().flat_map(|a| rows.iter().map(move |b| a.iter().zip(b).map(|(a, b)| a * b).sum())).collect()
}

fn in_workspace(n: usize, matrix: &[f64]) -> Vec<f64> {
    let mut work = vec![0.0; workspace(n)];
    work[..n * n].copy_from_slice(matrix);
    work
}

#[test]
fn solutions_are_those_of_pivoting() {
    let mut noise = Noise(1);
    for n in 1..=8 {
        for units in [1.0, 1e3, 1e-4] {
            let matrix = gram(n, 2 * n, units, &mut noise);
            let right: Vec<f64> = (0..n).map(|i| noise.next() * matrix[i * n + i].sqrt()).collect();
            let (mut work, mut x) = (in_workspace(n, &matrix), right.clone());
            assert!(positive_definite::factor(n, &mut work), "{n}");
            assert!(positive_definite::solve(n, &work, &mut x));
            let (mut other, mut y) = (in_workspace(n, &matrix), right);
            assert_eq!(factorization::factor(n, &mut other), 0);
            assert!(!positive_definite::solve(n, &other, &mut y));
            factorization::solve(n, &other, &mut y);
            for i in 0..n {
                let size = matrix[i * n + i].sqrt();
                assert!(((x[i] - y[i]) * size).abs() < 1e-11, "{n} {units}: {} {}", x[i], y[i]);
            }
        }
    }
}

#[test]
fn what_pivoting_has_to_decide_is_left_alone() {
    let mut noise = Noise(2);
    let mut dependent = gram(5, 4, 1.0, &mut noise);
    assert!(!positive_definite::factor(5, &mut in_workspace(5, &dependent)));
    dependent[0] = f64::NAN;
    assert!(!positive_definite::factor(5, &mut in_workspace(5, &dependent)));
    for matrix in [[0.0, 1.0, 1.0, 0.0], [1.0, 2.0, 2.0, 1.0], [2.0, 1.0, 0.5, 2.0], [-1.0, 0.0, 0.0, 1.0]] {
        assert!(!positive_definite::factor(2, &mut in_workspace(2, &matrix)), "{matrix:?}");
    }
    let large = gram(9, 18, 1.0, &mut noise);
    assert!(!positive_definite::factor(9, &mut in_workspace(9, &large)));
}
