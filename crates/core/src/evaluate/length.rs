//! Lengths: the roots of sums and differences of two squares that sines of inverse functions are made of.
//!
//! The sine of atan(u) is u/sqrt(1 + u^2), where the sum has no node. Its root has the value that the root of a node has: the
//! numeric content of the sum is taken out.

use crate::graph::{Combination, Graph, Id};
use crate::value::{Field, FieldId, Key, Number, Quadratic};

use super::rational_power::{power_beside_content, power_of_complex, power_of_number};

type Point = (Quadratic, Quadratic);

impl Graph {
    /// sqrt(a^2 + b^2), or sqrt(a^2 - b^2) for the sign -1, from the values of the nodes a and b.
    pub(super) fn length(
        &self,
        [a, b]: [Id; 2],
        sign: i8,
        f: &Field,
        value: &impl Fn(Id) -> Quadratic,
    ) -> Quadratic {
        let half = Number::rational(1, 2);
        let sign_of_square = Number::integer(sign.into());
        if let (Some(a), Some(b)) = (self.as_number(a), self.as_number(b)) {
            let square = a.mul(a).add(&sign_of_square.mul(&b.mul(b)));
            if !square.is_negative() {
                return power_of_number(&square, &half, f);
            }
        }
        let square_of = |id: Id| {
            let value = if id == Id::ONE { f.one() } else { value(id) };
            f.mul(&value, &value)
        };
        let square = f.add(&square_of(a), &f.mul(&f.number(&sign_of_square), &square_of(b)));
        if [a, b].into_iter().any(|id| self.is_complex(id)) {
            return power_of_complex(&square, &half, f);
        }
        let content = self.content_of(Combination::squares([a, b], sign), f);
        power_beside_content(&square, content, &half, f)
    }

    /// The point (x, y)/|(x, y)| of the unit circle: the cosine and the sine of atan2(y, x).
    pub(super) fn unit_vector(&self, y: Id, x: Id, f: &Field, value: &impl Fn(Id) -> Quadratic) -> Point {
        let scale = f.inverse(&self.length([y, x], 1, f, value));
        (f.mul(&value(x), &scale), f.mul(&value(y), &scale))
    }

    pub(super) fn direction_in(&self, y: Id, x: Id, field: FieldId) -> Quadratic {
        let f = field.field();
        let (cos, sin) = self.unit_vector(y, x, f, &|id| self.value_in(id, field));
        let (magnitude, negated) = f.unsigned(&sin);
        let angle = f.opaque(Key::new("atan2"), &[&cos, &magnitude]);
        if negated { f.neg(&angle) } else { angle }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::graph::{Assumption, Function};

    /// 1 + (6 + sin x)^2 and (38 + sin x)^2 - 1 are multiples of 37 where sines are zero, as at the points of q-adic integers.
    #[test]
    fn sines_of_inverse_functions_are_quotients_of_lengths() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [x, y] = ["x", "y"].map(|name| g.symbol(name, Assumption::Real));
        let sine = g.apply(Function::Sin, &[x])?;
        for (number, function, other, sign) in [
            (6, Function::Atan, Id::ONE, 1),
            (38, Function::Acos, Id::ONE, -1),
            (6, Function::Atan2, sine, 1),
            (6, Function::Atan2, y, 1),
        ] {
            let number = g.integer(number);
            let u = g.add(number, sine);
            let args = if function == Function::Atan2 { vec![u, other] } else { vec![u] };
            let angle = g.apply(function, &args)?;
            let found = g.apply(Function::Sin, &[angle])?;
            let [first, second] = [g.mul(other, other)?, g.mul(u, u)?];
            let square = if sign > 0 { g.add(first, second) } else { g.sub(first, second) };
            let length = g.pow_number(square, &Number::rational(1, 2))?;
            let expected = if sign > 0 { g.div(u, length)? } else { length };
            assert!(g.equal(found, expected), "{}", g.to_text(found));
        }
        Ok(())
    }
}
