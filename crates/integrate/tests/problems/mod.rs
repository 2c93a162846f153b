//! Problems whose solutions are known, as machine code.

#![allow(dead_code, reason = "each test program takes what it needs")]
#![allow(unsafe_code, reason = "machine code reads and writes by address")]

use std::slice;

use symbody_integrate::{Dynamics, MachineCode, Method, Record, Run, Tolerances, integrate};

/// Compiled code as the crate takes it.
pub type Compiled = unsafe extern "C" fn(*const f64, *mut f64);

/// All methods of integration.
pub const METHODS: [Method; 5] =
    [Method::Dop853, Method::Tsit5, Method::Bdf, Method::Esdirk34, Method::TrBdf2];

/// The machine code of a function of the tests, which reads and writes so many numbers.
pub fn code(function: Compiled, states: usize, constants: usize, outputs: usize) -> MachineCode {
    // SAFETY: the functions below read and write as many numbers as the tests say here.
    unsafe { MachineCode::new(function as usize, states, constants, outputs) }
}

/// Equations without constraints and events.
pub fn free(
    rates: MachineCode,
    jacobian: Option<(MachineCode, Vec<(usize, usize)>)>,
) -> Dynamics<MachineCode> {
    Dynamics {
        rates,
        jacobian,
        position_correction: None,
        velocity_correction: None,
        sensitivity_correction: None,
        energies: None,
        events: None,
    }
}

/// The same relative and absolute tolerance for all of the state, and steps of any length.
pub fn tolerance(tolerance: f64, states: usize) -> Tolerances {
    Tolerances { relative: tolerance, absolute: tolerance, max_step: f64::INFINITY, controlled: states }
}

/// A motion and how it went: the states of the instants, a row for each.
pub fn motion(
    dynamics: &Dynamics,
    method: Method,
    state: &[f64],
    instants: &[f64],
    tolerances: Tolerances,
) -> (Vec<Vec<f64>>, Run) {
    let mut states = vec![f64::NAN; state.len() * instants.len()];
    let record = Record { instants, states: &mut states, trail: 0 };
    let run = integrate(dynamics, method, state, record, tolerances, &mut |_| true);
    (states.chunks(state.len()).map(<[f64]>::to_vec).collect(), run)
}

/// Evenly spaced instants.
pub fn evenly(end: f64, parts: u32) -> Vec<f64> {
    (0..=parts).map(|k| end * f64::from(k) / f64::from(parts)).collect()
}

/// The largest difference of a motion from the solution.
pub fn error(states: &[Vec<f64>], instants: &[f64], solution: impl Fn(f64) -> Vec<f64>) -> f64 {
    let differences = states.iter().zip(instants).flat_map(|(state, &t)| {
        state.iter().zip(solution(t)).map(|(found, exact)| (found - exact).abs()).collect::<Vec<_>>()
    });
    differences.fold(0.0, f64::max)
}

/// An oscillator of angular frequency w: `x'' = -w^2 x`; reads t, x, x', w.
pub unsafe extern "C" fn oscillator(inputs: *const f64, out: *mut f64) {
    // SAFETY: lengths as documented.
    let (inputs, out) = unsafe { (slice::from_raw_parts(inputs, 4), slice::from_raw_parts_mut(out, 2)) };
    let [_, x, v, w] = inputs else { unreachable!() };
    out.copy_from_slice(&[*v, -w * w * x]);
}

/// Four oscillators in lanes, and a condition: of those with x < 0, only the code for one state knows the rates.
pub unsafe extern "C" fn oscillators(inputs: *const f64, out: *mut f64) {
    // SAFETY: lengths as documented.
    let (inputs, out) = unsafe { (slice::from_raw_parts(inputs, 16), slice::from_raw_parts_mut(out, 12)) };
    for lane in 0..4 {
        let [x, v, w] = [1, 2, 3].map(|k| inputs[4 * k + lane]);
        let values = if x < 0.0 { [f64::NAN, f64::NAN, -1.0] } else { [v, -w * w * x, 1.0] };
        for (k, value) in values.into_iter().enumerate() {
            out[4 * k + lane] = value;
        }
    }
}

/// The equations of the oscillator for one state and for four.
pub fn oscillators_of() -> Dynamics<MachineCode> {
    // SAFETY: it reads and writes four numbers where the other function has one, and one condition.
    free(unsafe { code(oscillator, 2, 1, 2).with_vectors(oscillators as Compiled as usize, 1) }, None)
}

/// Its Jacobian at (0, 1) and (1, 0).
pub unsafe extern "C" fn oscillator_jacobian(inputs: *const f64, out: *mut f64) {
    // SAFETY: lengths as documented.
    let (inputs, out) = unsafe { (slice::from_raw_parts(inputs, 4), slice::from_raw_parts_mut(out, 2)) };
    out.copy_from_slice(&[1.0, -inputs[3] * inputs[3]]);
}

