//! The derivative of one node with respect to one of its children.

use crate::error::Error;
use crate::graph::{Function, Graph, Id, NumberId, View};
use crate::value::Number;

impl Graph {
    /// d|u| = |u| du/u and d sign(u) = 0 of a complex u, if du/u is real: the argument of u stays the same.
    pub(super) fn modulus_tangent(
        &mut self,
        function: Function,
        u: Id,
        derivative: Id,
        id: Id,
    ) -> Result<Id, Error> {
        let growth = self.div(derivative, u)?;
        if self.is_complex(growth) {
            return Err(Error::NoDerivative {
                expression: self.to_quotation(id),
                symbol: self.complex_symbol(u),
            });
        }
        if function == Function::Sign {
            return Ok(Id::ZERO);
        }
        self.mul(id, growth)
    }

    /// The partial derivative of a node with respect to its k-th child, as a multiple.
    pub(super) fn partial(&mut self, id: Id, k: usize) -> Result<(NumberId, Id), Error> {
        let one = NumberId::ONE;
        match self.view(id) {
            View::Scale(factor, _) => Ok((factor, Id::ONE)),
            View::Sum(terms) => {
                let (factor, _) = terms.iter().nth(k).expect("child k of a sum is its k-th term");
                Ok((factor, Id::ONE))
            }
            View::Product(factors) => {
                let mut factors: Vec<(Id, NumberId)> = factors.iter().collect();
                let exponent = factors[k].1;
                let lower = self.get_number(exponent).sub(&Number::integer(1));
                if lower.is_zero() {
                    factors.remove(k);
                } else {
                    factors[k].1 = self.number_id(&lower);
                }
                Ok((exponent, self.product(&factors)?))
            }
            View::Application { name, args, orders } => {
                let (name, args, mut orders) =
                    (name.to_owned(), args.iter().collect::<Vec<_>>(), orders.to_vec());
                orders[k] += 1;
                Ok((one, self.application(&name, &args, &orders)?))
            }
            View::Function(function, args) => {
                let args: Vec<Id> = args.iter().collect();
                let partial = self.function_partial(function, &args, k, id)?;
                Ok(self.split_multiple(one, partial))
            }
            View::Number(_)
            | View::Pi
            | View::Time
            | View::Symbol(..)
            | View::TimeFunction(..)
            | View::LinearSystem { .. }
            | View::Solution(..) => Ok((one, Id::ZERO)),
        }
    }

    /// The partial derivative of a function of the table with respect to argument k.
    fn function_partial(&mut self, function: Function, args: &[Id], k: usize, id: Id) -> Result<Id, Error> {
        let x = args[0];
        match function {
            Function::Sin => self.apply(Function::Cos, args),
            Function::Cos => {
                let sine = self.apply(Function::Sin, args)?;
                Ok(self.neg(sine))
            }
            Function::Tan => self.one_plus_square(id, 1),
            Function::Tanh => self.one_plus_square(id, -1),
            Function::Sinh => self.apply(Function::Cosh, args),
            Function::Cosh => self.apply(Function::Sinh, args),
            Function::Exp => Ok(id),
            Function::Log => self.div(Id::ONE, x),
            Function::Asin | Function::Acos => {
                let radicand = self.one_plus_square(x, -1)?;
                let slope = self.pow_number(radicand, &Number::rational(-1, 2))?;
                Ok(if function == Function::Asin { slope } else { self.neg(slope) })
            }
            Function::Atan => {
                let square = self.one_plus_square(x, 1)?;
                self.div(Id::ONE, square)
            }
            Function::Atan2 => {
                let (y, x) = (args[0], args[1]);
                let (yy, xx) = (self.mul(y, y)?, self.mul(x, x)?);
                let square = self.add(yy, xx);
                let quotient = self.div(if k == 0 { x } else { y }, square)?;
                Ok(if k == 0 { quotient } else { self.neg(quotient) })
            }
            Function::Abs => self.modulus_partial(x, id),
            Function::Sign => Ok(Id::ZERO),
            Function::Min | Function::Max => self.extremum_partial(function, args, k),
            Function::Power if k == 0 => {
                let quotient = self.div(id, x)?;
                self.mul(args[1], quotient)
            }
            Function::Power => {
                let logarithm = self.apply(Function::Log, &[x])?;
                self.mul(id, logarithm)
            }
            Function::Piecewise => self.branch_partial(args, k),
        }
    }

    /// d|u| = sign(u) du of what is real, and |u| du/u of what may not be real. The last one follows from the value of |u|:
    /// |u v| = |u| |v|, |u**k| = |u|**k and sign(u) = u/|u| have equal derivatives. But it has no value where u is zero.
    fn modulus_partial(&mut self, u: Id, modulus: Id) -> Result<Id, Error> {
        if self.has_real_values(u) || self.is_real_in_numbers(u) {
            return self.apply(Function::Sign, &[u]);
        }
        self.div(modulus, u)
    }

    /// The partial derivative of max(max(max(a, b), c), ...) by argument k: the product of those of each max(m, a) = (m + a +
    /// |m - a|)/2 on the way, which are (1 + sign(m - a))/2 and (1 + sign(a - m))/2. So the weights of all arguments add up to
    /// one, also where several of them are the extremum. Of what may not be real, the condition m - a > 0 chooses.
    fn extremum_partial(&mut self, function: Function, args: &[Id], k: usize) -> Result<Id, Error> {
        let half = self.number_id(&Number::rational(1, 2));
        let mut weights = Vec::new();
        for last in k.max(1)..args.len() {
            let before = if last == 1 { args[0] } else { self.apply(function, &args[..last])? };
            let (kept, other) = if last == k { (args[k], before) } else { (before, args[last]) };
            let ahead = if function == Function::Max { self.sub(kept, other) } else { self.sub(other, kept) };
            let weight = if self.has_real_values(ahead) {
                let sign = self.apply(Function::Sign, &[ahead])?;
                self.sum(&[(half, Id::ONE), (half, sign)])
            } else {
                // where a root is imaginary, a sign is no 1 or -1, but a condition chooses
                self.apply(Function::Piecewise, &[Id::ONE, ahead, Id::ZERO])?
            };
            weights.push((weight, NumberId::ONE));
        }
        self.product(&weights)
    }

    /// The partial derivative by a branch is one where the branch is chosen; that by a condition is zero.
    fn branch_partial(&mut self, args: &[Id], k: usize) -> Result<Id, Error> {
        let is_condition = |j: usize| j % 2 == 1 && j + 1 < args.len();
        if is_condition(k) {
            return Ok(Id::ZERO);
        }
        let branch = |j: usize| match j {
            _ if is_condition(j) => args[j],
            _ if j == k => Id::ONE,
            _ => Id::ZERO,
        };
        let branches: Vec<Id> = (0..args.len()).map(branch).collect();
        self.apply(Function::Piecewise, &branches)
    }

    /// 1 + sign * x^2
    fn one_plus_square(&mut self, x: Id, sign: i64) -> Result<Id, Error> {
        let square = self.mul(x, x)?;
        Ok(if sign > 0 { self.add(Id::ONE, square) } else { self.sub(Id::ONE, square) })
    }
}
