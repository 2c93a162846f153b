//! Events: zeros of functions of time and state, located in the dense output of a step.

use crate::dynamics::{Dynamics, EventKind};
use crate::excursion::{Point, may_pass, noise, point_beyond, three};
use crate::failure::Failure;
use crate::machine_code::BoundCode;
use crate::part::{PARTS, end_of_part};
use crate::projection::Projection;
use crate::stepper::{Sight, Stepper};
use crate::tolerances::Tolerances;

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
    tolerances: Tolerances,
    /// The instant up to which it has looked, and the values there.
    t: f64,
    values: Vec<f64>,
    /// An instant, and the state there.
    place: Vec<f64>,
    /// The instants and states at the ends of the parts of a step, and the values there, one after another.
    rows: Vec<f64>,
    ends: Vec<f64>,
    /// The values at the place.
    at_place: Vec<f64>,
}

impl<'a> Watch<'a> {
    pub fn new(dynamics: &'a Dynamics, tolerances: Tolerances, t: f64, state: &[f64]) -> Self {
        let functions = dynamics.events.as_ref().map(|(f, kinds)| (f, kinds.as_slice()));
        let values = vec![0.0; functions.map_or(0, |(f, _)| f.outputs())];
        let parts = if functions.is_some() { PARTS } else { 0 };
        let at_place = values.clone();
        let place: Vec<f64> = std::iter::once(t).chain(state.iter().copied()).collect();
        let (rows, ends) = (vec![0.0; parts * place.len()], vec![0.0; parts * values.len()]);
        let mut new = Self { functions, tolerances, t, values, place, rows, ends, at_place };
        if let Some((function, _)) = functions {
            function.call_rows(&new.place, &mut new.values);
        }
        new
    }

    /// Whether there are events.
    pub fn is_needed(&self) -> bool {
        self.functions.is_some()
    }

    /// Whether it has looked beyond an instant: a step was repeated, and the new one is shorter.
    pub fn is_ahead_of(&self, t: f64) -> bool {
        self.is_needed() && self.t > t
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
        // A step that was repeated may end at an instant that was already checked.
        let end = stepper.t();
        if end <= self.t {
            return Ok(Vec::new());
        }
        match stepper.sight() {
            Sight::Unknown => self.evaluate_parts(function, (stepper, projection), end)?,
            Sight::Nothing => {
                stepper.read_event_values_at_end(&mut self.values);
                self.t = end;
                return Ok(Vec::new());
            }
            Sight::Crossing { t } => {
                self.t = t;
                stepper.read_event_values(&mut self.values, &mut self.ends);
            }
        }
        let start = self.t;
        let mut found = self.excursions((function, kinds), (stepper, projection), end)?;
        for part in 1..=PARTS {
            let (t, first) = (end_of_part(part, start, end), (part - 1) * self.values.len());
            for (event, kind) in kinds.iter().enumerate() {
                let after = self.ends[first + event];
                if crosses(self.values[event], after, kind.direction) {
                    let bracket = ((self.t, self.values[event]), (t, after));
                    found.push(self.locate(function, (stepper, projection), event, bracket)?);
                }
            }
            // A zero at the end of a part belongs to that part: the next part starts with the sign after it.
            let next = first..first + self.values.len();
            self.values.copy_from_slice(&self.ends[next]);
            self.t = t;
        }
        Ok(until_terminal(found, kinds))
    }

