//! Whether the dense output of steps on the constraints satisfies the equations in the middle of the steps: the test of a
//! motion alone, for all lanes at once.

use crate::runge_kutta::{has_small_defect, has_smooth_defect};
use crate::tolerances::Tolerances;

use super::columns::{Columns, Waiting};
use super::dense::Dense;
use super::landing::{Chosen, Corrections, Landings};
use super::norms::Weighted;
use super::stages::StepColumns;
use super::vectors::{Loop, in_vectors};

/// The middles of the steps.
const MIDDLE: f64 = 0.5;

/// The states in the middle, and by how much the slopes of the dense output differ from the rates there.
pub(super) struct Defects<const W: usize> {
    tolerances: Tolerances,
    states: Vec<[f64; W]>,
    differences: Vec<[f64; W]>,
    slopes: Vec<[f64; W]>,
}

impl<const W: usize> Defects<W> {
    pub fn new(tolerances: Tolerances, entries: usize) -> Self {
        let zeros = || vec![[0.0; W]; entries];
        Self { tolerances, states: zeros(), differences: zeros(), slopes: zeros() }
    }

    /// Return the accepted steps, which end at these instants, whose dense output is that of a smooth motion.
    pub fn are_small(
        &mut self,
        (accepted, ends): (&[bool; W], &[f64; W]),
        (step, dense): (&StepColumns<W>, &Dense<W>),
        rates: &mut Columns<W>,
        (landings, corrections): (&Landings<W>, &mut Corrections<'_, W>),
        waiting: &mut Waiting<'_, W>,
    ) -> [bool; W] {
        let instants = std::array::from_fn(|lane| step.t[lane] + MIDDLE * step.h[lane]);
        dense.states_at(instants, ends, step, &mut self.states);
        let chosen = Chosen { lanes: accepted, instants: &instants, bounds: &[f64::INFINITY; W] };
        let lanes = landings.project(&mut self.states, chosen, corrections, waiting);
        rates.inputs[0] = instants;
        rates.inputs[1..=step.entries].copy_from_slice(&self.states);
        rates.evaluate_into(&mut self.differences, &mut Waiting { lanes, noted: &mut *waiting.noted });
        dense.slopes_at(MIDDLE, step, &mut self.slopes);
        in_vectors::<W>(Subtraction { from: &mut self.differences, of: (&self.slopes, None) });
        let sizes = self.sizes(step);
        let large = std::array::from_fn(|lane| lanes[lane] && !has_small_defect(sizes[lane]));
        if !large.contains(&true) {
            return lanes;
        }
        self.keep_part_along(&large, &instants, landings, corrections, waiting);
        let along = self.sizes(step);
        std::array::from_fn(|lane| {
            lanes[lane] && (!large[lane] || has_smooth_defect(sizes[lane], along[lane]))
        })
    }

    /// The defects in tolerances.
    fn sizes(&self, step: &StepColumns<W>) -> [f64; W] {
        let mut sums = [0.0; W];
        let &Self { tolerances, differences: ref vector, .. } = self;
        in_vectors::<W>(Weighted { tolerances, vector, states: &step.after, sums: &mut sums });
        #[allow(clippy::cast_precision_loss, reason = "no state has 2^53 numbers")]
        let entries = tolerances.controlled as f64;
        std::array::from_fn(|lane| step.h[lane] * (sums[lane] / entries).sqrt())
    }

    /// Take away the part of the defects that leads off the constraints, as [`crate::projection::Tangent::part`] does.
    fn keep_part_along(
        &mut self,
        lanes: &[bool; W],
        instants: &[f64; W],
        landings: &Landings<W>,
        corrections: &mut Corrections<'_, W>,
        waiting: &mut Waiting<'_, W>,
    ) {
        let Some(velocities) = &mut corrections.velocities else { return };
        let (speeds, entries) = (landings.speeds(), self.states.len());
        velocities.inputs[0] = *instants;
        velocities.inputs[1..=entries].copy_from_slice(&self.states);
        let places = 1 + speeds.start..1 + speeds.end;
        velocities.inputs[places.clone()].fill([0.0; W]);
        velocities.evaluate(&mut Waiting { lanes: *lanes, noted: &mut *waiting.noted });
        let at_rest = velocities.outputs.clone();
        let coordinates = if speeds.start == speeds.len() { 0..speeds.start } else { 0..0 };
        for part in [coordinates, speeds].into_iter().filter(|part| !part.is_empty()) {
            velocities.inputs[places.clone()].copy_from_slice(&self.differences[part.clone()]);
            velocities.evaluate(&mut Waiting { lanes: *lanes, noted: &mut *waiting.noted });
            let of = (&at_rest[..], Some(&velocities.outputs[..]));
            in_vectors::<W>(Subtraction { from: &mut self.differences[part], of });
        }
    }
}

/// Vectors minus others, or plus the differences of two.
struct Subtraction<'a, const W: usize> {
    from: &'a mut [[f64; W]],
    of: (&'a [[f64; W]], Option<&'a [[f64; W]]>),
}

impl<const W: usize> Loop for Subtraction<'_, W> {
    #[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
    #[inline(always)]
    fn run(self) {
        let (less, more) = self.of;
        for (i, entries) in self.from.iter_mut().enumerate() {
            for lane in 0..W {
                entries[lane] = match more {
                    Some(more) => entries[lane] + (more[i][lane] - less[i][lane]),
                    None => entries[lane] - less[i][lane],
                };
            }
        }
    }
}
