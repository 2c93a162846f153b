//! Methods against solutions in closed form.

mod problems;

use problems::{
    METHODS, blows_up, blows_up_jacobian, code, dry_friction, ends_at_one, error, evenly, free, motion,
    oscillator_of, tolerance, van_der_pol, van_der_pol_jacobian,
};
use symbody_integrate::{Failure, Method};

fn cosine(w: f64) -> impl Fn(f64) -> Vec<f64> {
    move |t| vec![(w * t).cos(), -w * (w * t).sin()]
}

#[test]
fn every_method_follows_an_oscillator_at_all_instants() {
    let instants = evenly(5.0, 400);
    for method in METHODS {
        let (states, run) = motion(&oscillator_of(2.0), method, &[1.0, 0.0], &instants, tolerance(1e-7, 2));
        assert_eq!((run.reached, run.failure), (401, None), "{method:?}");
        let error = error(&states, &instants, cosine(2.0));
        assert!(error < 2e-4, "{method:?}: {error:e}");
    }
}

#[test]
fn the_error_falls_with_the_tolerance() {
    let instants = evenly(10.0, 10);
    for method in METHODS {
        let at = |relative| {
            let (states, _) =
                motion(&oscillator_of(1.0), method, &[1.0, 0.0], &instants, tolerance(relative, 2));
            error(&states, &instants, cosine(1.0))
        };
        let (loose, tight) = (at(1e-5), at(1e-8));
        assert!(tight < loose / 20.0, "{method:?}: {loose:e}, then {tight:e}");
    }
}

/// With steps of one length h, halved, the error falls by 2^8.
#[test]
fn dop853_is_of_order_eight_and_its_dense_output_of_order_seven() {
    let errors = |h: f64, instants: &[f64]| {
        let mut steps = tolerance(1e6, 2);
        steps.max_step = h;
        let (states, run) = motion(&oscillator_of(1.0), Method::Dop853, &[1.0, 0.0], instants, steps);
        assert_eq!(run.statistics.rejected, 0);
        error(&states, instants, cosine(1.0))
    };
    let order = |instants: &[f64]| (errors(0.5, instants) / errors(0.25, instants)).log2();
    let at_end = order(&[0.0, 8.0]);
    assert!((7.7..9.5).contains(&at_end), "{at_end}");
    let between = order(&evenly(8.0, 321));
    assert!((6.7..9.5).contains(&between), "{between}");
}

#[test]
fn implicit_methods_take_a_stiff_problem_in_few_steps() {
    let epsilon = 1e-6;
    let jacobian = (code(van_der_pol_jacobian, 2, 1, 3), vec![(0, 1), (1, 0), (1, 1)]);
    let dynamics = free(code(van_der_pol, 2, 1, 2), Some(jacobian)).with_constants(&[epsilon, epsilon]);
    // E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, IV.10: the solution at t = 2.
    let solution = [1.706167732170483, -0.8928097010247975];
    for method in [Method::Bdf, Method::Esdirk34, Method::TrBdf2] {
        let (states, run) = motion(&dynamics, method, &[2.0, -0.66], &[0.0, 2.0], tolerance(1e-6, 2));
        assert_eq!(run.failure, None, "{method:?}");
        assert!(run.statistics.steps < 5000, "{method:?}: {} steps", run.statistics.steps);
        assert!(run.statistics.jacobians > 0, "{method:?}");
        let error = error(&states[1..], &[2.0], |_| solution.to_vec());
        assert!(error < 1e-3, "{method:?}: {error:e}");
    }
}

#[test]
fn an_explicit_method_tells_that_a_problem_is_stiff() {
    let dynamics = free(code(van_der_pol, 2, 1, 2), None).with_constants(&[1e-3]);
    let (_, run) = motion(&dynamics, Method::Dop853, &[2.0, -0.66], &[0.0, 0.5], tolerance(1e-6, 2));
    assert!(run.statistics.stiff);
    for loose in [1e-2, 1e-3, 1e-4, 1e-6] {
        let (_, run) =
            motion(&oscillator_of(1.0), Method::Dop853, &[1.0, 0.0], &[0.0, 500.0], tolerance(loose, 2));
        assert!(!run.statistics.stiff, "{loose:e}");
    }
}

#[test]
fn a_rate_that_is_no_number_ends_the_motion_where_it_begins_to_be_none() {
    let dynamics = free(code(ends_at_one, 1, 0, 1), Some((code(ends_at_one, 1, 0, 1), vec![])));
    let dynamics = dynamics.with_constants(&[]);
    for method in METHODS {
        let (states, run) = motion(&dynamics, method, &[0.0], &evenly(2.0, 20), tolerance(1e-8, 1));
        assert!(matches!(run.failure, Some(Failure::NotFinite { .. })), "{method:?}: {:?}", run.failure);
        assert!((5..=11).contains(&run.reached), "{method:?}: {}", run.reached);
        let known = &states[..run.reached];
        let solution = |t: f64| vec![(1.0 - (1.0 - t).powf(1.5)) / 1.5];
        assert!(error(known, &evenly(2.0, 20), solution) < 1e-4, "{method:?}");
        assert!(states[run.reached..].iter().all(|state| state[0].is_nan()), "{method:?}");
    }
}

#[test]
fn a_solution_that_becomes_infinite_ends_with_what_was_computed() {
    let jacobian = (code(blows_up_jacobian, 1, 0, 1), vec![(0, 0)]);
    let dynamics = free(code(blows_up, 1, 0, 1), Some(jacobian)).with_constants(&[]);
    let instants = evenly(2.0, 21);
    for method in METHODS {
        let (states, run) = motion(&dynamics, method, &[1.0], &instants, tolerance(1e-8, 1));
        assert!(run.failure.is_some(), "{method:?}");
        assert_eq!(run.reached, 11, "{method:?}");
        assert!(error(&states[..11], &instants, |t| vec![1.0 / (1.0 - t)]) < 2e-3, "{method:?}");
        assert!((0.99..1.01).contains(&run.end.0), "{method:?}: {}", run.end.0);
    }
}

/// The body sticks after 2 s: from there on its speed chatters about zero.
#[test]
fn steps_that_lead_nowhere_end_the_motion() {
    let dynamics = free(code(dry_friction, 2, 0, 2), None).with_constants(&[]);
    for method in [Method::Dop853, Method::Tsit5] {
        let (states, run) = motion(&dynamics, method, &[0.0, 1.0], &evenly(10.0, 10), tolerance(1e-10, 2));
        assert!(matches!(run.failure, Some(Failure::Stalled { .. })), "{method:?}: {:?}", run.failure);
        assert_eq!(run.reached, 3, "{method:?}");
        assert!((states[1][0] - 0.75).abs() < 1e-8);
        assert!((run.end.0 - 2.0).abs() < 0.1, "{method:?}: {}", run.end.0);
    }
}
