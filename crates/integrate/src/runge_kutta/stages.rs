//! The rates at the stages of a step, and their weighted sums: half of what an explicit method does besides calls.

#![allow(unsafe_code, reason = "wider vectors, where the processor that runs this has them")]

/// Entries whose sums stay in registers.
const LANES: usize = 8;

/// The rates at the stages, a row for each.
pub struct Stages {
    entries: usize,
    /// From row to row: the entries, filled up to whole lanes with zeros.
    stride: usize,
    rates: Vec<f64>,
    nothing: Vec<f64>,
}

impl Stages {
    /// Rows of zeros.
    pub(super) fn new(count: usize, entries: usize) -> Self {
        let stride = entries.next_multiple_of(LANES);
        Self { entries, stride, rates: vec![0.0; count * stride], nothing: vec![0.0; entries] }
    }

    pub fn row(&self, stage: usize) -> &[f64] {
        &self.rates[stage * self.stride..][..self.entries]
    }

    pub fn row_mut(&mut self, stage: usize) -> &mut [f64] {
        &mut self.rates[stage * self.stride..][..self.entries]
    }

    /// Copy one row to another.
    pub(super) fn copy(&mut self, from: usize, to: usize) {
        self.rates.copy_within(from * self.stride..(from + 1) * self.stride, to * self.stride);
    }

    /// Write the sum of weights times rows.
    pub(super) fn sum(&self, out: &mut [f64], weights: &[(usize, f64)]) {
        self.step(out, &self.nothing, 1.0, weights);
    }

    /// Write `base + h * sum of weights times rows`. Nothing is fused: all processors give the same numbers.
    pub(super) fn step(&self, out: &mut [f64], base: &[f64], h: f64, weights: &[(usize, f64)]) {
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("avx") {
            // SAFETY: this processor has what the function is compiled for.
            return unsafe { step_by_avx(self, out, base, h, weights) };
        }
        step(self, out, base, h, weights);
    }
}

/// The same in vectors of four.
///
/// # Safety
/// The processor has them.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx")]
unsafe fn step_by_avx(stages: &Stages, out: &mut [f64], base: &[f64], h: f64, weights: &[(usize, f64)]) {
    step(stages, out, base, h, weights);
}

#[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
#[inline(always)]
fn step(stages: &Stages, out: &mut [f64], base: &[f64], h: f64, weights: &[(usize, f64)]) {
    for (group, (out, base)) in out.chunks_mut(LANES).zip(base.chunks(LANES)).enumerate() {
        let mut sums = [0.0; LANES];
        for &(stage, weight) in weights {
            let rates = &stages.rates[stage * stages.stride + group * LANES..][..LANES];
            for (sum, rate) in sums.iter_mut().zip(rates) {
                *sum += weight * rate;
            }
        }
        for ((entry, start), sum) in out.iter_mut().zip(base).zip(sums) {
            *entry = start + h * sum;
        }
    }
}
