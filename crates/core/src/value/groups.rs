//! The groups in which the angles and exponentials of a field lie, and the units of odd order on its circle.

use super::circle::{self, Point};
use super::prime::Prime;
use super::quadratic::Quadratic;

/// Generators of the groups of a field.
pub(super) struct Groups {
    /// The order of the exact angles, and the smallest of them.
    pub(super) torsion: (u64, Point),
    /// The atomic angle of prime order: a point of the circle.
    pub(super) angle: Point,
    /// The atomic exponential of prime order.
    pub(super) exponential: u64,
    /// The odd primes of the exact angles with the largest powers of them that divide p + 1, and the units of these orders,
    /// if the field has them all.
    pub(super) units: Vec<(u64, u32, Quadratic)>,
}

/// The units of the largest orders on the circle that are powers of odd primes of the exact angles, and agree with these.
pub(super) fn units_on_circle(prime: &Prime, (order, step): (u64, Point)) -> Vec<(u64, u32, Quadratic)> {
    let unit = |q: u64| {
        let power_in = |mut number: u64| {
            let mut count = 0;
            while number.is_multiple_of(q) {
                (number, count) = (number / q, count + 1);
            }
            count
        };
        let (exact, held) = (q.pow(power_in(order)), power_in(prime.p + 1));
        let target = circle::times(prime, step, order / exact);
        let cofactor = (prime.p + 1) / q.pow(held);
        let point = |t: u64| circle::times(prime, circle::point(prime, prime.natural(t)), cofactor);
        let more = q.pow(held) / exact;
        let agrees = |point: &Point| circle::times(prime, *point, more) == target;
        let candidates =
            (2..).map(point).flat_map(|point| (1..exact).map(move |k| circle::times(prime, point, k)));
        let (cos, sin) = candidates.into_iter().find(agrees).expect("the circle is a cyclic group");
        (q, held, Quadratic::Wide([cos, sin].into()))
    };
    [3, 5, 7, 11].map(unit).into()
}
