//! Arguments of trigonometric and exponential functions at the random point.
//!
//! An argument is a sum of rational multiples of atoms (monomials without coefficient), of pi and of 1.
//! Each atom has a point of the circle group (a member of the multiplicative group) that is drawn, and a sum of
//! arguments is a product of points. So identities hold for sums, for double and half angles, and for quarter turns:
//! sin(a + b) = sin a cos b + cos a sin b.

use crate::graph::{Graph, Id, NumberId, View};
use crate::value::{Circle, Element, Key, Number, TORSION};

/// Arguments with more monomials than this are taken as one atom.
const LONGEST_ARGUMENT: usize = 256;

type Monomials = Vec<(Number, Element)>;

/// An argument as a linear combination; atoms are given by their values up to sign.
struct Linear {
    /// The rational number in the argument, in radians.
    number: Number,
    /// The multiple of pi.
    pi: Number,
    atoms: Vec<(Element, Number)>,
}

impl Linear {
    fn push(&mut self, value: Element, coefficient: &Number) {
        let (atom, negated) = value.unsigned();
        let coefficient = if negated { coefficient.neg() } else { coefficient.clone() };
        match self.atoms.iter_mut().find(|(known, _)| *known == atom) {
            Some((_, total)) => *total = total.add(&coefficient),
            None => self.atoms.push((atom, coefficient)),
        }
    }
}

/// A step of the expansion of an argument; the steps are kept on a stack.
enum Step {
    Visit(Id),
    Atom(Element),
    Add(Vec<Number>),
    Multiply(usize),
}

impl Graph {
    fn linear(&self, argument: Id) -> Linear {
        let pi = Element::draw(&Key::new("pi"));
        let mut linear = Linear { number: Number::integer(0), pi: Number::integer(0), atoms: Vec::new() };
        let monomials =
            self.monomials(argument).unwrap_or_else(|| vec![(Number::integer(1), self.value(argument))]);
        for (coefficient, value) in monomials {
            if value == Element::ONE {
                linear.number = linear.number.add(&coefficient);
            } else if value == pi {
                linear.pi = linear.pi.add(&coefficient);
            } else {
                linear.push(value, &coefficient);
            }
        }
        linear.atoms.retain(|(_, coefficient)| !coefficient.is_zero());
        linear
    }

    /// The rational number in an angle, in radians, without the multiple of pi.
    #[must_use]
    pub fn radians(&self, angle: Id) -> Number {
        self.linear(angle).number
    }

    /// The expanded monomials of a node; `None` when there are too many.
    fn monomials(&self, id: Id) -> Option<Monomials> {
        if self.has_many_monomials(id) {
            return None;
        }
        let mut steps = vec![Step::Visit(id)];
        let mut done: Vec<Monomials> = Vec::new();
        while let Some(step) = steps.pop() {
            if steps.len().max(done.len()) > 8 * LONGEST_ARGUMENT {
                return None;
            }
            match step {
                Step::Visit(id) => self.plan(id, &mut steps),
                Step::Atom(value) => done.push(vec![(Number::integer(1), value)]),
                Step::Add(factors) => {
                    let parts = done.split_off(done.len() - factors.len());
                    done.push(add_monomials(parts, &factors)?);
                }
                Step::Multiply(count) => {
                    let parts = done.split_off(done.len() - count);
                    done.push(multiply_monomials(&parts)?);
                }
            }
        }
        done.pop()
    }

    /// Whether the terms of nested sums alone are too many. Multiplying them out would take too long to decide this.
    ///
    /// A product has as many monomials as one of its factors, or more.
    fn has_many_monomials(&self, id: Id) -> bool {
        let (mut waiting, mut found) = (vec![id], 0);
        for _ in 0..8 * LONGEST_ARGUMENT {
            let Some(id) = waiting.pop() else { break };
            match self.view(id) {
                View::Scale(_, child) => waiting.push(child),
                View::Sum(terms) => waiting.extend(terms.iter().map(|(_, node)| node)),
                View::Product(factors) => match factors.iter().find(|&factor| self.is_multiplied_out(factor))
                {
                    Some((base, _)) => waiting.push(base),
                    None => found += 1,
                },
                _ => found += 1,
            }
            if found + waiting.len() > LONGEST_ARGUMENT {
                return true;
            }
        }
        false
    }

    /// Whether a factor of a product is opened by [`Self::plan_product`], and may have several monomials.
    fn is_multiplied_out(&self, (base, exponent): (Id, NumberId)) -> bool {
        let exponent = self.get_number(exponent).to_i64();
        matches!(self.view(base), View::Scale(..) | View::Sum(_)) && matches!(exponent, Some(1..=6))
    }

    /// The steps that expand one node.
    fn plan(&self, id: Id, steps: &mut Vec<Step>) {
        match self.view(id) {
            View::Number(number) => {
                steps.push(Step::Add(vec![self.get_number(number).clone()]));
                steps.push(Step::Atom(Element::ONE));
            }
            View::Scale(factor, child) => {
                steps.push(Step::Add(vec![self.get_number(factor).clone()]));
                steps.push(Step::Visit(child));
            }
            View::Sum(terms) => {
                steps.push(Step::Add(terms.iter().map(|(c, _)| self.get_number(c).clone()).collect()));
                steps.extend(terms.iter().rev().map(|(_, node)| Step::Visit(node)));
            }
            View::Product(_) => self.plan_product(id, steps),
            _ => steps.push(Step::Atom(self.value(id))),
        }
    }

