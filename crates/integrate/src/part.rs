//! The parts of a step at whose ends the functions of events are looked at.

/// Their number: a long step may contain many zeros.
pub const PARTS: usize = 10;

/// The instant at which a part of a step ends.
#[allow(clippy::cast_precision_loss, reason = "there are few parts")]
pub fn end_of_part(part: usize, start: f64, end: f64) -> f64 {
    if part == PARTS { end } else { start + (end - start) * part as f64 / PARTS as f64 }
}
