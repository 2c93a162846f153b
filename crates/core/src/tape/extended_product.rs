//! Products with a coefficient beyond the doubles, such as `10**400 x y`.
//!
//! No order of the factors keeps all partial products within the doubles, whatever the values of x and y are. So the code
//! computes with mantissas and exponents: a value is `m R^e` with a whole number e, and |m| is between 2^-400 and 2^400.
//! The product and the quotient of two mantissas are doubles, and a multiplication by a power of R is exact.

use crate::graph::Function;
use crate::value::Number;

use super::emit::{Emitter, Signed};
use super::straight_line::{Instruction, Operand};

/// The binary logarithm of the base R of the exponents.
const BASE: i32 = 700;
/// The binary logarithm of the largest mantissa.
const LARGEST: i32 = 400;
/// How often the result is multiplied by R or 1/R: a value that needs more is no double.
const ROUNDS: usize = 3;

/// A value as its mantissa and its exponent.
#[derive(Clone, Copy)]
pub(super) struct Extended {
    mantissa: Operand,
    exponent: Operand,
}

impl Emitter {
    /// The value of a number; its sign is in the mantissa.
    pub fn extended_number(&mut self, number: &Number) -> Extended {
        let bits = |part: num_bigint::BigInt| i64::try_from(part.bits()).unwrap_or(i64::MAX);
        let logarithm = bits(number.numerator()) - bits(number.denominator());
        let exponent = (logarithm + i64::from(BASE / 2)).div_euclid(i64::from(BASE));
        let base = Number::integer(2).powi(-exponent * i64::from(BASE));
        let mantissa = base.map_or(0.0, |base| number.mul(&base).to_f64());
        #[allow(clippy::cast_precision_loss, reason = "a number in memory has fewer than 2^53 bits")]
        let (mantissa, exponent) = (self.plain_constant(mantissa), self.plain_constant(exponent as f64));
        Extended { mantissa, exponent }
    }

    /// The value of an operand.
    pub fn extended(&mut self, operand: Operand) -> Extended {
        let exponent = self.plain_constant(0.0);
        self.normalised(Extended { mantissa: operand, exponent })
    }

    /// The product of two values, or their quotient.
    pub fn combined(&mut self, a: Extended, b: Extended, divides: bool) -> Extended {
        let (mantissa, exponent) = if divides {
            (Instruction::Div(a.mantissa, b.mantissa), Instruction::Sub(a.exponent, b.exponent))
        } else {
            (Instruction::Mul(a.mantissa, b.mantissa), Instruction::Add(a.exponent, b.exponent))
        };
        let (mantissa, exponent) = (self.emit_plain(mantissa), self.emit_plain(exponent));
        self.normalised(Extended { mantissa, exponent })
    }

    /// The double that is nearest to a value.
    pub fn rounded(&mut self, value: Extended) -> Operand {
        let half = self.plain_constant(0.5);
        let opposite = self.plain_constant(-0.5);
        let Extended { mut mantissa, mut exponent } = value;
        for _ in 0..ROUNDS {
            let above = self.emit_plain(Instruction::Sub(exponent, half));
            let below = self.emit_plain(Instruction::Sub(opposite, exponent));
            let factor = self.choice([above, below], [2f64.powi(BASE), 2f64.powi(-BASE), 1.0]);
            let step = self.choice([above, below], [1.0, -1.0, 0.0]);
            mantissa = self.emit_plain(Instruction::Mul(mantissa, factor));
            exponent = self.emit_plain(Instruction::Sub(exponent, step));
        }
        mantissa
    }

    /// The logarithm of a value: `log(m) + e log(R)`.
    pub fn logarithm_of_extended(&mut self, value: Extended) -> Operand {
        let mantissa = self.emit_plain(Instruction::Unary(Function::Log, value.mantissa));
        let base = self.plain_constant(f64::from(BASE) * std::f64::consts::LN_2);
        let exponent = self.emit_plain(Instruction::Mul(value.exponent, base));
        self.emit_plain(Instruction::Add(mantissa, exponent))
    }

    /// The power y of a value, `sign(m)^y h^4` with `h = |m|^(y/4) (R^(1/4))^(e y)`: both factors of h are doubles where
    /// the power is.
    pub fn power_of_extended(&mut self, value: Extended, exponent: Operand) -> Operand {
        let quarter = self.plain_constant(0.25);
        let size = self.emit_plain(Instruction::Unary(Function::Abs, value.mantissa));
        let sign = self.emit_plain(Instruction::Unary(Function::Sign, value.mantissa));
        let base = self.plain_constant(2f64.powi(BASE / 4));
        let part = self.emit_plain(Instruction::Mul(quarter, exponent));
        let mantissa = self.emit_plain(Instruction::Binary(Function::Power, size, part));
        let turns = self.emit_plain(Instruction::Mul(value.exponent, exponent));
        let scale = self.emit_plain(Instruction::Binary(Function::Power, base, turns));
        let root = self.emit_plain(Instruction::Mul(mantissa, scale));
        let square = self.emit_plain(Instruction::Mul(root, root));
        let power = self.emit_plain(Instruction::Mul(square, square));
        if self.number_in(Signed::plus(sign)) == Some(1.0) {
            return power;
        }
        let sign = self.emit_plain(Instruction::Binary(Function::Power, sign, exponent));
        self.emit_plain(Instruction::Mul(sign, power))
    }

    /// The same value with a mantissa that is neither too large nor too small.
    fn normalised(&mut self, value: Extended) -> Extended {
        let (largest, least) =
            (self.plain_constant(2f64.powi(LARGEST)), self.plain_constant(2f64.powi(-LARGEST)));
        let size = self.emit_plain(Instruction::Unary(Function::Abs, value.mantissa));
        let above = self.emit_plain(Instruction::Sub(size, largest));
        let below = self.emit_plain(Instruction::Sub(least, size));
        let factor = self.choice([above, below], [2f64.powi(-BASE), 2f64.powi(BASE), 1.0]);
        let step = self.choice([above, below], [1.0, -1.0, 0.0]);
        Extended {
            mantissa: self.emit_plain(Instruction::Mul(value.mantissa, factor)),
            exponent: self.emit_plain(Instruction::Add(value.exponent, step)),
        }
    }

    /// The first number if the first condition is positive, the second if the second one is, or the last number.
    fn choice(&mut self, [first, second]: [Operand; 2], numbers: [f64; 3]) -> Operand {
        let [a, b, otherwise] = numbers.map(|number| self.plain_constant(number));
        let otherwise = self.emit_plain(Instruction::Select { condition: second, positive: b, otherwise });
        self.emit_plain(Instruction::Select { condition: first, positive: a, otherwise })
    }

    fn plain_constant(&mut self, value: f64) -> Operand {
        let constant = self.constant(value);
        self.plain(constant)
    }
}
