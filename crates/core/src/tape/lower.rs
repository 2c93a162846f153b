//! Lowering: from expressions to the straight-line code of a tape.
//!
//! Every value is computed once, whatever forms it has. Signs travel with the values and end in subtractions, constants
//! are folded, and the negative exponents of a product become one division.

use rustc_hash::FxHashMap;
use std::cmp::Reverse;

use crate::error::Error;
use crate::graph::{ByValue, Factors, Function, Graph, Id, Ids, Kind, NumberId, Terms, View};
use crate::interrupt::tick;
use crate::print::Format;
use crate::value::Number;

use super::emit::{Emitter, Signed};
use super::extended_product::Extended;
use super::schedule::schedule;
use super::sign::absorb_signs;
use super::straight_line::{Instruction, Operand, Tape};

const EARLIER: &str = "what a node reads is lowered before it";

/// Integer powers up to this one are multiplied out.
const LARGEST_POWER: u64 = 1024;

impl Graph {
    /// The straight-line code that computes the outputs from the inputs.
    ///
    /// Inputs are symbols, functions of time and their derivatives, or applications of undefined functions;
    /// they are recognised by value.
    ///
    /// # Errors
    /// If an input is not a variable, or an output depends on a variable that is not an input.
    pub fn tape(&self, inputs: &[Id], outputs: &[Id]) -> Result<Tape, Error> {
        self.tape_or_advice(inputs, outputs, "make each an input")
    }

    /// The same, with what the error advises if a variable has no value.
    ///
    /// # Errors
    /// If an input is not a variable, or an output depends on a variable that is not an input.
    pub fn tape_or_advice(&self, inputs: &[Id], outputs: &[Id], advice: &str) -> Result<Tape, Error> {
        let mut lowering = Lowering::new(self, inputs)?;
        let order = self.post_order_where(outputs, |id| !lowering.is_input(id));
        lowering.note_choices(&order);
        for id in order {
            tick();
            if !lowering.knows(id) {
                let Some(value) = lowering.lower(id) else {
                    return Err(self.missing_inputs(inputs, outputs, advice));
                };
                lowering.remember(id, value);
            }
        }
        lowering.code.tape.outputs = outputs.iter().map(|&id| lowering.output(id)).collect();
        absorb_signs(&mut lowering.code.tape);
        Ok(schedule(&lowering.code.tape, &lowering.code.needs))
    }

    /// The error that names every variable without a value, except those inside an undefined function.
    fn missing_inputs(&self, inputs: &[Id], outputs: &[Id], advice: &str) -> Error {
        let is_input = |id: Id| inputs.iter().any(|&input| self.same(input, id));
        let mut inside: Vec<Id> = Vec::new();
        let mut names: Vec<String> = Vec::new();
        for id in self.post_order_where(outputs, |id| !is_input(id)) {
            if self.kind(id) == Kind::Application {
                inside.push(id);
                names.push(self.to_quotation(id));
            }
        }
        let outside = self.post_order_where(outputs, |id| !is_input(id) && !inside.contains(&id));
        let needed: Vec<Id> = outside.into_iter().filter(|&id| self.is_variable(id)).collect();
        // Together, because different variables may have one name.
        names.extend(self.listing(&needed, Format::Text).results);
        names.sort_unstable();
        names.dedup();
        let explained = self.explain_namesakes(&needed, inputs, ("without a value", "given"));
        Error::MissingInput(format!(
            "no value for {}: {advice}, or substitute it{}",
            names.join(", "),
            explained.map_or_else(String::new, |text| format!("; {text}"))
        ))
    }
}

/// Powers in products beyond the doubles are multiplied out up to this exponent.
const MOST_FACTORS: u64 = 16;

/// The binary exponent of a part of a number beyond the doubles.
const PART: i32 = 1000;
/// The most parts: no double times a number with more is a double.
const MOST_PARTS: u32 = 3;

fn power_of_two(exponent: i32) -> Number {
    let power = Number::integer(2).powi(exponent.into());
    power.expect("a power of two with few digits")
}

