//! Steps in a lane of a crew: one beside those of other motions, or several that the crew controls.

use super::{First, RungeKutta, Tableau, Turn};
use crate::failure::Failure;
use crate::lane::{Beginning, Landed, LandingResults, Lane, StepResults};
use crate::stepper::{Landing, Stretch};

impl RungeKutta<'_> {
    /// The lane in which the next step is taken, if it is.
    pub(super) fn lane(&self) -> Option<Lane> {
        self.rates.lane().filter(|_| !self.is_careful).cloned()
    }

    /// The lane in which several steps are taken at a time, of a motion without constraints: nothing happens between them.
    pub(super) fn free_lane(&self) -> Option<Lane> {
        self.rates.lane().filter(|_| !self.projection.is_needed()).cloned()
    }

    /// The lane in which several steps are taken that end on the constraints.
    pub(super) fn lane_on_constraints(&self) -> Option<Lane> {
        self.rates.lane().filter(|lane| self.projection.is_needed() && lane.keeps_constraints()).cloned()
    }

    /// Tell the lane where the motion is.
    pub(super) fn begin_in_lane(&mut self, lane: &Lane, end: f64) {
        lane.begin(&Beginning {
            t: self.t,
            end,
            state: &self.state,
            rates: self.stages.row(0),
            sizes: &self.sizes,
            origin: &self.origin,
            last_stage: (&self.last_stage, self.stages.row(self.tableau.stages - 1)),
            last: self.last,
            last_error: self.last_error,
            stiff_steps: self.stiff_steps,
            step: self.step,
            exponent: self.exponent(),
        });
        self.turn = Turn::Lane;
    }

    /// The same step, together with those of other motions. The rates at its start are evaluated with it.
    pub(super) fn try_step_in_lane(&mut self, lane: &Lane, h: f64) -> Result<(), Failure> {
        lane.take_step((self.t, h), &self.state, self.stages.row_mut(0));
        if matches!(self.first, First::Unknown) {
            self.statistics.evaluations += 1;
            self.first = First::InPlace;
            self.begin()?;
        }
        let &Tableau { stages, evaluates_end, .. } = self.tableau;
        self.statistics.evaluations += stages - usize::from(!evaluates_end);
        lane.read_step(StepResults {
            after: &mut self.after,
            last_stage: &mut self.last_stage,
            errors: &mut self.errors,
        });
        for stage in stages - 1..stages + usize::from(evaluates_end) {
            lane.read_rates(stage, self.stages.row_mut(stage));
        }
        self.are_rates_here = false;
        if self.state.len() > self.tolerances.controlled {
            self.fetch_rates();
        }
        Ok(())
    }

    /// Read the rates at all stages of the last step from its lane, if it was taken in one.
    pub(super) fn fetch_rates(&mut self) {
        if let Some(lane) = self.rates.lane().filter(|_| !self.are_rates_here) {
            for stage in 0..self.tableau.stages + usize::from(self.tableau.evaluates_end) {
                lane.read_rates(stage, self.stages.row_mut(stage));
            }
            self.are_rates_here = true;
        }
    }

    /// Take several steps, up to where the motion looks at one; a failure after the last step is told with the next.
    pub(super) fn advance_in_lane(&mut self, lane: &Lane, stretch: Stretch) -> Result<(), Failure> {
        if let Some(failure) = self.failure.take() {
            return Err(failure);
        }
        let steps = self.statistics.steps;
        let known = (self.statistics, 0.0);
        let arrival = lane.advance(stretch, known, (&mut self.before, &mut self.after));
        self.state.copy_from_slice(&self.after);
        (self.t, self.last, self.statistics) = (arrival.t, arrival.last, arrival.statistics);
        (self.is_dense, self.are_rates_here) = (false, false);
        self.has_crossing = arrival.has_crossing;
        match arrival.failure {
            Some(failure) if self.statistics.steps == steps => Err(failure),
            later => {
                self.failure = later;
                Ok(())
            }
        }
    }

    /// Take several steps that end on the constraints, up to where the motion looks at one or takes the next itself.
    ///
    /// Write the state at the start of the last step, and the state on the constraints at its end.
    pub(super) fn land_in_lane(
        &mut self,
        lane: &Lane,
        end: f64,
        (stretch, largest_speed): (Stretch, f64),
        (start, landed): (&mut [f64], &mut [f64]),
    ) -> Option<Landing> {
        if self.turn == Turn::Motion || self.is_held_back() || self.regular > 0.0 {
            return None;
        }
        if self.turn == Turn::Unknown {
            self.begin_in_lane(lane, end);
        }
        let (steps, known) = (self.statistics.steps, (self.statistics, largest_speed));
        let arrival = lane.advance(stretch, known, (&mut self.before, &mut self.after));
        let Landed { is_own_turn, largest_speed, step, last_error, stiff_steps } = arrival.landing?;
        self.turn = if is_own_turn { Turn::Motion } else { Turn::Lane };
        if arrival.statistics.steps == steps {
            return None;
        }
        (self.t, self.last, self.statistics) = (arrival.t, arrival.last, arrival.statistics);
        (self.step, self.last_error, self.stiff_steps) = (step, last_error, stiff_steps);
        (self.last_regular, self.crossing) = (self.last.1, 0.0);
        (self.is_dense, self.are_rates_here, self.is_careful) = (false, false, false);
        (self.first, self.has_crossing) = (First::Unknown, arrival.has_crossing);
        let last_rates = self.stages.row_mut(self.tableau.stages - 1);
        let last_stage = (&mut self.last_stage[..], last_rates);
        lane.read_landing(LandingResults { state: &mut *landed, sizes: &mut self.sizes, last_stage });
        self.state.copy_from_slice(&self.after);
        start.copy_from_slice(&self.before);
        Some(Landing { start: self.last.0, largest_speed })
    }
}
