//! The loop of an integration.

use crate::balance::{Balance, Imbalance};
use crate::branch::Branch;
use crate::dynamics::Dynamics;
use crate::event::{Occurrence, Watch};
use crate::failure::Failure;
use crate::method::{Method, Tolerances};
use crate::projection::Projection;
use crate::start::start;
use crate::stepper::{Statistics, Stepper};
use crate::trail::Trail;

/// Steps between two looks at whoever watches.
const STEPS_BETWEEN_LOOKS: usize = 64;
/// A motion that advances by less than this part of its whole in so many steps never comes to its end.
const STALLED: (u32, f64) = (100_000, 1e-4);
/// And so does one of which so many steps in a row end where it has been.
const BACK: usize = 200;

/// A step that ends too close to a singular position is tried again with these parts of its length, and ends before it.
const AGAIN: [f64; 12] =
    [0.6, 0.36, 0.216, 0.13, 0.0778, 0.0467, 0.028, 0.0168, 0.0101, 0.00605, 0.00363, 0.00218];
/// Where steps are held back, so that they would all end there, it is crossed by a longer one.
const CROSS: [f64; 12] = [4.0, 16.0, 64.0, 256.0, 8.0, 32.0, 128.0, 512.0, 45.0, 90.0, 180.0, 360.0];

/// Where the states of the asked instants are written.
pub struct Record<'a> {
    /// The instants, increasing; the first is where the motion begins.
    pub instants: &'a [f64],
    /// The states, one after another.
    pub states: &'a mut [f64],
    /// How many states at the ends of steps are kept beside these, at most.
    pub trail: usize,
}

/// How an integration went.
#[derive(Clone, Debug)]
pub struct Run {
    /// How many of the instants were reached.
    pub reached: usize,
    /// The events, in order of time.
    pub occurrences: Vec<Occurrence>,
    /// Where the motion ended: after the last instant, at an event, or where it failed.
    pub end: (f64, Vec<f64>),
    /// Why it ended early, if not by an event.
    pub failure: Option<Failure>,
    /// What is off in the balance of energy, if that is more than errors explain.
    pub imbalance: Option<Imbalance>,
    /// The instants and states at the ends of steps, one after another, as far as they were to be kept.
    pub trail: Vec<f64>,
    /// The begin of the first step that was taken although its branch of the constraints is not certain.
    pub uncertain: Option<f64>,
    /// What it took.
    pub statistics: Statistics,
}

/// Integrate from a state at the first instant through all of them.
///
/// Between steps `keep_going` is asked now and then, with the instant that was reached.
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
            watch: Watch::new(dynamics, t, state),
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

/// A motion as it is computed.
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
        for step in 1.. {
            if stepper.t() >= end {
                break;
            }
            self.step(stepper, end, run)?;
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
                // What was read behind the event is no part of the motion.
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

    /// Take a step whose end is on the constraints, and on the branch of the state before it.
    ///
    /// Close to a singular position a step may end where none can begin, or its dense output may be noise: then another
    /// length is tried, which ends elsewhere. What only might be better is accepted in the end, and noted.
    fn step(&mut self, stepper: &mut dyn Stepper, end: f64, run: &mut Run) -> Result<(), Failure> {
        let parts = if stepper.is_held_back() { CROSS } else { AGAIN };
        let (mut first, mut tried) = (None, 1.0);
        for time in 0.. {
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

    /// Write the states at the instants of the last step; whether they, and its dense output, are on the branch of its ends.
    fn is_read_well(&mut self, stepper: &mut dyn Stepper, run: &Run) -> Result<bool, Failure> {
        let (n, t) = (stepper.state().len(), stepper.t());
        let instants = &self.record.instants[run.reached..];
        let is_asked = instants.first().is_some_and(|&instant| instant < t);
        let mut is_well = !(is_asked || self.watch.is_needed()) || stepper.reads_well();
        for (place, &instant) in instants.iter().enumerate().take_while(|(_, instant)| **instant <= t) {
            let out = &mut self.record.states[(run.reached + place) * n..][..n];
            is_well &= self.projection.read(stepper, instant, out)?;
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

    /// Go on from the state on the constraints; the motion is known up to there.
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

/// Sees that time goes on.
struct Patience {
    /// Where time was when it was looked at.
    seen: f64,
    /// What it has to advance by until the next look.
    least: f64,
    /// How far it has come, and how many steps ago.
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
        if step % STALLED.0 as usize == 0 {
            let advance = t - self.seen;
            if advance < self.least {
                return Err(Failure::Stalled { t, step: advance / f64::from(STALLED.0) });
            }
            self.seen = t;
        }
        Ok(())
    }
}
