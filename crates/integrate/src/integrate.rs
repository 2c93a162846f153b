//! The loop of an integration.

use crate::branch::Branch;
use crate::dynamics::Dynamics;
use crate::energy_balance::{Balance, Imbalance, LOOK};
use crate::event::{Occurrence, Watch};
use crate::failure::Failure;
use crate::method::Method;
use crate::projection::Projection;
use crate::start::start;
use crate::stepper::{Statistics, Stepper, Stretch};
use crate::tolerances::Tolerances;
use crate::trail::Trail;

/// The number of steps between two calls of `keep_going`.
const STEPS_BETWEEN_LOOKS: usize = 64;
/// A motion that advances by less than this fraction of its duration in this many steps never reaches its end.
const STALLED: (u32, f64) = (100_000, 1e-4);
/// The same holds for a motion of which this many successive steps end at instants that it has passed.
const BACK: usize = 200;

/// A step that ends too close to a singular position is repeated with these fractions of its length, and ends before
/// it.
const AGAIN: [f64; 12] =
    [0.6, 0.36, 0.216, 0.13, 0.0778, 0.0467, 0.028, 0.0168, 0.0101, 0.00605, 0.00363, 0.00218];
/// If `max_step` holds steps back, so that all of them would end there, a longer step crosses the position.
const CROSS: [f64; 12] = [4.0, 16.0, 64.0, 256.0, 8.0, 32.0, 128.0, 512.0, 45.0, 90.0, 180.0, 360.0];

/// The requested instants, and the memory for their states.
pub struct Record<'a> {
    /// The instants in increasing order; the motion starts at the first.
    pub instants: &'a [f64],
    /// The states, one after another.
    pub states: &'a mut [f64],
    /// The most states at the ends of steps that are kept as well.
    pub trail: usize,
}

/// The result of an integration.
#[derive(Clone, Debug)]
pub struct Run {
    /// The number of instants that were reached.
    pub reached: usize,
    /// The events, in order of time.
    pub occurrences: Vec<Occurrence>,
    /// Where the motion ended: after the last instant, at an event, or where it failed.
    pub end: (f64, Vec<f64>),
    /// The reason why it ended early, other than an event.
    pub failure: Option<Failure>,
    /// The violation of the balance of energy, if it exceeds what errors explain.
    pub imbalance: Option<Imbalance>,
    /// The instants and states at the ends of steps that were kept, one after another.
    pub trail: Vec<f64>,
    /// The start of the first step that was accepted although its branch of the constraints is uncertain.
    pub uncertain: Option<f64>,
    /// The cost of the integration.
    pub statistics: Statistics,
}

/// Integrate from a state at the first instant through all of them.
///
/// Every few steps `keep_going` is called with the instant that was reached; the integration stops if it returns false.
pub fn integrate(
    dynamics: &Dynamics,
    method: Method,
    state: &[f64],
    record: Record<'_>,
    tolerances: Tolerances,
    keep_going: &mut dyn FnMut(f64) -> bool,
) -> Run {
    let (t, end) = (record.instants[0], record.instants[record.instants.len() - 1]);
    let n = state.len();
    record.states[..n].copy_from_slice(state);
    let mut run = Run {
        reached: 1,
        occurrences: Vec::new(),
        end: (t, state.to_vec()),
        failure: None,
        imbalance: None,
        trail: Vec::new(),
        uncertain: None,
        statistics: Statistics::default(),
    };
    let motion = |stepper: &mut dyn Stepper| {
        let mut course = Course {
            trail: Trail::new(record.trail, t, state),
            record,
            watch: Watch::new(dynamics, tolerances, t, state),
            projection: Projection::new(dynamics),
            branch: Branch::new(method, tolerances),
            balance: Balance::new(dynamics, tolerances, t, state),
            state: state.to_vec(),
        };
        run.failure = course.follow(stepper, end, &mut run, keep_going).err();
        run.statistics = stepper.statistics();
        run.uncertain = run.uncertain.or(run.statistics.uncertain);
        run.imbalance = course.balance.imbalance(run.end.0, &run.end.1, run.statistics.errors);
        run.trail = course.trail.into_rows();
    };
    if let Err(failure) = start(method, dynamics, (t, end), state, tolerances, motion) {
        run.failure = Some(failure);
    }
    run
}

