//! Steps in a lane of a crew: one beside those of other motions, or several that the crew controls.

use super::{First, RungeKutta, Tableau};
use crate::failure::Failure;
use crate::lane::{Lane, StepResults};
use crate::stepper::Stretch;

impl RungeKutta<'_> {
    /// The lane in which the next step is taken, if it is.
    pub(super) fn lane(&self) -> Option<Lane> {
        self.rates.lane().filter(|_| !self.is_careful).cloned()
    }

    /// The lane in which several steps are taken at a time: without constraints, nothing happens between them.
    pub(super) fn lane_of_stretches(&self) -> Option<Lane> {
        self.rates.lane().filter(|_| !self.projection.is_needed()).cloned()
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
            let has_first = self.lane_of_stretches().is_none();
            for stage in usize::from(has_first)..self.tableau.stages + usize::from(self.tableau.evaluates_end)
            {
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
        let arrival = lane.advance(stretch, self.statistics, (&mut self.before, &mut self.after));
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
}