struct Lowering<'a> {
    graph: &'a Graph,
    /// The operands that are computed.
    known: ByValue<Signed>,
    /// Those of the nodes that were looked for: whether values with signs agree is asked once for a node, not whenever it
    /// is read.
    found: FxHashMap<Id, Signed>,
    /// Nodes that are computed as they are written: signs and piecewise functions, which may differ at corners from what
    /// has their value elsewhere, and the branches of those, each of which may be accurate in its own range only.
    choices: FxHashMap<Id, Option<Signed>>,
    inputs: ByValue<()>,
    systems: ByValue<Operand>,
    code: Emitter,
}

impl<'a> Lowering<'a> {
    fn new(graph: &'a Graph, inputs: &[Id]) -> Result<Self, Error> {
        let mut lowering = Self {
            graph,
            known: ByValue::default(),
            found: FxHashMap::default(),
            choices: FxHashMap::default(),
            inputs: ByValue::default(),
            systems: ByValue::default(),
            code: Emitter::default(),
        };
        for (&input, position) in inputs.iter().zip(0..) {
            if !graph.is_variable(input) {
                return Err(Error::NotAVariable(graph.to_quotation(input)));
            }
            lowering.code.tape.inputs.push(graph.to_text(input));
            lowering.inputs.push(graph.value(input), input, ());
            if !lowering.knows(input) {
                lowering.remember(input, Signed::plus(Operand::Input(position)));
            }
        }
        Ok(lowering)
    }

    fn is_input(&self, id: Id) -> bool {
        self.graph.find(&self.inputs, id).is_some()
    }

    fn knows(&mut self, id: Id) -> bool {
        match self.choices.get(&id) {
            Some(choice) => choice.is_some(),
            None => self.find(id).is_some(),
        }
    }

    /// The operand of the value of a node, if it is computed.
    fn find(&mut self, id: Id) -> Option<Signed> {
        if let Some(&found) = self.found.get(&id) {
            return Some(found);
        }
        let (value, is_opposite) = self.graph.find_up_to_sign(&self.known, id)?;
        let found = value.flipped_if(is_opposite);
        self.found.insert(id, found);
        Some(found)
    }

    /// Note the operand of a node whose value was not known.
    fn remember(&mut self, id: Id, value: Signed) {
        if let Some(choice) = self.choices.get_mut(&id) {
            *choice = Some(value);
        } else {
            self.known.push(self.graph.value(id), id, value);
            self.found.insert(id, value);
        }
    }

    /// The operand of a child, which comes earlier in the order.
    fn at(&mut self, id: Id) -> Signed {
        if let Some(number) = self.graph.as_number(id) {
            // Numbers have more information than their value in the field.
            return self.code.constant(number.to_f64());
        }
        match self.choices.get(&id) {
            Some(&Some(choice)) => choice,
            _ => self.find(id).expect(EARLIER),
        }
    }

    fn note_choices(&mut self, order: &[Id]) {
        for &id in order {
            tick();
            match self.graph.view(id) {
                View::Function(Function::Sign, _) => {
                    self.choices.insert(id, None);
                }
                View::Function(Function::Piecewise, args) => {
                    let is_node =
                        |id: &Id| !self.graph.is_variable(*id) && self.graph.as_number(*id).is_none();
                    self.choices
                        .extend(std::iter::once(id).chain(args.iter().filter(is_node)).map(|id| (id, None)));
                }
                _ => {}
            }
        }
    }

    fn output(&mut self, id: Id) -> Operand {
        let value = self.at(id);
        self.code.plain(value)
    }

    /// The code of one node; `None` for a variable that is not an input.
    fn lower(&mut self, id: Id) -> Option<Signed> {
        Some(match self.graph.view(id) {
            View::Time | View::Symbol(..) | View::TimeFunction(..) | View::Application { .. } => return None,
            View::Number(number) => self.code.constant(self.graph.get_number(number).to_f64()),
            View::Pi => self.code.constant(std::f64::consts::PI),
            View::Scale(factor, child) => self.term(factor, child),
            View::Sum(terms) => self.sum(terms),
            View::Product(factors) => self.product(factors),
            View::Function(function, args) => self.call(function, args),
            View::LinearSystem { matrix, right } => {
                let system = self.linear_system(matrix, right);
                self.systems.push(self.graph.value(id), id, system);
                Signed::plus(system)
            }
            View::Solution(system, index) => {
                let system = *self.graph.find(&self.systems, system)?;
                self.code.component(system, index)
            }
        })
    }

