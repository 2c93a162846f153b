//! The value of a node in a field, from those of its children.

use std::sync::Arc;

use crate::graph::{
    Column, Combination, Content, Flags, Function, Graph, Id, Ids, Kind, NumberId, View, leaf_in,
};
use crate::interrupt::tick;
use crate::value::{Element, Field, FieldId, Key, Number, Quadratic, fingerprint, in_hash_lane};

use super::rational_power::power_of_content;

impl Graph {
    /// The value of a node in a field: above the first field of a lane, that of the node that stands for its class.
    pub(crate) fn value_in(&self, id: Id, field: FieldId) -> Quadratic {
        if field.is_first() {
            return self.own_value_in(id, field);
        }
        let (first, is_opposite) = self.representative_up_to_sign(id);
        let value = self.own_value_in(first, field);
        if is_opposite { field.field().neg(&value) } else { value }
    }

    fn own_value_in(&self, id: Id, field: FieldId) -> Quadratic {
        if let Some(known) = self.known_in(id, field) {
            return known;
        }
        let mut stack = vec![(id, field)];
        let mut needed = Vec::new();
        while let Some(&(id, field)) = stack.last() {
            tick();
            if let Some((_, point)) = field.other_lane() {
                self.column(id, point); // all these lanes at once
            } else if self.known_in(id, field).is_none() {
                needed.clear();
                self.push_needed(id, field, &mut needed);
                for (id, _) in needed.iter_mut().filter(|(_, field)| !field.is_first()) {
                    (*id, _) = self.representative_up_to_sign(*id);
                }
                needed.retain(|&(id, field)| self.known_in(id, field).is_none());
                if !needed.is_empty() {
                    stack.append(&mut needed);
                    continue;
                }
                let value = self.evaluate(self.view(id), id, field);
                self.lanes.borrow_mut().insert(id, field, value);
            }
            stack.pop();
        }
        self.known_in(id, field).expect("the value has just been found")
    }

    fn known_in(&self, id: Id, field: FieldId) -> Option<Quadratic> {
        if let Some(lane) = field.hash_lane().filter(|_| !self.flags(id).has(Flags::BRANCH)) {
            return Some(in_hash_lane(self.value(id), lane));
        }
        let lanes = self.lanes.borrow();
        match field.other_lane() {
            Some((lane, point)) => lanes.column(id, point).map(|column| column[lane].clone()),
            None => lanes.get(id, field).cloned(),
        }
    }

    /// The values of a node in all lanes but the hash lanes, at one of their points.
    pub(super) fn column(&self, id: Id, point: u16) -> Column {
        if let Some(known) = self.lanes.borrow().column(id, point) {
            return Arc::clone(known);
        }
        let is_unknown = |id: Id| self.lanes.borrow().column(id, point).is_none();
        for node in self.parts_first(&[id], is_unknown) {
            let column = self.column_of(self.view(node), node, point);
            self.lanes.borrow_mut().insert_column(node, point, column);
        }
        self.column(id, point)
    }

    /// The column of a node from those of its children.
    fn column_of(&self, view: View<'_>, id: Id, point: u16) -> Column {
        match view {
            View::Sum(terms) => self.column_of_sum(terms.iter(), point),
            View::Scale(factor, child) => self.column_of_sum([(factor, child)].into_iter(), point),
            View::Product(factors) => self
                .column_of_product(factors.iter().map(|(base, e)| (base, self.get_number(e).clone())), point),
            _ => FieldId::others(point)
                .map(|field| {
                    tick();
                    self.evaluate(view, id, field)
                })
                .collect(),
        }
    }

