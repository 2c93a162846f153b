//! Excursions: a function that has one sign at the ends of all parts of a step may pass zero between two of them and
//! come back.
//!
//! Where it is nearest to zero, the bend of the parabola through three points says how much nearer it may come between
//! them. Only if that reaches zero, the lowest point is searched: by the vertices of parabolas, as in R. P. Brent,
//! Algorithms for Minimization without Derivatives (1973), chapter 5, and by points that shorten the longer side. An
//! excursion within the tolerances of the integration is none, since its errors would decide on it.

use crate::failure::Failure;
use crate::part::PARTS;
use crate::tolerances::Tolerances;

/// An instant and a value there.
pub type Point = (f64, f64);

/// A neighbour of the end of a step, as a fraction of a part: it shows whether the function rises or falls there.
const BESIDE: f64 = 1e-4;
/// The least distance between two points, as a fraction of the longer side.
const APART: f64 = 0.1;
/// The most evaluations: each second one shortens the longer side to a tenth or by half.
const EVALUATIONS: usize = 60;

/// The three points that show the bend of a function at one of the ends of the parts.
pub fn three(place: usize) -> [usize; 3] {
    match place {
        0 => [0, 1, 2],
        PARTS => [PARTS - 2, PARTS - 1, PARTS],
        place => [place - 1, place, place + 1],
    }
}

/// How far beyond zero a function may be by the errors of the integration; `most` is its largest magnitude in a step.
#[allow(clippy::inline_always, reason = "loops over lanes are compiled for the vectors of their caller")]
#[inline(always)]
pub fn noise(most: f64, tolerances: &Tolerances) -> f64 {
    tolerances.absolute + tolerances.relative * most
}

/// Whether a function may pass zero beside the one of three equidistant points at which it has the value `here`.
///
/// The vertex of a parabola is at most a quarter of the bend beyond the nearest of three points; all of it allows for
/// other functions, such as distances with kinks.
#[allow(clippy::inline_always, reason = "loops over lanes are compiled for the vectors of their caller")]
#[inline(always)]
pub fn may_pass([a, b, c]: [f64; 3], here: f64, noise: f64) -> bool {
    let is_of_one_sign = a.min(b).min(c) >= 0.0 || a.max(b).max(c) <= 0.0;
    let (a, b, c, here) = (a.abs(), b.abs(), c.abs(), here.abs());
    let bend = 0.5 * (a - 2.0 * b + c);
    is_of_one_sign && here <= a.min(b).min(c) && here + noise < bend
}

/// Find a point of a function beyond zero, by more than the noise, close to the one of three points that is nearest to
/// zero; `None` if the function keeps its sign there.
pub fn point_beyond(
    three: [Point; 3],
    nearest: usize,
    noise: f64,
    value: &mut dyn FnMut(f64) -> Result<f64, Failure>,
) -> Result<Option<Point>, Failure> {
    let sign = three.iter().map(|(_, value)| value).sum::<f64>().signum();
    let mut point = |t: f64| value(t).map(|value| (t, sign * value + noise));
    let [a, b, c] = three.map(|(t, value)| (t, sign * value + noise));
    let (mut before, mut lowest, mut after) = match nearest {
        0 => (a, point(a.0 + BESIDE * (b.0 - a.0))?, b),
        1 => (a, b, c),
        _ => (b, point(c.0 - BESIDE * (c.0 - b.0))?, c),
    };
    for _ in 0..EVALUATIONS {
        if lowest.1 < 0.0 {
            return Ok(Some((lowest.0, sign * (lowest.1 - noise))));
        }
        let Some(t) = next(before, lowest, after) else { return Ok(None) };
        let new = point(t)?;
        let (end, other) = if t < lowest.0 { (&mut before, &mut after) } else { (&mut after, &mut before) };
        if new.1 < lowest.1 {
            *other = std::mem::replace(&mut lowest, new);
        } else {
            *end = new;
        }
    }
    Ok(None)
}

/// The next instant to look at; `None` if the lowest point is above its neighbours, or none can be below zero.
fn next(before: Point, lowest: Point, after: Point) -> Option<f64> {
    let (left, right) = (lowest.0 - before.0, after.0 - lowest.0);
    let (fall, rise) = ((before.1 - lowest.1) / left, (after.1 - lowest.1) / right);
    let curvature = (fall + rise) / (left + right);
    let longer = left.max(right);
    let goes_on = fall >= 0.0 && rise >= 0.0 && lowest.1 < curvature * longer * longer;
    let to_vertex = 0.5 * (fall / curvature - left);
    let least = APART * longer;
    let to_next = match (to_vertex.abs() < least, left > right) {
        (false, _) => to_vertex,
        (true, true) => -least,
        (true, false) => least,
    };
    goes_on.then_some(lowest.0 + to_next)
}

#[cfg(test)]
mod tests {
    use super::{may_pass, point_beyond, three};
    use crate::part::{PARTS, end_of_part};

    /// A function in a step from 0 to 1: an instant at which it is beyond zero, and the evaluations that found it.
    fn found(function: impl Fn(f64) -> f64, noise: f64) -> (Option<f64>, usize) {
        let (mut count, mut beyond) = (0, None);
        for place in 0..=PARTS {
            let point = |place| (end_of_part(place, 0.0, 1.0), function(end_of_part(place, 0.0, 1.0)));
            let points = three(place).map(point);
            if may_pass(points.map(|(_, value)| value), point(place).1, noise) {
                let mut value = |t| {
                    count += 1;
                    Ok(function(t))
                };
                let nearest = three(place).iter().take_while(|other| **other < place).count();
                let point = point_beyond(points, nearest, noise, &mut value).expect("a value");
                beyond = beyond.or(point.map(|(t, _)| t));
            }
        }
        (beyond, count)
    }

    fn check_excursion(function: impl Fn(f64) -> f64) {
        let values: Vec<f64> = (0..=PARTS).map(|place| function(end_of_part(place, 0.0, 1.0))).collect();
        let is_seen = values.iter().any(|value| value * values[0] <= 0.0);
        let (beyond, count) = found(&function, 1e-12);
        assert!(is_seen || beyond.is_some());
        assert!(beyond.is_none_or(|t| function(t) * values.iter().sum::<f64>() < 0.0));
        assert!(count <= 40, "{count}");
    }

    #[test]
    fn an_excursion_of_any_depth_at_any_place_is_found_and_none_where_there_is_none() {
        for (place, depth, sign) in (0..=1000)
            .flat_map(|place| [1e-3, 1e-6, 1e-9].map(|depth| (f64::from(place) / 1000.0, depth)))
            .flat_map(|(place, depth)| [(place, depth, 1.0), (place, depth, -1.0)])
        {
            check_excursion(|t| sign * ((t - place).powi(2) - depth));
            check_excursion(|t| sign * ((t - place).abs() - depth));
            check_excursion(|t| sign * (1.0 - (5.0 * (t - place)).cos() - depth));
            let (beyond, count) = found(|t| sign * ((t - place).powi(2) + depth), 1e-12);
            assert!(beyond.is_none() && count <= 30, "{beyond:?}, {count}");
        }
    }

    #[test]
    fn what_is_within_the_noise_or_far_from_zero_costs_nothing() {
        assert_eq!(found(|t| (t - 0.53).powi(2) - 1e-9, 1e-2), (None, 0));
        assert_eq!(found(|t| (t - 0.53).powi(2) + 0.02, 1e-9), (None, 0));
        assert_eq!(found(|t| 1.0 + t, 1e-9), (None, 0));
        assert_eq!(found(|_| 1e-12, 1e-9), (None, 0));
    }
}
