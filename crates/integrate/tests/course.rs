//! The loop around a method: events, projection, interruption, many motions.

mod problems;

use problems::{
    METHODS, along_circle, back_onto_circle, circle, code, error, evenly, free, motion, oscillator,
    oscillator_of, oscillators_of, position, tolerance,
};
use symbody_integrate::{Case, Dynamics, EventKind, Failure, Method, Record, integrate, integrate_many};

fn watched(kind: EventKind) -> Dynamics {
    let events = Some((code(position, 2, 1, 1), vec![kind]));
    Dynamics { events, ..free(code(oscillator, 2, 1, 2), None) }.with_constants(&[3.0, 3.0])
}

fn times(kind: EventKind, end: f64) -> Vec<f64> {
    let (_, run) = motion(&watched(kind), Method::Dop853, &[1.0, 0.0], &[0.0, end], tolerance(1e-10, 2));
    run.occurrences.iter().map(|occurrence| occurrence.t).collect()
}

#[test]
fn zeros_are_found_in_either_direction() {
    use std::f64::consts::PI;
    let zeros = |first: f64, step: f64| (0..).map(move |k| (first + step * f64::from(k)) * PI / 3.0);
    for (direction, first, step) in [(0, 0.5, 1.0), (-1, 0.5, 2.0), (1, 1.5, 2.0)] {
        let found = times(EventKind { direction, terminal: false }, 10.0);
        let expected: Vec<f64> = zeros(first, step).take_while(|&t| t < 10.0).collect();
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
    }
}

#[test]
fn a_terminal_event_ends_the_motion_there() {
    let dynamics = watched(EventKind { direction: 1, terminal: true });
    let instants = evenly(10.0, 100);
    let (states, run) = motion(&dynamics, Method::Dop853, &[1.0, 0.0], &instants, tolerance(1e-10, 2));
    let end = std::f64::consts::PI / 2.0;
    assert!((run.end.0 - end).abs() < 1e-9 && run.end.1[0].abs() < 1e-9);
    assert_eq!((run.reached, run.occurrences.len(), run.failure), (16, 1, None));
    assert!(states[16][0].is_nan());
}

fn on_circle() -> Dynamics {
    Dynamics {
        position_correction: Some(code(back_onto_circle, 4, 0, 2)),
        velocity_correction: Some(code(along_circle, 4, 0, 2)),
        sensitivity_correction: None,
        ..free(code(circle, 4, 0, 4), None)
    }
    .with_constants(&[])
}

#[test]
fn projection_keeps_the_constraints_at_every_instant_to_rounding() {
    let instants = evenly(20.0, 333);
    for method in [Method::Dop853, Method::Tsit5] {
        let begin = [1.0, 0.0, 0.0, 2.0];
        let (states, run) = motion(&on_circle(), method, &begin, &instants, tolerance(1e-7, 4));
        assert_eq!(run.failure, None);
        for state in &states {
            let [x, y, vx, vy] = state[..] else { unreachable!() };
            assert!((x * x + y * y - 1.0).abs() < 1e-14);
            assert!((x * vx + y * vy).abs() < 1e-14);
        }
        let solution = |t: f64| {
            let (sin, cos) = (2.0 * t).sin_cos();
            vec![cos, sin, -2.0 * sin, 2.0 * cos]
        };
        assert!(error(&states, &instants, solution) < 1e-4, "{method:?}");
    }
}

#[test]
fn a_motion_is_interrupted_between_steps_and_keeps_what_it_has() {
    for method in METHODS {
        let dynamics = oscillator_of(50.0);
        let instants = evenly(100.0, 100_000);
        let mut states = vec![f64::NAN; 2 * instants.len()];
        let record = Record { instants: &instants, states: &mut states, trail: 0 };
        let run = integrate(&dynamics, method, &[1.0, 0.0], record, tolerance(1e-6, 2), &mut |t| t < 1.0);
        let Some(Failure::Interrupted { t }) = run.failure else { panic!("{method:?}: {:?}", run.failure) };
        assert!((1.0..20.0).contains(&t) && run.reached > 1000, "{method:?}: {t}");
        assert!(states[..2 * run.reached].iter().all(|x| x.is_finite()));
        assert!((run.end.0 - t).abs() <= f64::EPSILON * t);
    }
}

#[test]
fn many_motions_are_those_that_come_one_by_one_whatever_the_threads_and_lanes() {
    let code = oscillators_of();
    let frequencies: Vec<[f64; 1]> = (1..=9).map(|k| [f64::from(k) / 3.0]).collect();
    let cases: Vec<Case<'_>> =
        frequencies.iter().map(|w| Case { state: &[1.0, 0.0], constants: w }).collect();
    let instants = evenly(3.0, 7);
    let alone: Vec<f64> = frequencies
        .iter()
        .flat_map(|w| {
            let own = code.with_constants(w);
            motion(&own, Method::Dop853, &[1.0, 0.0], &instants, tolerance(1e-9, 2)).0.concat()
        })
        .collect();
    for crew in [(0, 1), (1, 1), (2, 1), (20, 1), (1, 4), (2, 4)] {
        let mut states = vec![f64::NAN; 9 * 8 * 2];
        let record = Record { instants: &instants, states: &mut states, trail: 0 };
        let limits = tolerance(1e-9, 2);
        let runs = integrate_many(
            &code,
            Method::Dop853,
            &cases,
            record,
            limits,
            crew,
            &mut |_| true,
            &Vec::<()>::new,
        );
        assert!(runs.iter().flatten().all(|(run, _)| run.reached == 8) && runs.iter().all(Option::is_some));
        assert_eq!(states, alone);
    }
}
