//! The methods of the library diffsol (MIT): explicit and implicit, one-step and multistep methods.

use std::cell::{Cell, RefCell};

use diffsol::{
    DiffsolError, NalgebraContext, NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations,
    OdeSolverMethod, OdeSolverStopReason, Vector as _,
};

use crate::dynamics::Dynamics;
use crate::failure::Failure;
use crate::machine_code::BoundCode;
use crate::stepper::{Statistics, Stepper};
use crate::tolerances::{INTEGRAL, Tolerances};

type Matrix = NalgebraMat<f64>;
type Vector = NalgebraVec<f64>;
type Solver = NalgebraLU<f64>;

/// How far the state of a multistep method may be off the constraints, in tolerances, before the method is restarted.
const DEVIATION: f64 = 100.0;

/// Counts of evaluations, and whether their results were finite.
#[derive(Default)]
struct Calls {
    evaluations: Cell<usize>,
    jacobians: Cell<usize>,
    /// The last instant at which the rates were not finite.
    not_finite_at: Cell<Option<f64>>,
}

impl Calls {
    /// The failure for rates that were not finite at `t` or later, if there were any.
    fn not_finite_from(&self, t: f64) -> Option<Failure> {
        self.not_finite_at.get().filter(|&at| at >= t || at.is_nan()).map(|_| Failure::NotFinite { t })
    }
}

/// The Jacobian at the instant and state of its last evaluation.
struct Jacobian<'a> {
    function: Option<&'a (BoundCode, Vec<(usize, usize)>)>,
    at: RefCell<(f64, Vec<f64>)>,
    entries: RefCell<Vec<f64>>,
}

impl<'a> Jacobian<'a> {
    fn new(dynamics: &'a Dynamics) -> Self {
        let function = dynamics.jacobian.as_ref();
        let entries = vec![0.0; function.map_or(0, |(f, _)| f.outputs())];
        Self { function, at: RefCell::new((f64::NAN, Vec::new())), entries: RefCell::new(entries) }
    }

    /// Write the product with a vector; the library requests all columns at one state, one after another.
    fn multiply(&self, t: f64, state: &[f64], vector: &[f64], out: &mut [f64], calls: &Calls) {
        out.fill(0.0);
        let Some((function, places)) = self.function else { return };
        let mut at = self.at.borrow_mut();
        let mut entries = self.entries.borrow_mut();
        if at.0.total_cmp(&t).is_ne() || at.1 != state {
            function.call(t, state, &mut entries);
            *at = (t, state.to_vec());
            calls.jacobians.set(calls.jacobians.get() + 1);
        }
        for (&(row, column), entry) in places.iter().zip(entries.iter()) {
            out[row] += entry * vector[column];
        }
    }
}

/// The methods of the library that are used; all of them are implicit.
#[derive(Clone, Copy, Debug)]
pub enum Formula {
    /// Backward differentiation formulae of variable order.
    Bdf,
    /// A singly diagonally implicit Runge–Kutta method of order 3.
    Esdirk34,
    /// The trapezoidal rule with a backward differentiation formula, of order 2.
    TrBdf2,
}

/// Run `then` with a stepper of the library.
pub fn start<R>(
    formula: Formula,
    dynamics: &Dynamics,
    t: f64,
    state: &[f64],
    tolerances: Tolerances,
    then: impl FnOnce(&mut dyn Stepper) -> R,
) -> Result<R, Failure> {
    let (calls, jacobian) = (Calls::default(), Jacobian::new(dynamics));
    let failed = |error: DiffsolError| failure(&error, t, &calls);
    let mut problem = OdeBuilder::<Matrix>::new()
        .t0(t)
        .rtol(tolerances.relative)
        .atol(
            (0..state.len())
                .map(|i| if i < tolerances.controlled { tolerances.absolute } else { f64::MAX.sqrt() }),
        )
        .rhs_implicit(
            |y: &[f64], _: &[f64], t: f64, out: &mut [f64]| {
                dynamics.rates.call(t, y, out);
                calls.evaluations.set(calls.evaluations.get() + 1);
                if !out.iter().all(|rate| rate.is_finite()) {
                    calls.not_finite_at.set(Some(t));
                }
            },
            |y: &[f64], _: &[f64], t: f64, v: &[f64], out: &mut [f64]| {
                jacobian.multiply(t, y, v, out, &calls);
            },
        )
        .init(|_: &[f64], _: f64, y: &mut [f64]| y.copy_from_slice(state), state.len())
        .build()
        .map_err(failed)?;
    problem.ode_options.min_timestep = 1e-16 * t.abs().max(1e-3);
    problem.ode_options.max_nonlinear_solver_failures = usize::MAX;
    let (rates, calls) = (&dynamics.rates, &calls);
    Ok(match formula {
        Formula::Esdirk34 => {
            run(problem.esdirk34::<Solver>().map_err(failed)?, true, rates, calls, tolerances, then)
        }
        Formula::TrBdf2 => {
            run(problem.tr_bdf2::<Solver>().map_err(failed)?, true, rates, calls, tolerances, then)
        }
        Formula::Bdf => run(problem.bdf::<Solver>().map_err(failed)?, false, rates, calls, tolerances, then),
    })
}

