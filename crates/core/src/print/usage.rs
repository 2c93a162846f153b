//! How equations use their functions of time: the order in which factors show them, and which of them are speeds.

use rustc_hash::FxHashMap;

/// The functions of time of equations, by name. Without any, functions of time are in the order of their names.
#[derive(Clone, Debug, Default)]
pub struct Usage {
    places: FxHashMap<String, Use>,
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
    /// The coordinates and the speeds, each in their order.
    #[must_use]
    pub fn new(coordinates: &[String], speeds: &[String]) -> Self {
        let named =
            coordinates.iter().map(|name| (name, false)).chain(speeds.iter().map(|name| (name, true)));
        let places = named.enumerate();
        Self {
            places: places.map(|(index, (name, is_speed))| (name.clone(), Use { index, is_speed })).collect(),
        }
    }

    pub(super) fn of(&self, name: &str) -> Use {
        self.places.get(name).copied().unwrap_or(Use { index: usize::MAX, is_speed: false })
    }
}
