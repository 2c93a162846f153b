//! The trail of a motion: its states at the ends of steps, for an analysis of the motion afterwards.

/// Rows of an instant and its state, for every step, or for every second, fourth, ... step of long motions.
#[derive(Debug)]
pub struct Trail {
    /// The most rows that are kept; zero keeps none.
    most: usize,
    /// One of this many steps is kept.
    every: usize,
    /// The number of steps since the last one that was kept.
    since: usize,
    /// The length of a row.
    width: usize,
    rows: Vec<f64>,
}

impl Trail {
    /// A trail of at most `most` rows, which starts at a state.
    pub fn new(most: usize, t: f64, state: &[f64]) -> Self {
        let mut trail = Self { most, every: 1, since: 0, width: 1 + state.len(), rows: Vec::new() };
        trail.keep(t, state);
        trail
    }

    /// Record the end of a step; drop rows of later instants, which belong to steps that were taken back.
    pub fn note(&mut self, t: f64, state: &[f64]) {
        while self.rows.len() > self.width && self.rows[self.rows.len() - self.width] >= t {
            self.rows.truncate(self.rows.len() - self.width);
        }
        self.since += 1;
        if self.since == self.every {
            self.keep(t, state);
        }
    }

    fn keep(&mut self, t: f64, state: &[f64]) {
        if self.most == 0 {
            return;
        }
        if self.rows.len() == self.most * self.width {
            self.thin();
        }
        self.since = 0;
        self.rows.push(t);
        self.rows.extend_from_slice(state);
    }

    /// Keep every second row.
    fn thin(&mut self) {
        let kept = self.rows.chunks(self.width).step_by(2).flatten().copied().collect();
        self.rows = kept;
        self.every *= 2;
    }

    /// The rows, one after another.
    pub fn into_rows(self) -> Vec<f64> {
        self.rows
    }
}

#[cfg(test)]
mod tests {
    use super::Trail;

    fn instants(most: usize, steps: u32) -> Vec<f64> {
        let mut trail = Trail::new(most, 0.0, &[1.0]);
        for step in 1..=steps {
            trail.note(f64::from(step), &[1.0]);
        }
        trail.into_rows().chunks(2).map(|row| row[0]).collect()
    }

    #[test]
    fn short_motions_are_kept_step_by_step_and_long_ones_evenly() {
        assert_eq!(instants(8, 3), [0.0, 1.0, 2.0, 3.0]);
        assert_eq!(instants(4, 9), [0.0, 4.0, 8.0]);
        assert!(instants(0, 9).is_empty());
    }
}
