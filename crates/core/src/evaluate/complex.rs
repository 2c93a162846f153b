//! Whether a value depends on complex symbols: the form may hold some that cancel, as s in (s x + x)/(s + 1).

use crate::graph::{Flags, Graph, Id};
use crate::value::FieldId;

impl Graph {
    /// Whether the value of a node depends on complex symbols: whether it differs from that at a point that differs by
    /// these alone. If there are too many signs for that, it is complex if its form is.
    pub(crate) fn is_complex(&self, id: Id) -> bool {
        let flags = self.flags(id);
        if !flags.has(Flags::COMPLEX) {
            return false;
        }
        let (id, _) = self.representative_up_to_sign(id);
        if let Some(known) = self.lanes.borrow().complex(id) {
            return known;
        }
        let differs =
            |field: FieldId| self.value_in(id, field) != self.value_in(id, field.with_complex_moved());
        let is_complex = if flags.has(Flags::BRANCH) {
            let points = self.points_for(&self.signs(id), &[id]);
            points.is_none_or(|points| (0..points).any(|point| FieldId::others(point).any(differs)))
        } else {
            FieldId::HASH.into_iter().any(differs)
        };
        self.lanes.borrow_mut().insert_complex(id, is_complex);
        is_complex
    }
}
