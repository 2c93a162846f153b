//! Events: zeros of functions of time and state, located in the dense output of a step.

use crate::dynamics::{Dynamics, EventKind};
use crate::failure::Failure;
use crate::machine_code::BoundCode;
use crate::projection::Projection;
use crate::stepper::Stepper;

/// The number of parts of a step at whose ends signs are compared, because a long step may contain many zeros.
const PARTS: u32 = 10;

/// An event that happened.
#[derive(Clone, Debug, PartialEq)]
pub struct Occurrence {
    /// The number of the function that was zero.
    pub event: usize,
    /// The instant.
    pub t: f64,
    /// The state at that instant.
    pub state: Vec<f64>,
}

/// Looks for events, step by step.
pub struct Watch<'a> {
    functions: Option<(&'a BoundCode, &'a [EventKind])>,
    t: f64,
    values: Vec<f64>,
    state: Vec<f64>,
    /// The instants and states at the ends of the parts of a step, and the values there, one after another.
    rows: Vec<f64>,
    ends: Vec<f64>,
}

impl<'a> Watch<'a> {
    pub fn new(dynamics: &'a Dynamics, t: f64, state: &[f64]) -> Self {
        let functions = dynamics.events.as_ref().map(|(f, kinds)| (f, kinds.as_slice()));
        let mut values = vec![0.0; functions.map_or(0, |(f, _)| f.outputs())];
        if let Some((f, _)) = functions {
            f.call(t, state, &mut values);
        }
        let parts = if functions.is_some() { PARTS as usize } else { 0 };
        let (rows, ends) = (vec![0.0; parts * (1 + state.len())], vec![0.0; parts * values.len()]);
        Self { functions, t, values, state: state.to_vec(), rows, ends }
    }

    /// Whether there are events.
    pub fn is_needed(&self) -> bool {
        self.functions.is_some()
    }

    /// The kind of an event; `None` if there are no events.
    pub fn kind(&self, event: usize) -> Option<EventKind> {
        self.functions.and_then(|(_, kinds)| kinds.get(event)).copied()
    }

    /// The events since the last call, in order of time, up to the first that ends the motion.
    pub fn events_of_step(
        &mut self,
        stepper: &mut dyn Stepper,
        projection: &mut Projection<'_>,
    ) -> Result<Vec<Occurrence>, Failure> {
        let Some((function, kinds)) = self.functions else { return Ok(Vec::new()) };
        let (start, end) = (self.t, stepper.t());
        // A step that was repeated may end at an instant that was already checked.
        if end <= start {
            return Ok(Vec::new());
        }
        let mut found: Vec<Occurrence> = Vec::new();
        self.evaluate_parts(function, (stepper, projection), end)?;
        for part in 0..PARTS as usize {
            let (t, first) = (self.rows[part * (1 + self.state.len())], part * self.values.len());
            for (event, kind) in kinds.iter().enumerate() {
                let after = self.ends[first + event];
                if crosses(self.values[event], after, kind.direction) {
                    let bracket = (t, self.values[event], after);
                    let zero = self.locate(function, (stepper, projection), event, bracket)?;
                    found.push(Occurrence { event, t: zero, state: self.state.clone() });
                }
            }
            // A zero at the end of a part belongs to that part: the next part starts with the sign after it.
            let next = first..first + self.values.len();
            self.values.copy_from_slice(&self.ends[next]);
            self.t = t;
        }
        // Of events at one instant, those that end the motion come last, so that the others are recorded.
        let is_terminal = |occurrence: &Occurrence| kinds[occurrence.event].terminal;
        found.sort_by(|a, b| {
            let order = a.t.total_cmp(&b.t).then(is_terminal(a).cmp(&is_terminal(b)));
            order.then(a.event.cmp(&b.event))
        });
        if let Some(last) = found.iter().position(is_terminal) {
            let t = found[last].t;
            found.retain(|occurrence| occurrence.t <= t);
        }
        Ok(found)
    }

    /// Write the values at the ends of the parts of the last step, all at once.
    fn evaluate_parts(
        &mut self,
        function: &BoundCode,
        (stepper, projection): (&mut dyn Stepper, &mut Projection<'_>),
        end: f64,
    ) -> Result<(), Failure> {
        let (start, width) = (self.t, 1 + self.state.len());
        for (part, row) in (1..=PARTS).zip(self.rows.chunks_mut(width)) {
            row[0] =
                if part == PARTS { end } else { start + (end - start) * f64::from(part) / f64::from(PARTS) };
            projection.read(stepper, row[0], &mut row[1..])?;
        }
        function.call_rows(&self.rows, &mut self.ends);
        Ok(())
    }

    /// Find a zero between the last checked instant and `t` by the Illinois method, secants that keep the bracket.
    /// Leave the state at the zero in `self.state`.
    fn locate(
        &mut self,
        function: &BoundCode,
        (stepper, projection): (&mut dyn Stepper, &mut Projection<'_>),
        event: usize,
        (mut b, before, mut at_b): (f64, f64, f64),
    ) -> Result<f64, Failure> {
        let (mut a, mut at_a) = (self.t, before);
        let mut values = vec![0.0; function.outputs()];
        let mut zero = b;
        for _ in 0..100 {
            let width = b - a;
            if at_b == 0.0 || width <= 4.0 * f64::EPSILON * b.abs().max(a.abs()) {
                zero = b;
                break;
            }
            zero = (b - at_b * width / (at_b - at_a)).clamp(a + 0.001 * width, b - 0.001 * width);
            self.evaluate(function, (stepper, projection), zero, &mut values)?;
            let value = values[event];
            if (value > 0.0) == (at_b > 0.0) && value != 0.0 {
                (b, at_b, at_a) = (zero, value, at_a / 2.0);
            } else if value == 0.0 {
                (b, at_b) = (zero, 0.0);
            } else {
                (a, at_a, at_b) = (zero, value, at_b / 2.0);
            }
        }
        self.evaluate(function, (stepper, projection), zero, &mut values)?;
        Ok(zero)
    }

    /// Write the values of the functions at an instant of the last step, and keep the state at that instant.
    fn evaluate(
        &mut self,
        function: &BoundCode,
        (stepper, projection): (&mut dyn Stepper, &mut Projection<'_>),
        t: f64,
        out: &mut [f64],
    ) -> Result<(), Failure> {
        projection.read(stepper, t, &mut self.state)?;
        function.call(t, &self.state, out);
        Ok(())
    }
}

/// Whether a function that changes from one value to another passes zero in a direction; a start at zero does not
/// count.
fn crosses(before: f64, after: f64, direction: i32) -> bool {
    let rises = before < 0.0 && after >= 0.0;
    let falls = before > 0.0 && after <= 0.0;
    (rises && direction >= 0) || (falls && direction <= 0)
}