    pub(super) fn column_of_sum(&self, terms: impl Iterator<Item = (NumberId, Id)>, point: u16) -> Column {
        let zero = |field: FieldId| field.field().number(&Number::integer(0));
        let mut sums: Vec<Quadratic> = FieldId::others(point).map(zero).collect();
        for (factor, node) in terms {
            tick();
            let column = self.column(node, point);
            let images = self.lanes.borrow_mut().images(factor, self.get_number(factor));
            let parts = FieldId::others(point).zip(column.iter()).zip(images.iter());
            for (sum, ((field, value), image)) in sums.iter_mut().zip(parts) {
                let f = field.field();
                *sum = if factor == NumberId::ONE {
                    f.add(sum, value)
                } else {
                    f.add(sum, &f.mul(image, value))
                };
            }
        }
        sums.into()
    }

    pub(super) fn column_of_product(
        &self,
        factors: impl Iterator<Item = (Id, Number)>,
        point: u16,
    ) -> Column {
        let mut products: Vec<Quadratic> = FieldId::others(point).map(|field| field.field().one()).collect();
        for (base, exponent) in factors {
            let column = self.column(base, point);
            for (product, (field, value)) in
                products.iter_mut().zip(FieldId::others(point).zip(column.iter()))
            {
                tick();
                let f = field.field();
                let power = if exponent.is_one() { value } else { &self.power_in(base, &exponent, field) };
                *product = f.mul(product, power);
            }
        }
        products.into()
    }

    /// What has to be known before a node can be evaluated in a field.
    fn push_needed(&self, id: Id, field: FieldId, out: &mut Vec<(Id, FieldId)>) {
        let argument = |args: Ids<'_>, place| self.representative(args.get(place));
        match self.view(id) {
            View::Function(Function::Sin | Function::Cos | Function::Tan, args) => {
                self.push_needed_by_argument(argument(args, 0), field, false, out);
            }
            View::Function(Function::Exp | Function::Sinh | Function::Cosh | Function::Tanh, args) => {
                self.push_needed_by_argument(argument(args, 0), field, true, out);
            }
            View::Function(Function::Power, args) => {
                let (base, exponent) = (argument(args, 0), argument(args, 1));
                out.push((base, field));
                for above in [field.of_angles(), field.of_exponents()] {
                    out.extend(field.points_above(above).map(|above| (exponent, above)));
                }
                for exponents in field.points_above(field.of_exponents()) {
                    self.push_needed_by_logarithm(base, exponents, out);
                }
            }
            View::Function(Function::Log, args) => {
                self.push_needed_by_logarithm(argument(args, 0), field, out);
            }
            View::Solution(system, _) => {
                let (matrix, right) = self.parts_of_system(system);
                out.extend(matrix.into_iter().chain(right).map(|part| (part, field)));
                out.push((system, field));
            }
            _ => {
                let mut parts = Vec::new();
                self.push_parts(id, &mut parts);
                out.extend(parts.iter().map(|&part| (part, field)));
                let signs = field.of_signs();
                if signs != field && signs.hash_lane().is_some() && self.asks_for_signs(id) {
                    out.extend(parts.into_iter().map(|part| (part, signs)));
                }
            }
        }
    }

    /// Whether the value of a node in a field takes the values of its parts in the first field of the lane: for signs, or
    /// for the branches of roots of what may be complex.
    fn asks_for_signs(&self, id: Id) -> bool {
        match self.kind(id) {
            Kind::Function(function) => function.is_choice(),
            Kind::Product => self.flags(id).has(Flags::COMPLEX) && self.flags(id).has(Flags::ROOT),
            _ => false,
        }
    }

