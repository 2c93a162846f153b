//! The one-dimensional notations: everything on one line, with `*` and `/`. A dialect defines what differs.

use crate::graph::Function;
use crate::interrupt::tick;
use crate::value::Number;

use super::Fractions;
use super::order::is_fraction;
use super::tree::{Base, Factor, Sum, Term, assumption_word};

/// What differs between the notations.
pub(super) trait Dialect {
    const PLUS: &str;
    const MINUS: &str;
    const POWER: &str;
    const COMMA: &str;
    const PI: &str;

    fn fractions(&self) -> Fractions {
        Fractions::OverAll
    }
    fn name(&self, name: &str) -> String;
    /// A function of time, differentiated `order` times.
    fn time_function(&self, name: &str, order: u32, explicit: bool) -> String;
    fn function_name(&self, function: Function) -> &'static str;
    /// One branch from its value and its condition; the last one has no condition.
    fn branch(&self, value: &str, condition: Option<&str>) -> String;
}

/// The sum in this dialect.
pub(super) fn write<D: Dialect>(dialect: &D, sum: &Sum) -> String {
    let mut writer = Writer { dialect, out: String::new() };
    writer.sum(sum);
    writer.out
}

struct Writer<'a, D> {
    dialect: &'a D,
    out: String,
}

impl<D: Dialect> Writer<'_, D> {
    fn sum(&mut self, sum: &Sum) {
        self.terms(sum, self.dialect.fractions());
    }

    /// An argument of a function.
    fn argument(&mut self, argument: &Sum) {
        self.terms(argument, self.dialect.fractions().in_argument(argument));
    }

    fn terms(&mut self, sum: &Sum, fractions: Fractions) {
        for (position, term) in sum.terms.iter().enumerate() {
            tick();
            match (position, term.coefficient.is_negative()) {
                (0, true) => self.out.push('-'),
                (0, false) => {}
                (_, true) => self.out.push_str(D::MINUS),
                (_, false) => self.out.push_str(D::PLUS),
            }
            self.term(term, fractions);
        }
    }

    /// A term without its sign.
    fn term(&mut self, term: &Term, fractions: Fractions) {
        let (below, above): (Vec<&Factor>, Vec<&Factor>) =
            term.written_factors().into_iter().partition(|factor| factor.exponent.is_negative());
        let (mut numerator, mut denominator) = fraction(&term.coefficient);
        if fractions.lead((&numerator, denominator.as_ref()), &above, &below) {
            numerator.extend(denominator.take().map(|denominator| format!("/{denominator}")));
        }
        let has_number = numerator != "1" || above.is_empty();
        if has_number {
            self.out.push_str(&numerator);
        }
        self.factors(&above, has_number);
        let count = below.len() + usize::from(denominator.is_some());
        if count == 0 {
            return;
        }
        self.out.push_str(if count > 1 { "/(" } else { "/" });
        let has_number = denominator.is_some();
        self.out.push_str(&denominator.unwrap_or_default());
        self.factors(&below, has_number);
        if count > 1 {
            self.out.push(')');
        }
    }

    fn factors(&mut self, factors: &[&Factor], mut star: bool) {
        for factor in factors {
            if star {
                self.out.push('*');
            }
            star = true;
            self.power(&factor.base, &factor.exponent.abs());
        }
    }

    fn power(&mut self, base: &Base, exponent: &Number) {
        if exponent.is_one() {
            if is_power(base) {
                // A power as a factor needs no brackets of its own.
                self.bare_base(base);
            } else {
                self.base(base);
            }
        } else if *exponent == Number::rational(1, 2) {
            self.out.push_str("sqrt(");
            self.bare_base(base);
            self.out.push(')');
        } else {
            self.base(base);
            self.out.push_str(D::POWER);
            if exponent.is_integer() || exponent.is_decimal() {
                self.out.push_str(&exponent.to_string());
            } else {
                self.bracketed(|writer| writer.out.push_str(&exponent.to_string()));
            }
        }
    }

    fn bracketed(&mut self, inner: impl FnOnce(&mut Self)) {
        self.out.push('(');
        inner(self);
        self.out.push(')');
    }

    /// A base that may be raised to a power.
    fn base(&mut self, base: &Base) {
        let brackets = match base {
            Base::Group(_) => true,
            Base::Number(number) => is_fraction(number),
            _ => is_power(base),
        };
        if brackets {
            self.bracketed(|writer| writer.bare_base(base));
        } else {
            self.bare_base(base);
        }
    }

    fn bare_base(&mut self, base: &Base) {
        match base {
            Base::Number(number) => self.out.push_str(&number.to_string()),
            Base::Pi => self.out.push_str(D::PI),
            Base::Time => self.out.push('t'),
            Base::Symbol { name, assumption, explicit, .. } => {
                self.out.push_str(&self.dialect.name(name));
                if *explicit {
                    for part in ["[", assumption_word(*assumption), "]"] {
                        self.out.push_str(part);
                    }
                }
            }
            Base::TimeFunction { name, order, explicit, mark, .. } => {
                let name = if mark.is_empty() { name.clone() } else { format!("{name}[{mark}]") };
                self.out.push_str(&self.dialect.time_function(&name, *order, *explicit));
            }
            Base::Application { name, args, orders } => self.application(name, args, orders),
            Base::Function(Function::Power, args) => self.general_power(&args[0], &args[1]),
            Base::Function(Function::Piecewise, args) => self.piecewise(args),
            Base::Function(function, args) => {
                self.out.push_str(self.dialect.function_name(*function));
                self.arguments(args);
            }
            Base::Group(sum) => self.sum(sum),
        }
    }

    fn arguments(&mut self, args: &[Sum]) {
        self.bracketed(|writer| {
            for (position, arg) in args.iter().enumerate() {
                if position > 0 {
                    writer.out.push_str(D::COMMA);
                }
                writer.argument(arg);
            }
        });
    }

    /// `f(x, y)`, or `D[1,2,2](f)(x, y)` if it is differentiated once by its first and twice by its second argument.
    fn application(&mut self, name: &str, args: &[Sum], orders: &[u32]) {
        let name = self.dialect.name(name);
        let indices = indices(orders);
        let operator = if indices.is_empty() { name } else { format!("D[{indices}]({name})") };
        self.out.push_str(&operator);
        self.arguments(args);
    }

    fn general_power(&mut self, base: &Sum, exponent: &Sum) {
        self.operand(base);
        self.out.push_str(D::POWER);
        self.operand(exponent);
    }

    fn operand(&mut self, sum: &Sum) {
        let plain_number =
            sum.as_number().is_some_and(|number| !number.is_negative() && !is_fraction(number));
        match sum.as_base() {
            Some(base) => self.base(base),
            None if plain_number => self.sum(sum),
            None => self.bracketed(|writer| writer.sum(sum)),
        }
    }

    fn piecewise(&mut self, args: &[Sum]) {
        let texts: Vec<String> = args.iter().map(|arg| write(self.dialect, arg)).collect();
        let branches = texts.chunks(2).map(|pair| {
            let condition = pair.get(1).map(String::as_str);
            self.dialect.branch(&pair[0], condition)
        });
        let branches: Vec<String> = branches.collect();
        self.out.push_str(self.dialect.function_name(Function::Piecewise));
        self.bracketed(|writer| writer.out.push_str(&branches.join(D::COMMA)));
    }
}

fn is_power(base: &Base) -> bool {
    matches!(base, Base::Function(Function::Power, _))
}

/// The numbers of the arguments by which a function is differentiated: 1,2,2.
pub(super) fn indices(orders: &[u32]) -> String {
    let mut out = Vec::new();
    for (position, &order) in orders.iter().enumerate() {
        out.extend((0..order).map(|_| (position + 1).to_string()));
    }
    out.join(",")
}

/// Numerator and denominator of the size of a number; decimals have no denominator, unless their digits never end. An
/// integer above a denominator has no decimal point.
pub(super) fn fraction(number: &Number) -> (String, Option<String>) {
    let size = number.abs();
    if let Some((numerator, denominator)) = size.decimal_over_integer() {
        let numerator = numerator.with_decimal(!numerator.is_integer());
        (numerator.to_string(), Some(denominator.to_string()))
    } else if is_fraction(&size) {
        (size.numerator().to_string(), Some(size.denominator().to_string()))
    } else if size.is_one() {
        ("1".into(), None)
    } else {
        (size.to_string(), None)
    }
}