    /// Write the values at the ends of the parts of the last step, all at once.
    fn evaluate_parts(
        &mut self,
        function: &BoundCode,
        (stepper, projection): (&mut dyn Stepper, &mut Projection<'_>),
        end: f64,
    ) -> Result<(), Failure> {
        for (part, row) in (1..=PARTS).zip(self.rows.chunks_mut(self.place.len())) {
            row[0] = end_of_part(part, self.t, end);
            projection.read(stepper, row[0], &mut row[1..])?;
        }
        function.call_rows(&self.rows, &mut self.ends);
        Ok(())
    }

    /// The events of functions that pass zero between two ends of parts and come back.
    fn excursions(
        &mut self,
        (function, kinds): (&BoundCode, &[EventKind]),
        (stepper, projection): (&mut dyn Stepper, &mut Projection<'_>),
        end: f64,
    ) -> Result<Vec<Occurrence>, Failure> {
        let (mut found, start) = (Vec::new(), self.t);
        for (event, kind) in kinds.iter().enumerate() {
            let values = self.course(event);
            let most = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
            let noise = noise(most, &self.tolerances);
            let point = |place: usize| (end_of_part(place, start, end), values[place]);
            for place in 0..values.len() {
                let three = three(place);
                // A zero at the end of a part is an event of that part, and one at the start of the motion is none.
                let is_event = place > 0 && values[place] == 0.0;
                if is_event || !may_pass(three.map(|place| values[place]), values[place], noise) {
                    continue;
                }
                let nearest = three.iter().take_while(|other| **other < place).count();
                let mut value = |t| self.value(function, (&mut *stepper, &mut *projection), event, t);
                let Some(inside) = point_beyond(three.map(point), nearest, noise, &mut value)? else {
                    continue;
                };
                let ends = (point(place.saturating_sub(1)), point((place + 1).min(PARTS)));
                for bracket in [(ends.0, inside), (inside, ends.1)] {
                    if crosses(bracket.0.1, bracket.1.1, kind.direction) {
                        found.push(self.locate(function, (stepper, projection), event, bracket)?);
                    }
                }
            }
        }
        Ok(found)
    }

    /// The values of a function at the start of the last step and at the ends of its parts.
    fn course(&self, event: usize) -> [f64; PARTS + 1] {
        let count = self.values.len();
        std::array::from_fn(|part| {
            if part == 0 { self.values[event] } else { self.ends[(part - 1) * count + event] }
        })
    }

    /// The value of a function at an instant of the last step; `self.place` has the state there.
    fn value(
        &mut self,
        function: &BoundCode,
        (stepper, projection): (&mut dyn Stepper, &mut Projection<'_>),
        event: usize,
        t: f64,
    ) -> Result<f64, Failure> {
        self.place[0] = t;
        projection.read(stepper, t, &mut self.place[1..])?;
        function.call_rows(&self.place, &mut self.at_place);
        Ok(self.at_place[event])
    }

    /// Find a zero between two points by Chandrupatla's method: the end of the last bracket, at which the function has
    /// its sign after the zero.
    fn locate(
        &mut self,
        function: &BoundCode,
        (stepper, projection): (&mut dyn Stepper, &mut Projection<'_>),
        event: usize,
        (before, after): (Point, Point),
    ) -> Result<Occurrence, Failure> {
        let mut bracket = Bracket::new(before, after);
        for _ in 0..EVALUATIONS {
            let Some(instant) = bracket.next() else { break };
            let value = self.value(function, (&mut *stepper, &mut *projection), event, instant)?;
            bracket.put(instant, value);
        }
        let t = bracket.end();
        let mut state = vec![0.0; self.place.len() - 1];
        projection.read(stepper, t, &mut state)?;
        Ok(Occurrence { event, t, state })
    }
}

/// The most evaluations until a zero is accepted: bisection needs half as many.
const EVALUATIONS: usize = 100;

/// A bracket of a zero, of instants with values of a function.
///
/// T. R. Chandrupatla, A new hybrid quadratic/bisection algorithm for finding the zero of a nonlinear function without
/// using derivatives, Advances in Engineering Software 28 (1997).
struct Bracket {
    newest: Point,
    /// The point on the other side of the zero.
    beyond: Point,
    /// The point that is left out last.
    last: Point,
    /// The next point, as a fraction of the way from the newest to the one beyond.
    part: f64,
}

impl Bracket {
    fn new(before: Point, after: Point) -> Self {
        Self { newest: after, beyond: before, last: before, part: 0.5 }
    }

    /// The end of the bracket.
    fn end(&self) -> f64 {
        if self.newest.1 == 0.0 { self.newest.0 } else { self.newest.0.max(self.beyond.0) }
    }

    /// The next instant to look at; `None` if the zero is known.
    fn next(&self) -> Option<f64> {
        let (here, there) = (self.newest.0, self.beyond.0);
        let least = 2.0 * f64::EPSILON * here.abs().max(there.abs()) / (there - here).abs();
        let is_found = self.newest.1 == 0.0 || least.is_nan() || least > 0.5;
        (!is_found).then(|| here + self.part.max(least).min(1.0 - least) * (there - here))
    }

    /// Take the value at the next instant.
    fn put(&mut self, t: f64, value: f64) {
        if (value > 0.0) == (self.newest.1 > 0.0) {
            self.last = self.newest;
        } else {
            (self.last, self.beyond) = (self.beyond, self.newest);
        }
        self.newest = (t, value);
        self.part = self.fraction();
    }

    /// Inverse quadratic interpolation through the three points where it is safe, and bisection elsewhere.
    fn fraction(&self) -> f64 {
        let ((x1, f1), (x2, f2), (x3, f3)) = (self.newest, self.beyond, self.last);
        let (xi, phi) = ((x1 - x2) / (x3 - x2), (f1 - f2) / (f3 - f2));
        if phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi {
            f1 / (f2 - f1) * (f3 / (f2 - f3)) + (x3 - x1) / (x2 - x1) * (f1 / (f3 - f1)) * (f2 / (f3 - f2))
        } else {
            0.5
        }
    }
}

/// The events in order of time, up to the first that ends the motion.
fn until_terminal(mut found: Vec<Occurrence>, kinds: &[EventKind]) -> Vec<Occurrence> {
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
    found
}

/// Whether a function that changes from one value to another passes zero in a direction; a start at zero does not
/// count.
#[allow(clippy::inline_always, reason = "loops over lanes are compiled for the vectors of their caller")]
#[inline(always)]
pub fn crosses(before: f64, after: f64, direction: i32) -> bool {
    let rises = before < 0.0 && after >= 0.0;
    let falls = before > 0.0 && after <= 0.0;
    (rises && direction >= 0) || (falls && direction <= 0)
}