fn run<'a, E, S, R>(
    solver: S,
    has_one_step: bool,
    rates: &BoundCode,
    calls: &Calls,
    tolerances: Tolerances,
    then: impl FnOnce(&mut dyn Stepper) -> R,
) -> R
where
    E: OdeEquations<T = f64, V = Vector> + 'a,
    S: OdeSolverMethod<'a, E>,
{
    let state = solver.state();
    let (t, y) = (state.t, state.y.batch_as_slice(0).to_vec());
    let out = Vector::from_slice(&y, NalgebraContext::default());
    let mut library = Library {
        solver,
        has_one_step,
        rates,
        calls,
        tolerances,
        t,
        before: (t, y.clone()),
        by_method: y[tolerances.controlled..].to_vec(),
        is_right: false,
        state: y,
        out,
        steps: 0,
        retracted: 0,
        marker: std::marker::PhantomData::<&'a E>,
    };
    then(&mut library)
}

struct Library<'a, 'c, E, S> {
    solver: S,
    has_one_step: bool,
    rates: &'c BoundCode,
    calls: &'c Calls,
    tolerances: Tolerances,
    t: f64,
    state: Vec<f64>,
    /// The instant at which the last step started.
    before: (f64, Vec<f64>),
    /// The integrals along the motion that the method has there, and whether their growth in the step is accurate.
    by_method: Vec<f64>,
    is_right: bool,
    out: Vector,
    steps: usize,
    retracted: usize,
    marker: std::marker::PhantomData<&'a E>,
}

impl<'a, E, S> Library<'a, '_, E, S>
where
    E: OdeEquations<T = f64, V = Vector> + 'a,
    S: OdeSolverMethod<'a, E>,
{
    /// Hand the state and its rates to the library, which drops its history.
    fn restart(&mut self) {
        self.rates.call(self.t, &self.state, self.out.batch_as_mut_slice(0));
        self.calls.evaluations.set(self.calls.evaluations.get() + 1);
        let inner = self.solver.state_mut();
        inner.y.batch_as_mut_slice(0).copy_from_slice(&self.state);
        inner.dy.batch_as_mut_slice(0).copy_from_slice(self.out.batch_as_slice(0));
    }
}