    /// A multiple of a node.
    fn term(&mut self, factor: NumberId, node: Id) -> Signed {
        let number = self.graph.get_number(factor);
        if let View::Product(factors) = self.graph.view(node)
            && !is_double(number)
        {
            let product = self.extended_product(number, factors);
            return Signed::plus(self.code.rounded(product));
        }
        let node = self.at(node);
        self.multiple(factor, node)
    }

    /// A product with a number beyond the doubles.
    fn extended_product(&mut self, number: &Number, factors: Factors) -> Extended {
        let mut product = self.code.extended_number(number);
        let factors: Vec<_> =
            factors.iter().map(|(base, e)| (base, self.graph.get_number(e).clone())).collect();
        for (base, exponent) in self.graph.opened(&factors) {
            let base = self.at(base);
            let whole = exponent.to_i64().map(i64::unsigned_abs).filter(|&n| n <= MOST_FACTORS);
            let (factor, times) = match whole {
                Some(n) => (base, n),
                None => (self.power(base, &exponent), 1),
            };
            let factor = self.code.plain(factor);
            let factor = self.code.extended(factor);
            for _ in 0..times {
                product = self.code.combined(product, factor, exponent.is_negative());
            }
        }
        product
    }

    /// The value of a number beyond the doubles, or of what it is multiplied by; `None` for all other nodes.
    fn beyond_doubles(&mut self, id: Id) -> Option<Extended> {
        let graph = self.graph;
        let (number, node) = match graph.view(id) {
            View::Number(number) => (number, None),
            View::Scale(factor, node) => (factor, Some(node)),
            _ => return None,
        };
        let number = graph.get_number(number);
        if is_double(number) {
            return None;
        }
        Some(match node.map(|node| (node, graph.view(node))) {
            None => self.code.extended_number(number),
            Some((_, View::Product(factors))) => self.extended_product(number, factors),
            Some((node, _)) => {
                let number = self.code.extended_number(number);
                let node = self.at(node);
                let node = self.code.plain(node);
                let node = self.code.extended(node);
                self.code.combined(number, node, false)
            }
        })
    }

    /// A multiple. A factor beyond the doubles is split into factors within them, all above 1 or all below, so that no
    /// product of some of them is beyond the doubles unless the multiple is.
    fn multiple(&mut self, factor: NumberId, node: Signed) -> Signed {
        let mut rest = self.graph.get_number(factor).clone();
        let mut multiple = node;
        for _ in 0..MOST_PARTS {
            let value = rest.to_f64();
            if value == 0.0 && rest.is_zero() || value.is_normal() {
                break;
            }
            let (part, inverse) = if value.is_infinite() { (PART, -PART) } else { (-PART, PART) };
            let part = self.code.constant(2f64.powi(part));
            multiple = self.code.multiply(part, multiple);
            rest = rest.mul(&power_of_two(inverse));
        }
        let rest = self.code.constant(rest.to_f64());
        self.code.multiply(rest, multiple)
    }

    /// Terms that need many values come first; constants come last, together.
    fn sum(&mut self, terms: Terms) -> Signed {
        let mut constant = 0.0;
        let mut parts: Vec<Signed> = Vec::with_capacity(terms.len());
        for (coefficient, node) in terms.iter() {
            let term = self.term(coefficient, node);
            match self.code.number_in(term) {
                Some(number) => constant += number,
                None => parts.push(term),
            }
        }
        parts.sort_by_key(|term| Reverse(self.code.need_of(*term)));
        if constant != 0.0 || parts.is_empty() {
            let constant = self.code.constant(constant);
            parts.push(constant);
        }
        // The opposite of a sum that ends in a subtraction costs nothing.
        if let Some(subtracted) = parts.iter().rposition(|term| term.negative) {
            let subtracted = parts.remove(subtracted);
            parts.push(subtracted);
        }
        parts.into_iter().reduce(|a, b| self.code.add(a, b)).expect("a constant stands for no terms")
    }

