//! LaTeX, without dollar signs.

use crate::graph::Function;
use crate::value::Number;

use super::linear::{fraction, indices};
use super::name;
use super::order::is_fraction;
use super::tree::{Base, Factor, Sum, Term, assumption_word};

/// The sum in LaTeX.
pub(super) fn write(sum: &Sum) -> String {
    let mut out = String::new();
    for (position, written) in sum.terms.iter().enumerate() {
        out.push_str(match (position, written.coefficient.is_negative()) {
            (0, true) => "-",
            (0, false) => "",
            (_, true) => " - ",
            (_, false) => " + ",
        });
        out.push_str(&term(written));
    }
    out
}

/// A term without its sign.
fn term(term: &Term) -> String {
    let (below, above): (Vec<&Factor>, Vec<&Factor>) =
        term.written_factors().into_iter().partition(|factor| factor.exponent.is_negative());
    let (numerator, denominator) = fraction(&term.coefficient);
    let top = product(&numerator, &above);
    if below.is_empty() && denominator.is_none() {
        return top;
    }
    format!("\\frac{{{top}}}{{{}}}", product(&denominator.unwrap_or("1".into()), &below))
}

/// A number and powers side by side; a sum alone needs no brackets over or under a bar.
fn product(number: &str, factors: &[&Factor]) -> String {
    let mut out = if number == "1" && !factors.is_empty() { String::new() } else { decimal(number) };
    for factor in factors {
        let alone = out.is_empty() && factors.len() == 1 && factor.exponent.abs().is_one();
        let next = match &factor.base {
            base if alone => bare(base),
            base => power(base, &factor.exponent.abs()),
        };
        if !out.is_empty() {
            out.push_str(if next.starts_with(|c: char| c.is_ascii_digit()) { " \\cdot " } else { " " });
        }
        out.push_str(&next);
    }
    out
}

/// 1.5e-7 is 1.5 times a power of ten.
fn decimal(number: &str) -> String {
    match number.split_once('e') {
        Some(("1", exponent)) => format!("10^{{{exponent}}}"),
        Some((mantissa, exponent)) => format!("{mantissa} \\cdot 10^{{{exponent}}}"),
        None => number.to_owned(),
    }
}

fn power(base: &Base, exponent: &Number) -> String {
    if exponent.is_one() {
        let open = matches!(base, Base::Group(_) | Base::Function(Function::Piecewise, _));
        return if open { brackets(&bare(base)) } else { bare(base) };
    }
    match exponent.to_small() {
        Some((1, 2)) => format!("\\sqrt{{{}}}", bare(base)),
        Some((1, degree)) if is_fraction(exponent) => format!("\\sqrt[{degree}]{{{}}}", bare(base)),
        _ => raised(base, &exponent.to_string()),
    }
}

fn raised(base: &Base, exponent: &str) -> String {
    match base {
        Base::Function(function, args) => match latex_name(*function) {
            Some(name) => format!("{name}^{{{exponent}}}{}", arguments(args)),
            None => format!("{}^{{{exponent}}}", closed(base)),
        },
        _ => format!("{}^{{{exponent}}}", closed(base)),
    }
}

/// A base that may carry an exponent.
fn closed(base: &Base) -> String {
    let brackets_needed = match base {
        Base::Group(_) | Base::Application { .. } => true,
        Base::Function(function, _) => !matches!(function, Function::Abs),
        Base::Number(number) => is_fraction(number),
        Base::TimeFunction { order, .. } => *order > DOTS,
        Base::Pi | Base::Time | Base::Symbol { .. } => false,
    };
    if brackets_needed { brackets(&bare(base)) } else { bare(base) }
}

fn brackets(text: &str) -> String {
    format!("\\left({text}\\right)")
}

fn arguments(args: &[Sum]) -> String {
    let args: Vec<String> = args.iter().map(write).collect();
    brackets(&args.join(", "))
}

/// A base without brackets around it.
fn bare(base: &Base) -> String {
    match base {
        Base::Number(number) if is_fraction(number) => {
            format!("\\frac{{{}}}{{{}}}", number.numerator(), number.denominator())
        }
        Base::Number(number) => decimal(&number.to_string()),
        Base::Pi => "\\pi".into(),
        Base::Time => "t".into(),
        Base::Symbol { name, assumption, explicit: true } => {
            format!("{{{}}}_{{\\mathrm{{{}}}}}", name::to_latex(name, ""), assumption_word(*assumption))
        }
        Base::Symbol { name, .. } => name::to_latex(name, ""),
        Base::TimeFunction { name, order, explicit } => {
            let argument = if *explicit { "\\left(t\\right)" } else { "" };
            time_function(name, *order) + argument
        }
        Base::Application { name, args, orders } => {
            let indices = indices(orders);
            let derivative = if indices.is_empty() { String::new() } else { format!("D_{{{indices}}} ") };
            derivative + &name::to_latex(name, "") + &arguments(args)
        }
        Base::Function(function, args) => function_of(*function, args),
        Base::Group(sum) => write(sum),
    }
}

/// Beyond this order a derivative is written x^{(4)}.
const DOTS: u32 = 3;

fn time_function(name: &str, order: u32) -> String {
    let accent = match order {
        1 => "\\dot",
        2 => "\\ddot",
        3 => "\\dddot",
        _ => "",
    };
    let letter = name::to_latex(name, accent);
    if order > DOTS { format!("{letter}^{{({order})}}") } else { letter }
}

fn function_of(function: Function, args: &[Sum]) -> String {
    match function {
        Function::Abs => format!("\\left|{}\\right|", write(&args[0])),
        Function::Exp => format!("e^{{{}}}", write(&args[0])),
        Function::Power => {
            let plain = |number: &&Number| {
                !number.is_negative() && !is_fraction(number) && !number.to_string().contains('e')
            };
            let base = match (args[0].as_base(), args[0].as_number().filter(plain)) {
                (Some(base), _) => closed(base),
                (None, Some(number)) => number.to_string(),
                (None, None) => brackets(&write(&args[0])),
            };
            format!("{base}^{{{}}}", write(&args[1]))
        }
        Function::Piecewise => piecewise(args),
        _ => latex_name(function).expect("a function without a name has a notation above") + &arguments(args),
    }
}

fn piecewise(args: &[Sum]) -> String {
    let branches: Vec<String> = args
        .chunks(2)
        .map(|pair| match pair {
            [value, condition] => format!("{} & \\text{{if }} {} > 0", write(value), write(condition)),
            _ => format!("{} & \\text{{otherwise}}", write(&pair[0])),
        })
        .collect();
    format!("\\begin{{cases}} {} \\end{{cases}}", branches.join(" \\\\ "))
}

/// The name of a function that is written with a name; its powers are written over the name.
fn latex_name(function: Function) -> Option<String> {
    match function {
        Function::Abs | Function::Exp | Function::Power | Function::Piecewise => None,
        Function::Asin => Some("\\arcsin".into()),
        Function::Acos => Some("\\arccos".into()),
        Function::Atan => Some("\\arctan".into()),
        Function::Min => Some("\\min".into()),
        Function::Max => Some("\\max".into()),
        Function::Atan2 | Function::Sign => Some(format!("\\operatorname{{{}}}", function.name())),
        _ => Some(format!("\\{}", function.name())),
    }
}