    /// The value of a node from those of its children, which are known. `id` is the node of the view.
    fn evaluate(&self, view: View<'_>, id: Id, field: FieldId) -> Quadratic {
        let number = || self.as_number(id).cloned().unwrap_or_else(|| Number::integer(0));
        if let Some(leaf) = leaf_in(view, number, field) {
            return leaf;
        }
        let f = field.field();
        match view {
            View::Scale(factor, child) => {
                f.mul(&f.number(self.get_number(factor)), &self.value_in(child, field))
            }
            View::Sum(terms) => self.sum_in(terms.iter(), field),
            View::Product(factors) => {
                self.product_in(factors.iter().map(|(base, e)| (base, self.get_number(e).clone())), field)
            }
            View::Function(function, args) => {
                let args: Vec<Id> = args.iter().collect();
                self.function_in(function, &args, field)
            }
            View::Application { name, args, orders } => {
                let key = orders
                    .iter()
                    .fold(Key::new("application").text(name), |key, &order| key.word(order.into()));
                self.opaque_in(key, args.iter(), field)
            }
            View::LinearSystem { matrix, right } => {
                self.opaque_in(Key::new("linear system"), matrix.iter().chain(right.iter()), field)
            }
            View::Solution(system, index) => self.solution_in(system, field)[index as usize].clone(),
            View::Number(_) | View::Pi | View::Time | View::Symbol(..) | View::TimeFunction(..) => {
                unreachable!("leaves have been evaluated")
            }
        }
    }

    pub(super) fn opaque_in(&self, key: Key, args: impl Iterator<Item = Id>, field: FieldId) -> Quadratic {
        let values: Vec<Quadratic> = args.map(|arg| self.value_in(self.representative(arg), field)).collect();
        field.field().opaque(key, &values.iter().collect::<Vec<_>>())
    }

    pub(super) fn sum_in(&self, terms: impl Iterator<Item = (NumberId, Id)>, field: FieldId) -> Quadratic {
        let f = field.field();
        terms.fold(f.number(&Number::integer(0)), |sum, (factor, node)| {
            let value = self.value_in(node, field);
            let term = if factor == NumberId::ONE {
                value
            } else {
                f.mul(&f.number(self.get_number(factor)), &value)
            };
            f.add(&sum, &term)
        })
    }

    pub(super) fn product_in(
        &self,
        factors: impl Iterator<Item = (Id, Number)>,
        field: FieldId,
    ) -> Quadratic {
        let f = field.field();
        factors.fold(f.one(), |product, (base, exponent)| {
            f.mul(&product, &self.power_in(base, &exponent, field))
        })
    }

    /// The sign of a real node in a field: that in the first field of the lane, so that a sign in an argument is the same
    /// sign as outside of it.
    pub(super) fn sign_in(&self, id: Id, field: FieldId) -> Quadratic {
        let (f, signs) = (field.field(), field.of_signs());
        match self.value_in(id, signs) {
            value if value.is_zero() => value,
            _ if self.is_negative_in(id, signs) => f.neg(&f.one()),
            _ => f.one(),
        }
    }

    /// Whether a node is negative in a field itself, as roots and logarithms see it.
    pub(super) fn is_negative_in(&self, id: Id, field: FieldId) -> bool {
        let f = field.field();
        self.sign_of(id, &self.value_in(id, field), f) == f.neg(&f.one())
    }

    /// The sign of a real node that has this value.
    pub(super) fn sign_of(&self, id: Id, value: &Quadratic, f: &Field) -> Quadratic {
        signed_by_content(value, self.numeric_content(id, f), f)
    }

    /// The sign of a - b, which has this value.
    pub(super) fn sign_of_difference(&self, difference: &Quadratic, a: Id, b: Id, f: &Field) -> Quadratic {
        signed_by_content(difference, self.content_of(Combination::difference(a, b), f), f)
    }

    /// Which of several nodes is the greatest or the least where they have these values: the first two are compared, the
    /// one that stays is compared with the third, and so on.
    pub(super) fn extremum_in(
        &self,
        function: Function,
        nodes: &[Id],
        value: impl Fn(Id) -> Quadratic,
        f: &Field,
    ) -> Id {
        let pair = |a: Id, b: Id| {
            let difference = f.sub(&value(a), &value(b));
            let sign = self.sign_of_difference(&difference, a, b, f);
            if (sign == f.one()) == (function == Function::Max) { a } else { b }
        };
        nodes.iter().copied().reduce(pair).expect("an extremum is that of one value or more")
    }