/// A motion in progress.
struct Course<'a> {
    record: Record<'a>,
    watch: Watch<'a>,
    projection: Projection<'a>,
    branch: Branch,
    balance: Balance<'a>,
    trail: Trail,
    /// The state at the end of a step, on the constraints.
    state: Vec<f64>,
}

impl Course<'_> {
    fn follow(
        &mut self,
        stepper: &mut dyn Stepper,
        end: f64,
        run: &mut Run,
        keep_going: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(), Failure> {
        let mut patience = Patience::new(stepper.t(), end);
        let mut step = 0;
        while stepper.t() < end {
            step += self.step(stepper, (step, end), run)?;
            let events = self.watch.events_of_step(stepper, &mut self.projection)?;
            let last = events
                .last()
                .filter(|event| self.is_terminal(event))
                .map(|event| (event.t, event.state.clone()));
            run.occurrences.extend(events);
            let until = last.as_ref().map_or(stepper.t(), |(t, _)| *t);
            let read = self.record.instants[run.reached..].iter().take_while(|instant| **instant <= until);
            run.reached += read.count();
            if let Some(place) = last {
                // The states after the event are not part of the motion.
                self.record.states[run.reached * place.1.len()..].fill(f64::NAN);
                run.end = place;
                return Ok(());
            }
            self.end_step(stepper, run);
            self.balance.watch(step, run.end.0, &run.end.1);
            self.trail.note(run.end.0, &run.end.1);
            patience.check(step, stepper.t())?;
            if step % STEPS_BETWEEN_LOOKS == 0 && !keep_going(stepper.t()) {
                return Err(Failure::Interrupted { t: stepper.t() });
            }
        }
        Ok(())
    }

    /// Take a step, or several if nothing happens in those before the last; return how many.
    fn step(
        &mut self,
        stepper: &mut dyn Stepper,
        (step, end): (usize, f64),
        run: &mut Run,
    ) -> Result<usize, Failure> {
        let is_looking = stepper.looks_for_events() && !self.watch.is_ahead_of(stepper.t());
        let has_events = self.watch.is_needed() && !is_looking;
        let before = stepper.statistics().steps;
        let until = self.record.instants.get(run.reached).copied().unwrap_or(end);
        let stretch = Stretch { until, steps: LOOK.0 - step % LOOK.0 };
        if has_events || self.record.trail > 0 {
            self.step_and_land(stepper, end, run)?;
            return Ok(1);
        }
        if self.projection.is_needed() {
            return self.advance_and_land(stepper, (end, stretch), run);
        }
        stepper.advance(end, stretch)?;
        self.state.copy_from_slice(stepper.state());
        self.is_read_well(stepper, run)?;
        Ok(stepper.statistics().steps - before)
    }

    /// Take several steps whose ends are on the constraints, or one by all ways out of trouble; return how many.
    fn advance_and_land(
        &mut self,
        stepper: &mut dyn Stepper,
        (end, stretch): (f64, Stretch),
        run: &mut Run,
    ) -> Result<usize, Failure> {
        let (before, largest) = (stepper.statistics().steps, self.branch.largest());
        let states = (&mut run.end.1[..], &mut self.state[..]);
        let Some(landing) = stepper.advance_on_constraints(end, stretch, largest, states) else {
            self.step_and_land(stepper, end, run)?;
            return Ok(1);
        };
        run.end.0 = landing.start;
        self.branch.note(landing.largest_speed);
        let speeds = self.projection.speeds();
        self.projection.bound = self.branch.bound(&run.end.1[speeds.clone()], &stepper.state()[speeds]);
        let taken = stepper.statistics().steps - before;
        if !self.is_read_well(stepper, run)? && stepper.retract(AGAIN[0]) {
            self.try_lengths(stepper, end, run, (AGAIN, 1))?;
        }
        Ok(taken)
    }

    /// Take a step whose end is on the constraints, and on the branch of the state before it.
    ///
    /// Close to a singular position, a step may end where no step can start, or its dense output may be noise. Then
    /// other lengths are tried, which end elsewhere. If none is certain, the last one is accepted and recorded as
    /// uncertain.
    fn step_and_land(&mut self, stepper: &mut dyn Stepper, end: f64, run: &mut Run) -> Result<(), Failure> {
        let parts = if stepper.is_held_back() { CROSS } else { AGAIN };
        self.try_lengths(stepper, end, run, (parts, 0))
    }

    /// Try the regular length of a step, and these parts of it, after some that were tried.
    fn try_lengths(
        &mut self,
        stepper: &mut dyn Stepper,
        end: f64,
        run: &mut Run,
        (parts, after): ([f64; 12], usize),
    ) -> Result<(), Failure> {
        let mut first = None;
        let mut tried = if after == 0 { 1.0 } else { parts[after - 1] };
        for time in after.. {
            let is_last = !self.projection.is_needed() || time == parts.len();
            if is_last || stepper.starts_well() {
                match stepper.step(end).and_then(|()| self.land(stepper, &run.end.1)) {
                    Ok(()) => {
                        let is_certain = self.is_read_well(stepper, run)?;
                        if is_last && time > 0 {
                            run.uncertain.get_or_insert(run.end.0);
                        }
                        if is_last || is_certain {
                            return Ok(());
                        }
                    }
                    Err(failure) => first = first.or(Some(failure)),
                }
            }
            if is_last || !stepper.retract(parts[time] / tried) {
                return first.map_or(Ok(()), Err);
            }
            tried = parts[time];
        }
        Ok(())
    }

    /// Write the states at the instants of the last step. Return whether the dense output is on the branch of its ends.
    ///
    /// At an instant in a singular position, the constraints do not determine the speeds: the state is that of the
    /// dense output. Other lengths of the step would not change that, and would only end ever closer to the position.
    fn is_read_well(&mut self, stepper: &mut dyn Stepper, run: &Run) -> Result<bool, Failure> {
        let (n, t) = (stepper.state().len(), stepper.t());
        let instants = &self.record.instants[run.reached..];
        let is_asked = instants.first().is_some_and(|&instant| instant < t);
        let is_well = !(is_asked || self.watch.is_needed()) || stepper.reads_well();
        for (place, &instant) in instants.iter().enumerate().take_while(|(_, instant)| **instant <= t) {
            let out = &mut self.record.states[(run.reached + place) * n..][..n];
            self.projection.read(stepper, instant, out)?;
        }
        Ok(is_well)
    }

    /// Find the state on the constraints at the end of a step.
    fn land(&mut self, stepper: &dyn Stepper, before: &[f64]) -> Result<(), Failure> {
        self.state.copy_from_slice(stepper.state());
        if !self.projection.is_needed() {
            return Ok(());
        }
        let speeds = self.projection.speeds();
        self.projection.bound = self.branch.bound(&before[speeds.clone()], &self.state[speeds]);
        self.projection.project(stepper.t(), &mut self.state)
    }

    /// Continue from the state on the constraints; the motion is known up to its instant.
    fn end_step(&mut self, stepper: &mut dyn Stepper, run: &mut Run) {
        if self.projection.is_needed() {
            stepper.replace(&self.state);
        }
        run.end.0 = stepper.t();
        run.end.1.copy_from_slice(&self.state);
    }

    fn is_terminal(&self, event: &Occurrence) -> bool {
        self.watch.kind(event.event).is_some_and(|kind| kind.terminal)
    }
}

/// Checks that time advances.
struct Patience {
    /// The instant of the last check.
    seen: f64,
    /// The least advance until the next check.
    least: f64,
    /// The latest instant that was reached, and the number of the step that reached it.
    farthest: (f64, usize),
}

impl Patience {
    fn new(t: f64, end: f64) -> Self {
        Self { seen: t, least: STALLED.1 * (end - t), farthest: (t, 0) }
    }

    fn check(&mut self, step: usize, t: f64) -> Result<(), Failure> {
        if t > self.farthest.0 {
            self.farthest = (t, step);
        } else if step - self.farthest.1 > BACK {
            return Err(Failure::Stalled { t, step: 0.0 });
        }
        if step.is_multiple_of(STALLED.0 as usize) {
            let advance = t - self.seen;
            if advance < self.least {
                return Err(Failure::Stalled { t, step: advance / f64::from(STALLED.0) });
            }
            self.seen = t;
        }
        Ok(())
    }
}