    /// The steps that expand a product: nested products opened, sums to small powers multiplied out.
    fn plan_product(&self, id: Id, steps: &mut Vec<Step>) {
        let mut coefficient = Number::integer(1);
        let mut parts = Vec::new();
        let mut open = vec![(id, Number::integer(1))];
        while let Some((base, exponent)) = open.pop() {
            match (self.view(base), exponent.to_i64()) {
                (View::Product(factors), Some(_)) => {
                    open.extend(factors.iter().map(|(node, e)| (node, self.get_number(e).mul(&exponent))));
                }
                (View::Scale(factor, child), Some(n)) => match self.get_number(factor).powi(n) {
                    Ok(power) => {
                        coefficient = coefficient.mul(&power);
                        open.push((child, exponent));
                    }
                    // The number is too large, so the power stays an atom.
                    Err(_) => parts.push(Step::Atom(self.power_value(base, &exponent))),
                },
                (View::Sum(_), Some(n @ 1..=6)) => parts.extend((0..n).map(|_| Step::Visit(base))),
                _ => parts.push(Step::Atom(self.power_value(base, &exponent))),
            }
        }
        steps.push(Step::Add(vec![coefficient]));
        steps.push(Step::Multiply(parts.len()));
        steps.append(&mut parts);
    }

    /// The point of the circle group of an angle.
    pub(super) fn circle(&mut self, argument: Id) -> Circle {
        if let Some(&point) = self.angles.get(&argument) {
            return point;
        }
        let linear = self.linear(argument);
        let mut point = torsion(&linear.pi);
        if !linear.number.is_zero() {
            point = point.rotate(Circle::draw(&Key::new("radian")).times(&linear.number));
        }
        for (atom, coefficient) in &linear.atoms {
            point = point.rotate(Circle::draw(&Key::new("angle").element(*atom)).times(coefficient));
        }
        self.angles.insert(argument, point);
        point
    }

    /// The value of exp(argument).
    pub(super) fn exponential(&self, argument: Id) -> Element {
        let mut linear = self.linear(argument);
        let pi = linear.pi.clone();
        if !pi.is_zero() {
            linear.push(Element::draw(&Key::new("pi")), &pi);
        }
        let unit = Element::draw_exponential(&Key::new("e")).pow_rational(&linear.number);
        linear.atoms.iter().fold(unit, |value, (atom, coefficient)| {
            value * Element::draw_exponential(&Key::new("exponent").element(*atom)).pow_rational(coefficient)
        })
    }

    /// The value of base ** exponent for an exponent that is not a number: x^(n + a) = x^n x^a, except for x = 0.
    pub(crate) fn general_power(&self, base: Id, exponent: Id) -> Element {
        let key = Key::new("power").element(self.value(base));
        if base == Id::ZERO {
            // 0^(a - 1) is not a product of 0^a and a power of zero.
            return Element::draw(&key.element(self.value(exponent)));
        }
        let linear = self.linear(exponent);
        let atoms = linear.atoms.iter().map(|(atom, coefficient)| (*atom, coefficient.clone()));
        let pi = (!linear.pi.is_zero()).then(|| (Element::draw(&Key::new("pi")), linear.pi.clone()));
        atoms.chain(pi).fold(self.power_value(base, &linear.number), |value, (atom, coefficient)| {
            value * Element::draw_exponential(&key.element(atom)).pow_rational(&coefficient)
        })
    }
}

/// The terms of a linear combination; `None` if there are too many, because no later step reduces their number.
fn add_monomials(parts: Vec<Monomials>, factors: &[Number]) -> Option<Monomials> {
    if parts.iter().map(Vec::len).sum::<usize>() > LONGEST_ARGUMENT {
        return None;
    }
    let scaled = |(part, factor): (Monomials, &Number)| {
        part.into_iter().map(|(c, value)| (c.mul(factor), value)).collect::<Vec<_>>()
    };
    Some(parts.into_iter().zip(factors).flat_map(scaled).collect())
}

fn multiply_monomials(parts: &[Monomials]) -> Option<Monomials> {
    let mut product = vec![(Number::integer(1), Element::ONE)];
    for part in parts {
        if product.len() * part.len() > LONGEST_ARGUMENT {
            return None;
        }
        product =
            product.iter().flat_map(|(a, x)| part.iter().map(move |(b, y)| (a.mul(b), *x * *y))).collect();
    }
    Some(product)
}

/// The point of a multiple of pi: exact for denominators that divide 55440, drawn for others.
fn torsion(multiple: &Number) -> Circle {
    let turns = multiple.mul(&Number::rational(1, 2));
    let turns = turns.sub(&turns.floor());
    if turns.is_zero() {
        return Circle::ONE;
    }
    let steps = turns.mul(&Number::whole(TORSION.into()));
    if let Some(k) = steps.to_i64() {
        return Circle::torsion(k.unsigned_abs());
    }
    let key = Key::new("part of a turn").text(&turns.denominator().to_string());
    Circle::draw(&key).times(&Number::whole(turns.numerator()))
}