/// The most times that parts of a step are halved to integrate over them.
const HALVINGS: u32 = 8;
/// The nodes and weights of Gauss-Legendre quadrature between 0 and 1.
const QUADRATURE: [(f64, f64); 3] =
    [(0.112_701_665_379_258_31, 5.0 / 18.0), (0.5, 4.0 / 9.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

impl<'a, E, S> Library<'a, '_, E, S>
where
    E: OdeEquations<T = f64, V = Vector> + 'a,
    S: OdeSolverMethod<'a, E>,
{
    /// Correct the integrals along the motion at an instant of the last step; they follow the state of the method.
    ///
    /// The method does not control their errors, so its steps may be far too long for them where the state changes
    /// little.
    fn integrate(&mut self, t: f64, state: &mut [f64]) -> Result<(), Failure> {
        let controlled = self.tolerances.controlled;
        let by_method: Vec<f64> =
            state[controlled..].iter().zip(&self.by_method).map(|(a, b)| a - b).collect();
        let is_end = t >= self.t;
        let increase = if by_method.is_empty() || (self.is_right && !is_end) {
            by_method
        } else {
            let whole = self.quadrature(self.before.0, t)?;
            let is_right = self.agree(&whole, &by_method);
            self.is_right = if is_end { is_right } else { self.is_right };
            if is_right { whole } else { self.refined(self.before.0, t, &whole, HALVINGS)? }
        };
        for (i, part) in increase.iter().enumerate() {
            state[controlled + i] = self.before.1[controlled + i] + part;
        }
        Ok(())
    }

    /// Whether two estimates of integrals over a part of the last step differ by no more than their tolerance.
    fn agree(&self, one: &[f64], other: &[f64]) -> bool {
        let Tolerances { relative, absolute, controlled, .. } = self.tolerances;
        one.iter().zip(other).enumerate().all(|(i, (a, b))| {
            let size = self.before.1[controlled + i].abs().max(a.abs());
            (a - b).abs() <= INTEGRAL * (absolute + relative * size)
        })
    }

    /// The integrals over a part of the last step, given one estimate. Parts are halved until the two halves agree
    /// with the whole.
    fn refined(&mut self, a: f64, b: f64, whole: &[f64], halvings: u32) -> Result<Vec<f64>, Failure> {
        let middle = 0.5 * (a + b);
        let (mut left, mut right) = (self.quadrature(a, middle)?, self.quadrature(middle, b)?);
        let sums: Vec<f64> = left.iter().zip(&right).map(|(x, y)| x + y).collect();
        if halvings == 0 || self.agree(&sums, whole) {
            return Ok(sums);
        }
        left = self.refined(a, middle, &left, halvings - 1)?;
        right = self.refined(middle, b, &right, halvings - 1)?;
        Ok(left.iter().zip(&right).map(|(x, y)| x + y).collect())
    }

    /// The integrals over a part of the last step.
    fn quadrature(&mut self, a: f64, b: f64) -> Result<Vec<f64>, Failure> {
        let (controlled, width) = (self.tolerances.controlled, self.before.1.len());
        let (mut sums, mut rates) = (vec![0.0; width - controlled], vec![0.0; width]);
        for (place, weight) in QUADRATURE {
            let t = a + place * (b - a);
            let read = self.solver.interpolate_inplace(t, &mut self.out);
            read.map_err(|error| failure(&error, self.t, self.calls))?;
            self.rates.call(t, self.out.batch_as_slice(0), &mut rates);
            self.calls.evaluations.set(self.calls.evaluations.get() + 1);
            for (sum, rate) in sums.iter_mut().zip(&rates[controlled..]) {
                *sum += weight * (b - a) * rate;
            }
        }
        Ok(sums)
    }
}

impl<'a, E, S> Stepper for Library<'a, '_, E, S>
where
    E: OdeEquations<T = f64, V = Vector> + 'a,
    S: OdeSolverMethod<'a, E>,
{
    fn step(&mut self, end: f64) -> Result<(), Failure> {
        self.before.0 = self.t;
        self.before.1.copy_from_slice(&self.state);
        let by_method = &self.solver.state().y.batch_as_slice(0)[self.tolerances.controlled..];
        self.by_method.copy_from_slice(by_method);
        let stop = end.min(self.t + self.tolerances.max_step);
        let stepped = self.solver.set_stop_time(stop).and_then(|()| self.solver.step());
        let reason = stepped.map_err(|error| failure(&error, self.t, self.calls))?;
        let state = self.solver.state();
        // The library takes an error that is NaN for a small one.
        if !state.y.batch_as_slice(0).iter().all(|y| y.is_finite()) {
            return Err(Failure::NotFinite { t: self.t });
        }
        let is_at_stop = matches!(reason, OdeSolverStopReason::TstopReached);
        let step = state.t - self.t;
        // The library continues with steps that are too short to change the instant.
        if !is_at_stop && step <= 4.0 * f64::EPSILON * self.t.abs() {
            return Err(self
                .calls
                .not_finite_from(self.t)
                .unwrap_or(Failure::StepCollapse { t: self.t, step }));
        }
        self.t = if is_at_stop { stop } else { state.t };
        self.state.copy_from_slice(state.y.batch_as_slice(0));
        self.steps += 1;
        let mut state = std::mem::take(&mut self.state);
        self.integrate(self.t, &mut state)?;
        self.state = state;
        Ok(())
    }

    fn t(&self) -> f64 {
        self.t
    }

    fn state(&self) -> &[f64] {
        &self.state
    }

    fn interpolate(&mut self, t: f64, out: &mut [f64]) -> Result<(), Failure> {
        if t >= self.solver.state().t {
            out.copy_from_slice(&self.state);
            return Ok(());
        }
        let read = self.solver.interpolate_inplace(t, &mut self.out);
        read.map_err(|error| failure(&error, self.t, self.calls))?;
        out.copy_from_slice(self.out.batch_as_slice(0));
        self.integrate(t, out)
    }

    /// A restart would drop the history of a multistep method, so it continues from its own state while that is close.
    fn replace(&mut self, state: &[f64]) {
        let Tolerances { relative, absolute, .. } = self.tolerances;
        let is_far = state
            .iter()
            .zip(&self.state)
            .take(self.tolerances.controlled)
            .any(|(new, old)| (new - old).abs() > DEVIATION * (absolute + relative * old.abs()));
        if !self.has_one_step && !is_far {
            return;
        }
        self.state.copy_from_slice(state);
        self.restart();
    }

    fn retract(&mut self, part: f64) -> bool {
        let step = part * (self.t - self.before.0);
        if step <= 0.0 {
            return false;
        }
        self.t = self.before.0;
        self.state.copy_from_slice(&self.before.1);
        self.restart();
        let inner = self.solver.state_mut();
        *inner.t = self.t;
        *inner.h = step;
        self.steps -= 1;
        self.retracted += 1;
        true
    }

    fn statistics(&self) -> Statistics {
        let own = self.solver.get_statistics();
        Statistics {
            steps: self.steps,
            #[allow(clippy::cast_precision_loss, reason = "a count of steps")]
            errors: self.steps as f64,
            rejected: own.number_of_error_test_failures
                + own.number_of_nonlinear_solver_fails
                + self.retracted,
            evaluations: self.calls.evaluations.get(),
            jacobians: self.calls.jacobians.get(),
            stiff: false,
            uncertain: None,
        }
    }
}

fn failure(error: &DiffsolError, t: f64, calls: &Calls) -> Failure {
    let message = || Failure::Library { t, message: error.to_string() };
    calls.not_finite_from(t).unwrap_or_else(message)
}