    fn product(&mut self, factors: Factors) -> Signed {
        let mut quotient = Quotient { constant: 1.0, above: Vec::new(), below: Vec::new() };
        for (base, exponent) in factors.iter() {
            let exponent = self.graph.get_number(exponent);
            let power = if let Some(base) = self.beyond_doubles(base) {
                let exponent = self.code.constant(exponent.abs().to_f64()).operand;
                Signed::plus(self.code.power_of_extended(base, exponent))
            } else {
                let base = self.at(base);
                self.power(base, exponent)
            };
            quotient.push(power, self.code.number_in(power), exponent.is_negative());
        }
        self.quotient(quotient)
    }

    /// The power of a magnitude of an exponent.
    fn power(&mut self, base: Signed, exponent: &Number) -> Signed {
        match exponent.to_small() {
            Some((n, d @ (1 | 2))) if n.unsigned_abs() <= LARGEST_POWER => {
                self.code.power(base, n.unsigned_abs(), d == 2)
            }
            _ => {
                let (base, exponent) = (self.code.plain(base), self.code.constant(exponent.abs().to_f64()));
                self.code.emit(Instruction::Binary(Function::Power, base, exponent.operand))
            }
        }
    }

    fn quotient(&mut self, parts: Quotient) -> Signed {
        let code = &mut self.code;
        let constant = code.constant(parts.constant);
        let above = code.multiply_all(parts.above);
        let below = code.multiply_all(parts.below);
        // The number stays outside, where it merges with the numbers of multiples of the product.
        match (above, below) {
            (None, None) => constant,
            (Some(above), None) => code.multiply(constant, above),
            (None, Some(below)) => code.divide(constant, below),
            (Some(above), Some(below)) => {
                let quotient = code.divide(above, below);
                code.multiply(constant, quotient)
            }
        }
    }

    /// Solutions that share a matrix share its factorisation.
    fn linear_system(&mut self, matrix: Ids, right: Ids) -> Operand {
        let matrix: Vec<Operand> = matrix.iter().map(|entry| self.output(entry)).collect();
        let right: Vec<Operand> = right.iter().map(|entry| self.output(entry)).collect();
        let factorization = self.code.factor(right.len(), matrix);
        self.code.solve(factorization, right)
    }

    fn call(&mut self, function: Function, args: Ids) -> Signed {
        if let Function::Log | Function::Power = function
            && let Some(first) = self.beyond_doubles(args.get(0))
        {
            return Signed::plus(if function == Function::Log {
                self.code.logarithm_of_extended(first)
            } else {
                let exponent = self.output(args.get(1));
                self.code.power_of_extended(first, exponent)
            });
        }
        let args: Vec<Operand> = args.iter().map(|arg| self.output(arg)).collect();
        match function {
            Function::Min | Function::Max => {
                let call = |a, b| self.code.emit_plain(Instruction::Binary(function, a, b));
                Signed::plus(args.into_iter().reduce(call).expect("an extremum has arguments"))
            }
            Function::Piecewise => self.choice(&args),
            _ => match args[..] {
                [a, b] => self.code.emit(Instruction::Binary(function, a, b)),
                _ => self.code.emit(Instruction::Unary(function, args[0])),
            },
        }
    }

    /// The first value whose condition is positive: the choices nest from the last one.
    fn choice(&mut self, args: &[Operand]) -> Signed {
        let (otherwise, pairs) = (args[args.len() - 1], args[..args.len() - 1].chunks_exact(2));
        Signed::plus(pairs.rev().fold(otherwise, |otherwise, pair| {
            self.code.emit_plain(Instruction::Select { condition: pair[1], positive: pair[0], otherwise })
        }))
    }
}

/// The parts of a product: constant * above / below.
struct Quotient {
    constant: f64,
    above: Vec<Signed>,
    below: Vec<Signed>,
}

impl Quotient {
    fn push(&mut self, factor: Signed, number: Option<f64>, divides: bool) {
        match (number, divides) {
            (Some(number), false) => self.constant *= number,
            (Some(number), true) => self.constant /= number,
            (None, false) => self.above.push(factor),
            (None, true) => self.below.push(factor),
        }
    }
}

/// Whether a number is one of the doubles but for rounding.
fn is_double(number: &Number) -> bool {
    number.is_zero() || number.to_f64().is_normal()
}
