//! Laws of the factorisation that linear systems are solved by at run time.

use symbody_core::factorization::{dependent, factor, solve, workspace};

fn solved(rows: &[f64], right: &[f64]) -> (Vec<f64>, Vec<usize>) {
    let n = right.len();
    let mut work = rows.to_vec();
    work.resize(workspace(n), 0.0);
    let count = factor(n, &mut work);
    let mut x = right.to_vec();
    solve(n, &work, &mut x);
    let named: Vec<usize> = dependent(n, &work).collect();
    assert_eq!(count, named.len());
    (x, named)
}

fn close(found: &[f64], expected: &[f64]) -> bool {
    found.iter().zip(expected).all(|(f, e)| (f - e).abs() <= 1e-14 * e.abs().max(1.0))
}

/// Numbers from -1 to 1, the same ones each time.
fn numbers(count: usize) -> Vec<f64> {
    let mut state = 1_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from_bits((state >> 12) | 0x3ff0_0000_0000_0000) * 2.0 - 3.0
    };
    (0..count).map(|_| next()).collect()
}

fn product(rows: &[f64], x: &[f64]) -> Vec<f64> {
    rows.chunks_exact(x.len()).map(|row| row.iter().zip(x).map(|(a, x)| a * x).sum()).collect()
}

#[test]
fn regular_systems_of_all_sizes_and_many_right_sides() {
    for n in 1..40 {
        let rows = numbers(n * n);
        let mut work = rows.clone();
        work.resize(workspace(n), f64::NAN);
        assert_eq!(factor(n, &mut work), 0);
        for k in 0..3 {
            let expected = numbers(n + k).split_off(k);
            let mut x = product(&rows, &expected);
            solve(n, &work, &mut x);
            let error = x.iter().zip(&expected).map(|(x, e)| (x - e).abs()).fold(0.0, f64::max);
            assert!(error < 1e-10, "n = {n}: {error}");
        }
    }
}

#[test]
fn a_repeated_equation_is_named_and_the_least_solution_taken() {
    let (x, named) = solved(&[1.0, 1.0, 0.0, 3.0, 3.0, 0.0, 0.0, 0.0, 2.0], &[2.0, 6.0, 8.0]);
    assert!(close(&x, &[1.0, 1.0, 4.0]), "{x:?}");
    assert_eq!(named, [1]);
}

#[test]
fn an_empty_matrix_has_nothing_as_its_least_solution() {
    assert_eq!(solved(&[0.0; 4], &[1.0, 2.0]), (vec![0.0, 0.0], vec![0, 1]));
    assert_eq!(solved(&[], &[]), (vec![], vec![]));
}

#[test]
fn contradictory_equations_meet_halfway() {
    let (x, named) = solved(&[1.0, 0.0, 1.0, 0.0], &[1.0, 3.0]);
    assert!(close(&x, &[2.0, 0.0]), "{x:?}");
    assert_eq!(named, [1]);
}

#[test]
fn units_of_equations_and_unknowns_do_not_make_a_system_deficient() {
    let (x, named) = solved(&[1e200, 2e190, 3e-200, -1e-210], &[3e200, 2e-200]);
    assert!(close(&[x[0], x[1] * 1e-10], &[1.0, 1e0]), "{x:?}");
    assert_eq!(named, []);
    // Both unknowns are as far from 0 as the units of the third let them be.
    let (x, named) = solved(&[1.0, 1.0, 1e-12, 1.0, -1.0, 1e-12, 2.0, 0.0, 2e-12], &[2.0, 0.0, 2.0]);
    assert!(close(&x, &[1.0, 1.0, 1e-12]), "{x:?}");
    assert_eq!(named, [2]);
}

#[test]
fn small_masses_are_no_rounding_errors() {
    for mass in [1e-9, 1e-13, 1e-16, 1e-25] {
        let (m, rows) = (mass, [mass, 0.0, -1.0, 0.0, mass, -1.0, 1.0, 1.0, 0.0]);
        let (x, named) = solved(&rows, &[3.0 * m, 1.0 * m, 0.0]);
        assert!(close(&[x[0], x[1], x[2] / m], &[1.0, -1.0, -2.0]), "{x:?}");
        assert_eq!(named, []);
        let rows = [m, 0.0, -1.0, -1.0, 0.0, m, -1.0, -1.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0];
        let (x, named) = solved(&rows, &[3.0 * m, 1.0 * m, 0.0, 0.0]);
        assert!(close(&[x[0], x[1], x[2] / m, x[3] / m], &[1.0, -1.0, -1.0, -1.0]), "{x:?}");
        assert_eq!(named, [3]);
    }
}

#[test]
fn what_is_no_number_gives_no_number() {
    let regular = [1.0, 2.0, 3.0, 4.0];
    for bad in [f64::NAN, f64::INFINITY] {
        for k in 0..4 {
            let mut rows = regular;
            rows[k] = bad;
            assert!(solved(&rows, &[1.0, 1.0]).0.iter().all(|x| x.is_nan()));
        }
        assert!(solved(&[1.0, 1.0, 1.0, 1.0], &[bad, 1.0]).0.iter().all(|x| x.is_nan()));
    }
}

#[test]
fn nearly_dependent_equations_are_told_from_dependent_ones() {
    let nearly = |gap: f64| solved(&[1.0, 1.0, 1.0, 1.0 + gap], &[2.0, 2.0 + gap]);
    assert_eq!(nearly(1e-12).1, []);
    assert_eq!(nearly(1e-15).1, [1]);
}