    pub(super) fn function_in(&self, function: Function, args: &[Id], field: FieldId) -> Quadratic {
        let f = field.field();
        let args: Vec<Id> = args.iter().map(|&arg| self.representative(arg)).collect();
        let first = args[0];
        let value = |id: Id| self.value_in(id, field);
        match function {
            Function::Sin => self.angle_in(first, field).1,
            Function::Cos => self.angle_in(first, field).0,
            Function::Tan => {
                let (cos, sin) = self.angle_in(first, field);
                f.div(&sin, &cos)
            }
            Function::Exp => self.exponential_in(first, field),
            Function::Sinh | Function::Cosh | Function::Tanh => {
                let exponential = self.exponential_in(first, field);
                let inverse = f.inverse(&exponential);
                let (sinh, cosh) = (f.sub(&exponential, &inverse), f.add(&exponential, &inverse));
                match function {
                    Function::Sinh => f.half(&sinh),
                    Function::Cosh => f.half(&cosh),
                    _ => f.div(&sinh, &cosh),
                }
            }
            Function::Power => self.general_power_in(first, args[1], field),
            Function::Log => self.logarithm_in(first, field),
            Function::Asin | Function::Atan => f.odd(Key::new(function.name()), &value(first)),
            Function::Acos => {
                // acos x = pi/2 - asin x
                let quarter = f.half(&field.draw_positive(&Key::new("pi")));
                f.sub(&quarter, &f.odd(Key::new(Function::Asin.name()), &value(first)))
            }
            Function::Atan2 => self.direction_in(first, args[1], field),
            Function::Abs | Function::Sign if self.is_complex(first) => {
                let modulus = f.opaque(Key::new("modulus"), &[&f.unsigned(&value(first)).0]);
                if function == Function::Abs { modulus } else { f.div(&value(first), &modulus) }
            }
            Function::Abs => self.modulus_in(first, field),
            Function::Sign if !self.has_sign_in(first, field) => {
                f.div(&value(first), &self.modulus_in(first, field))
            }
            Function::Sign => self.sign_in(first, field),
            Function::Min | Function::Max => {
                let signs = field.of_signs();
                value(self.extremum_in(function, &args, |id| self.value_in(id, signs), signs.field()))
            }
            Function::Piecewise => {
                let values: Vec<Quadratic> = args.iter().map(|&arg| value(arg)).collect();
                let signs: Vec<Quadratic> = args.iter().map(|&arg| self.sign_in(arg, field)).collect();
                f.piecewise(&values, &signs)
            }
        }
    }

    /// The fingerprint of a function of arguments, before its node is made.
    pub(crate) fn function_fingerprint(&self, function: Function, args: &[Id]) -> Element {
        in_hash_lanes(|field| self.function_in(function, args, field))
    }

    /// The fingerprint of an undefined function, before its node is made.
    pub(crate) fn application_fingerprint(&self, name: &str, args: &[Id], orders: &[u32]) -> Element {
        let key =
            orders.iter().fold(Key::new("application").text(name), |key, &order| key.word(order.into()));
        in_hash_lanes(|field| self.opaque_in(key, args.iter().copied(), field))
    }
}

/// The sign of a value that has a content, which is positive.
fn signed_by_content(value: &Quadratic, content: Option<Content>, f: &Field) -> Quadratic {
    match content {
        Some(content) => f.sign(&f.mul(value, &power_of_content(&content, &Number::integer(-1), f))),
        None => f.sign(value),
    }
}

/// The fingerprint of what is evaluated in both hash lanes.
pub(super) fn in_hash_lanes(value: impl Fn(FieldId) -> Quadratic) -> Element {
    let [first, second] = FieldId::HASH.map(value);
    fingerprint([&first, &second])
}
