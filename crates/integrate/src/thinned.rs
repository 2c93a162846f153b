//! Values along a motion in bounded memory: all of them at first, then every second, every fourth, ... one.

/// The most values that are kept.
const MOST: usize = 1024;

/// Values in the order in which they came.
#[derive(Debug)]
pub struct Thinned<T> {
    /// One of this many values is kept, and how many came since the last one.
    every: usize,
    since: usize,
    kept: Vec<T>,
}

impl<T: Copy> Thinned<T> {
    pub fn new() -> Self {
        Self { every: 1, since: 0, kept: Vec::new() }
    }

    /// Add a value.
    pub fn push(&mut self, value: T) {
        self.since += 1;
        if self.since < self.every {
            return;
        }
        if self.kept.len() == MOST {
            // The ones that stay are as far apart as the next one from the last.
            self.kept = self.kept.iter().copied().skip(1).step_by(2).collect();
            self.every *= 2;
            if self.since < self.every {
                return;
            }
        }
        self.since = 0;
        self.kept.push(value);
    }

    /// The values that are kept.
    pub fn kept(&self) -> &[T] {
        &self.kept
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST, Thinned};

    fn kept(count: usize) -> Vec<usize> {
        let mut values = Thinned::new();
        for value in 1..=count {
            values.push(value);
        }
        values.kept().to_vec()
    }

    #[test]
    fn few_values_are_kept_and_many_are_thinned_evenly() {
        assert_eq!(kept(MOST), (1..=MOST).collect::<Vec<_>>());
        assert_eq!(kept(2 * MOST), (1..=MOST).map(|k| 2 * k).collect::<Vec<_>>());
        let many = kept(100 * MOST);
        assert!((MOST / 2..=MOST).contains(&many.len()), "{}", many.len());
        assert!(many.windows(2).all(|two| two[1] - two[0] == 128), "{many:?}");
    }
}