/// The position of the oscillator as an event function.
pub unsafe extern "C" fn position(inputs: *const f64, out: *mut f64) {
    // SAFETY: lengths as documented.
    unsafe { *out = *inputs.add(1) };
}

/// The oscillator with its Jacobian, for one frequency.
pub fn oscillator_of(w: f64) -> Dynamics {
    let jacobian = (code(oscillator_jacobian, 2, 1, 2), vec![(0, 1), (1, 0)]);
    free(code(oscillator, 2, 1, 2), Some(jacobian)).with_constants(&[w, w])
}

/// Van der Pol's equation, stiff for a small epsilon: `epsilon v' = (1 - x^2) v - x`; reads t, x, v, epsilon.
pub unsafe extern "C" fn van_der_pol(inputs: *const f64, out: *mut f64) {
    // SAFETY: lengths as documented.
    let (inputs, out) = unsafe { (slice::from_raw_parts(inputs, 4), slice::from_raw_parts_mut(out, 2)) };
    let [_, x, v, epsilon] = *inputs else { unreachable!() };
    out.copy_from_slice(&[v, ((1.0 - x * x) * v - x) / epsilon]);
}

/// Its Jacobian at (0, 1), (1, 0) and (1, 1).
pub unsafe extern "C" fn van_der_pol_jacobian(inputs: *const f64, out: *mut f64) {
    // SAFETY: lengths as documented.
    let (inputs, out) = unsafe { (slice::from_raw_parts(inputs, 4), slice::from_raw_parts_mut(out, 3)) };
    let [_, x, v, epsilon] = *inputs else { unreachable!() };
    out.copy_from_slice(&[1.0, (-2.0 * x * v - 1.0) / epsilon, (1.0 - x * x) / epsilon]);
}

/// A point that runs around the unit circle by `x'' = -|v|^2 x`; reads t, x, y, vx, vy.
pub unsafe extern "C" fn circle(inputs: *const f64, out: *mut f64) {
    // SAFETY: lengths as documented.
    let (inputs, out) = unsafe { (slice::from_raw_parts(inputs, 5), slice::from_raw_parts_mut(out, 4)) };
    let [_, x, y, vx, vy] = *inputs else { unreachable!() };
    let square = vx * vx + vy * vy;
    out.copy_from_slice(&[vx, vy, -square * x, -square * y]);
}

/// The way back onto `(x^2 + y^2 - 1) / 2 = 0`.
pub unsafe extern "C" fn back_onto_circle(inputs: *const f64, out: *mut f64) {
    // SAFETY: lengths as documented.
    let (inputs, out) = unsafe { (slice::from_raw_parts(inputs, 5), slice::from_raw_parts_mut(out, 2)) };
    let [_, x, y, ..] = *inputs else { unreachable!() };
    let size = x * x + y * y;
    let part = (1.0 - size) / (2.0 * size);
    out.copy_from_slice(&[part * x, part * y]);
}

/// The way back onto `x vx + y vy = 0`.
pub unsafe extern "C" fn along_circle(inputs: *const f64, out: *mut f64) {
    // SAFETY: lengths as documented.
    let (inputs, out) = unsafe { (slice::from_raw_parts(inputs, 5), slice::from_raw_parts_mut(out, 2)) };
    let [_, x, y, vx, vy] = *inputs else { unreachable!() };
    let part = -(x * vx + y * vy) / (x * x + y * y);
    out.copy_from_slice(&[part * x, part * y]);
}

/// A rate that is NaN from t = 1 on: `x' = sqrt(1 - t)`; reads t, x.
pub unsafe extern "C" fn ends_at_one(inputs: *const f64, out: *mut f64) {
    // SAFETY: lengths as documented.
    unsafe { *out = (1.0 - *inputs).sqrt() };
}

/// A solution that is infinite at t = 1: `x' = x^2`; reads t, x.
pub unsafe extern "C" fn blows_up(inputs: *const f64, out: *mut f64) {
    // SAFETY: lengths as documented.
    unsafe { *out = *inputs.add(1) * *inputs.add(1) };
}

/// Its Jacobian at (0, 0).
pub unsafe extern "C" fn blows_up_jacobian(inputs: *const f64, out: *mut f64) {
    // SAFETY: lengths as documented.
    unsafe { *out = 2.0 * *inputs.add(1) };
}

/// Dry friction on a body that a force too weak to move it pushes: `x'' = 0.5 - sign(x')`; reads t, x, v.
pub unsafe extern "C" fn dry_friction(inputs: *const f64, out: *mut f64) {
    // SAFETY: lengths as documented.
    let (inputs, out) = unsafe { (slice::from_raw_parts(inputs, 3), slice::from_raw_parts_mut(out, 2)) };
    let [_, _, v] = *inputs else { unreachable!() };
    let friction = if v == 0.0 { 0.0 } else { v.signum() };
    out.copy_from_slice(&[v, 0.5 - friction]);
}
