//! Coordinate projection: the way back onto the constraints.
//!
//! E. Eich, Convergence results for a coordinate projection method applied to mechanical systems with algebraic
//! constraints, SIAM J. Numer. Anal. 30 (1993). The corrections are least in the metric of the mass matrix; the
//! compiled functions give them to first order, and Newton's iteration does the rest.

use std::ops::Range;

use crate::dynamics::Dynamics;
use crate::failure::Failure;
use crate::machine_code::BoundCode;
use crate::stepper::Stepper;

/// The iteration ends after corrections below this, relative to the state: the next ones would be their squares.
pub(crate) const SMALL: f64 = 1e-9;
/// If corrections are still this large after the last iteration, the projection fails.
pub(crate) const LARGE: f64 = 1e-6;
pub(crate) const ITERATIONS: usize = 8;

/// Projects states onto the constraints.
pub struct Projection<'a> {
    dynamics: &'a Dynamics,
    change: Vec<f64>,
    /// The largest change of a speed that a correction may make.
    pub bound: f64,
}

impl<'a> Projection<'a> {
    pub fn new(dynamics: &'a Dynamics) -> Self {
        Self { dynamics, change: Vec::new(), bound: f64::INFINITY }
    }

    /// Whether there are constraints.
    pub fn is_needed(&self) -> bool {
        self.dynamics.has_constraints()
    }

    /// The places of the speeds in the state.
    pub fn speeds(&self) -> Range<usize> {
        let coordinates = self.dynamics.position_correction.as_ref().map_or(0, BoundCode::outputs);
        coordinates..coordinates + self.dynamics.velocity_correction.as_ref().map_or(0, BoundCode::outputs)
    }

    /// Write the state at an instant of the last step, projected onto the constraints. If that would take a leap of the
    /// speeds, write the state of the dense output.
    pub fn read(&mut self, stepper: &mut dyn Stepper, t: f64, out: &mut [f64]) -> Result<(), Failure> {
        stepper.interpolate(t, out)?;
        match if self.is_needed() { self.project(t, out) } else { Ok(()) } {
            Err(Failure::Singular { .. }) => stepper.interpolate(t, out),
            other => other,
        }
    }

    /// Change first the coordinates and then the speeds so that they satisfy the constraints; then the sensitivities,
    /// so that they satisfy the derivatives of the constraints, which are linear in them.
    pub fn project(&mut self, t: f64, state: &mut [f64]) -> Result<(), Failure> {
        let mut coordinates = 0;
        if let Some(correction) = &self.dynamics.position_correction {
            coordinates = correction.outputs();
            self.change.resize(coordinates, 0.0);
            let mut size = f64::INFINITY;
            for _ in 0..ITERATIONS {
                correction.call(t, state, &mut self.change);
                size = apply(&self.change, &mut state[..coordinates]);
                if size <= SMALL || size.is_nan() {
                    break;
                }
            }
            if size.is_nan() || size > LARGE {
                return Err(Failure::Projection { t, change: size });
            }
        }
        if let Some(correction) = &self.dynamics.velocity_correction {
            let speeds = correction.outputs();
            self.change.resize(speeds, 0.0);
            correction.call(t, state, &mut self.change);
            let size = apply(&self.change, &mut state[coordinates..coordinates + speeds]);
            if size.is_nan() {
                return Err(Failure::Projection { t, change: size });
            }
            let change = self.change.iter().fold(0.0, |size: f64, change| size.max(change.abs()));
            if change > self.bound {
                return Err(Failure::Singular { t, change, bound: self.bound });
            }
        }
        if let Some((correction, first)) = &self.dynamics.sensitivity_correction {
            self.change.resize(correction.outputs(), 0.0);
            correction.call(t, state, &mut self.change);
            let size = apply(&self.change, &mut state[*first..first + correction.outputs()]);
            if size.is_nan() {
                return Err(Failure::Projection { t, change: size });
            }
        }
        Ok(())
    }
}

/// The distance at which the directions of the constraints are compared, relative to the size of the coordinates.
const ASIDE: f64 = 1e-7;

/// The directions of the speeds that the constraints allow.
pub struct Tangent<'a> {
    correction: &'a BoundCode,
    coordinates: usize,
}

impl<'a> Tangent<'a> {
    /// The directions for a system whose constraints are kept by projection; `None` for other systems.
    pub fn of(dynamics: &'a Dynamics) -> Option<Self> {
        let coordinates = dynamics.position_correction.as_ref().map_or(0, BoundCode::outputs);
        dynamics.velocity_correction.as_ref().map(|correction| Self { correction, coordinates })
    }

    /// The places of the speeds in the state.
    pub fn speeds(&self) -> Range<usize> {
        self.coordinates..self.coordinates + self.correction.outputs()
    }

    /// By how much rounding errors change the speeds that the constraints allow.
    ///
    /// At a distance x from a singular position, relative to the size of the coordinates, errors of the coordinates
    /// up to a unit of the last place divided by x do not violate the constraints noticeably. They turn the
    /// directions that the constraints forbid by that error divided by x.
    ///
    /// Args: the instant, the state, and the sizes of its coordinates.
    pub fn noise(&self, t: f64, state: &[f64], sizes: &[f64]) -> f64 {
        let n = self.correction.outputs();
        let (mut here, mut beside) = (vec![0.0; n], vec![0.0; n]);
        self.correction.call(t, state, &mut here);
        let mut near = state.to_vec();
        for (i, (x, size)) in near[..self.coordinates].iter_mut().zip(sizes).enumerate() {
            *x += if i % 2 == 0 { ASIDE } else { -0.5 * ASIDE } * size;
        }
        self.correction.call(t, &near, &mut beside);
        let changes = here.iter().zip(&beside).map(|(a, b)| (a - b).abs());
        let change = changes.fold(0.0, f64::max);
        let speed = state[self.speeds()].iter().fold(f64::MIN_POSITIVE, |most, speed| most.max(speed.abs()));
        f64::EPSILON * (change / ASIDE) * (change / ASIDE / speed)
    }

    /// A small change of the state without the part that leads off the constraints: that of the speeds, and, if there
    /// are as many coordinates, of these too, because they usually are the integrals of the speeds.
    ///
    /// The correction is affine in the speeds: its value at zero speeds is due to constraints that move.
    pub fn part(&self, t: f64, state: &[f64], mut change: Vec<f64>) -> Vec<f64> {
        let n = self.correction.outputs();
        let speeds = self.coordinates..self.coordinates + n;
        let (mut at, mut with, mut without) = (state.to_vec(), vec![0.0; n], vec![0.0; n]);
        at[speeds.clone()].fill(0.0);
        self.correction.call(t, &at, &mut without);
        let coordinates = if self.coordinates == n { 0..n } else { 0..0 };
        for part in [coordinates, speeds.clone()].into_iter().filter(|part| !part.is_empty()) {
            at[speeds.clone()].copy_from_slice(&change[part.clone()]);
            self.correction.call(t, &at, &mut with);
            for ((entry, with), without) in change[part].iter_mut().zip(&with).zip(&without) {
                *entry += with - without;
            }
        }
        change
    }
}

/// Add a change, and return its size relative to the changed vector; NaN if an entry is NaN.
fn apply(change: &[f64], state: &mut [f64]) -> f64 {
    let (mut size, mut scale) = (0.0_f64, 1.0_f64);
    for (x, dx) in state.iter_mut().zip(change) {
        *x += dx;
        size = if dx.is_nan() { f64::NAN } else { size.max(dx.abs()) };
        scale = scale.max(x.abs());
        if size.is_nan() {
            return size;
        }
    }
    size / scale
}
