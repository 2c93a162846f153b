//! The circle group x^2 + y^2 = 1 over a prime field, which is cyclic of order p + 1, and its angles of known order.

use super::prime::Prime;

/// A point of the circle: the cosine and the sine of an angle.
pub(super) type Point = (u64, u64);

pub(super) fn identity(prime: &Prime) -> Point {
    (prime.one, 0)
}

/// The sum of two angles.
pub(super) fn rotate(prime: &Prime, a: Point, b: Point) -> Point {
    (prime.sub(prime.mul(a.0, b.0), prime.mul(a.1, b.1)), prime.add(prime.mul(a.0, b.1), prime.mul(a.1, b.0)))
}

/// A multiple of an angle.
pub(super) fn times(prime: &Prime, mut base: Point, mut factor: u64) -> Point {
    let mut result = identity(prime);
    while factor > 0 {
        if factor & 1 == 1 {
            result = rotate(prime, result, base);
        }
        base = rotate(prime, base, base);
        factor >>= 1;
    }
    result
}

/// The rational point with parameter t: ((1 - t^2)/(1 + t^2), 2t/(1 + t^2)).
pub(super) fn point(prime: &Prime, t: u64) -> Point {
    let square = prime.mul(t, t);
    // 1 + t^2 is never zero, because -1 is not a square.
    let scale = prime.inverse(prime.add(prime.one, square));
    (prime.mul(prime.sub(prime.one, square), scale), prime.mul(prime.add(t, t), scale))
}

/// The angle of one part in `order` of a turn, where `order` divides p + 1.
///
/// Among the angles of this order it is one for which a quarter turn has the sine 1, and for which the square roots of
/// 2, 3, 5, 7 and 11 that it gives are positive: sqrt 2 = 2 cos(pi/4), sqrt 3 = 2 cos(pi/6), sqrt 5 = 4 cos(pi/5) - 1,
/// and for q = 7 and 11 Gauss's sum of (k/q) sin(2 pi k/q). So are cos(pi/8) and sin(pi/5).
pub(super) fn turn_over(prime: &Prime, order: u64) -> Point {
    let cofactor = prime.p.div_ceil(order); // (p + 1)/order
    let mut t = prime.add(prime.one, prime.one);
    loop {
        let candidate = times(prime, point(prime, t), cofactor);
        let is_full = [2, 3, 5, 7, 11]
            .iter()
            .all(|q| !order.is_multiple_of(*q) || times(prime, candidate, order / q) != identity(prime));
        if is_full {
            return oriented(prime, candidate, order);
        }
        t = prime.add(t, prime.one);
    }
}

/// The first multiple of an angle that has full order and agrees with the positive roots.
fn oriented(prime: &Prime, angle: Point, order: u64) -> Point {
    let is_unit =
        |k: u64| [2, 3, 5, 7, 11].iter().all(|q| !order.is_multiple_of(*q) || !k.is_multiple_of(*q));
    (1..order)
        .filter(|&k| is_unit(k))
        .map(|k| times(prime, angle, k))
        .find(|&turned| agrees_with_roots(prime, turned, order))
        .unwrap_or(angle)
}

fn agrees_with_roots(prime: &Prime, angle: Point, order: u64) -> bool {
    let at = |parts: u64, k: u64| times(prime, angle, order / parts * k);
    let double = |x: u64| prime.add(x, x);
    let gauss = |q: u64, squares: &[u64]| {
        (1..q).fold(0, |sum, k| {
            let (_, sine) = at(q, k);
            if squares.contains(&k) { prime.add(sum, sine) } else { prime.sub(sum, sine) }
        })
    };
    let has = |parts: u64| order.is_multiple_of(parts);
    (!has(4) || at(4, 1).1 == prime.one)
        && (!has(8) || prime.is_square(double(at(8, 1).0)))
        && (!has(12) || prime.is_square(double(at(12, 1).0)))
        && (!has(10) || prime.is_square(prime.sub(double(double(at(10, 1).0)), prime.one)))
        && (!has(16) || prime.is_square(double(at(16, 1).0)))
        && (!has(20) || prime.is_square(double(at(10, 1).1)))
        && (!has(28) || prime.is_square(gauss(7, &[1, 2, 4])))
        && (!has(44) || prime.is_square(gauss(11, &[1, 3, 4, 5, 9])))
}
