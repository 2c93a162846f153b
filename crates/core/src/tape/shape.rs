//! What a node is made of, in operands: nodes of one shape have one value, up to sign.
//!
//! To ask whether values with signs agree takes the values in all lanes. Where two parts have one operand, that was asked for
//! these, and what is made of them in the same way need not ask again.

use crate::graph::{Function, Graph, Id, NumberId, View};
use crate::value::Number;

use super::emit::Signed;
use super::straight_line::Operand;

/// A node in operands. Sums and products are in the order of the operands.
#[derive(PartialEq, Eq, Hash)]
pub(super) enum Shape {
    Scale(NumberId, Part),
    Sum(Vec<(Part, bool, NumberId)>),
    Product(Vec<(Part, bool, NumberId)>),
    Function(Function, Vec<(Part, bool)>),
}

/// An operand, or a number, which has more digits than its operand.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Part {
    Number(Id),
    Operand(Operand),
}

impl Graph {
    /// The shape of a node, and whether its value is the opposite of that of the shape; `None` where it has no shape: the
    /// multiple of a product by a number beyond the doubles, and what is made of such a multiple, are not made of operands.
    pub(super) fn shape(
        &self,
        id: Id,
        mut operand: impl FnMut(Id) -> Option<Signed>,
    ) -> Option<(Shape, bool)> {
        let mut part = |id: Id| match self.view(id) {
            View::Number(_) => Some((Part::Number(id), false)),
            View::Scale(factor, _) if !is_double(self.get_number(factor)) => None,
            _ => operand(id).map(|signed| (Part::Operand(signed.operand), signed.negative)),
        };
        let is_double = |factor: NumberId| is_double(self.get_number(factor));
        match self.view(id) {
            View::Scale(factor, child) if is_double(factor) => {
                let (part, is_opposite) = part(child)?;
                Some((Shape::Scale(factor, part), is_opposite))
            }
            View::Sum(terms) if terms.iter().all(|(factor, _)| is_double(factor)) => {
                let mut terms = terms
                    .iter()
                    .map(|(factor, term)| part(term).map(|(part, negative)| (part, negative, factor)))
                    .collect::<Option<Vec<_>>>()?;
                terms.sort_unstable_by_key(|&(part, negative, factor)| (part, negative, factor.0));
                Some((Shape::Sum(terms), false))
            }
            View::Product(factors) => self.shape_of_product(factors.iter(), part),
            View::Function(function, args) => {
                let args = args.iter().map(part).collect::<Option<Vec<_>>>()?;
                Some((Shape::Function(function, args), false))
            }
            _ => None,
        }
    }

    /// The signs of integer powers are taken out of a product.
    fn shape_of_product(
        &self,
        factors: impl Iterator<Item = (Id, NumberId)>,
        mut part: impl FnMut(Id) -> Option<(Part, bool)>,
    ) -> Option<(Shape, bool)> {
        let (mut powers, mut is_opposite) = (Vec::new(), false);
        for (base, exponent) in factors {
            let (part, negative) = part(base)?;
            let number = self.get_number(exponent);
            is_opposite ^= negative && number.is_integer() && !number.is_even();
            powers.push((part, negative && !number.is_integer(), exponent));
        }
        powers.sort_unstable_by_key(|&(part, negative, exponent)| (part, negative, exponent.0));
        Some((Shape::Product(powers), is_opposite))
    }
}

/// Whether a number is one of the doubles but for rounding.
pub(super) fn is_double(number: &Number) -> bool {
    number.is_zero() || number.to_f64().is_normal()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Assumption;

    /// x and y have one operand up to sign, as two forms of one value have.
    #[test]
    fn parts_of_one_operand_make_one_shape() {
        let g = &mut Graph::new();
        let [x, y, z] = ["x", "y", "z"].map(|name| g.symbol(name, Assumption::Real));
        let operand = |id: Id| {
            let operand = Operand::Input(u32::from(id == z));
            Some(Signed { operand, negative: id == y })
        };
        let [square, cube] =
            [2, 3].map(|n| [x, y].map(|base| g.pow_number(base, &Number::integer(n)).expect("a power")));
        let shape = |g: &Graph, id: Id| g.shape(id, operand);
        assert!(shape(g, square[0]) == shape(g, square[1]));
        let opposite = shape(g, cube[1]).map(|(shape, is_opposite)| (shape, !is_opposite));
        assert!(shape(g, cube[0]) == opposite);
        assert!(shape(g, square[0]) != shape(g, cube[0]));
        let [sum, difference] = [g.add(x, z), g.sub(z, y)];
        assert!(shape(g, sum) != shape(g, difference), "the number before y is -1");
        let sines = [x, y].map(|angle| g.apply(Function::Sin, &[angle]).expect("a sine"));
        assert!(shape(g, sines[0]) != shape(g, sines[1]));
    }

    #[test]
    fn what_is_beyond_the_doubles_has_no_shape() {
        let g = &mut Graph::new();
        let x = g.symbol("x", Assumption::Real);
        let operand = |_| Some(Signed::plus(Operand::Input(0)));
        for (exponent, has_shape) in [(300, true), (-300, true), (400, false), (-400, false)] {
            let power = Number::integer(10).powi(exponent).expect("a power of ten");
            let factor = g.number_id(&power);
            let multiple = g.scale(factor, x);
            assert_eq!(g.shape(multiple, operand).is_some(), has_shape, "{exponent}");
        }
    }
}
