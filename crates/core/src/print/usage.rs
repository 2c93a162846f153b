//! How equations use their names: the order in which factors show functions of time, which of them are speeds, and
//! which parameters are subtracted from others.

use rustc_hash::{FxHashMap, FxHashSet};

/// The functions of time of equations, by name. Without any, functions of time are in the order of their names.
#[derive(Clone, Debug, Default)]
pub struct Usage {
    places: FxHashMap<String, Use>,
    subtracted: FxHashSet<String>,
}

/// The use of one function of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Use {
    /// Its place among the functions of time.
    pub(super) index: usize,
    /// Whether it is a velocity, though it is no derivative of anything that is printed.
    pub(super) is_speed: bool,
}

impl Usage {
    /// The functions of time in their order, those of them (or after them) that are speeds, and the parameters that
    /// stand behind the minus sign of a difference in the model.
    #[must_use]
    pub fn new(functions: &[String], speeds: &[String], subtracted: Vec<String>) -> Self {
        let mut places = FxHashMap::default();
        for name in functions.iter().chain(speeds) {
            let index = places.len();
            places.entry(name.clone()).or_insert(Use { index, is_speed: speeds.contains(name) });
        }
        Self { places, subtracted: subtracted.into_iter().collect() }
    }

    pub(super) fn is_subtracted(&self, name: &str) -> bool {
        self.subtracted.contains(name)
    }

    pub(super) fn of(&self, name: &str) -> Use {
        self.places.get(name).copied().unwrap_or(Use { index: usize::MAX, is_speed: false })
    }
}
