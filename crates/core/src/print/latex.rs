//! LaTeX, without dollar signs.

use crate::graph::Function;
use crate::value::Number;

use super::Fractions;
use super::latex_name::{Typeset, function_name};
use super::linear::{fraction, indices};
use super::order::is_fraction;
use super::tree::{Base, Factor, Sum, Term, assumption_word};

/// The sum in LaTeX.
pub(super) fn write(names: &Typeset, fractions: Fractions, sum: &Sum) -> String {
    Writer { names, fractions }.sum(sum)
}

struct Writer<'a> {
    names: &'a Typeset,
    fractions: Fractions,
}

impl Writer<'_> {
    fn sum(&self, sum: &Sum) -> String {
        self.terms(sum, self.fractions)
    }

    /// An argument of a function.
    fn argument(&self, argument: &Sum) -> String {
        self.terms(argument, self.fractions.in_argument(argument))
    }

    fn terms(&self, sum: &Sum, fractions: Fractions) -> String {
        let mut out = String::new();
        for (position, written) in sum.terms.iter().enumerate() {
            out.push_str(match (position, written.coefficient.is_negative()) {
                (0, true) => "-",
                (0, false) => "",
                (_, true) => " - ",
                (_, false) => " + ",
            });
            out.push_str(&self.term(written, fractions));
        }
        out
    }

    /// A term without its sign.
    fn term(&self, term: &Term, fractions: Fractions) -> String {
        let (below, above): (Vec<&Factor>, Vec<&Factor>) =
            term.written_factors().into_iter().partition(|factor| factor.exponent.is_negative());
        let (numerator, denominator) = fraction(&term.coefficient);
        if fractions.lead((&numerator, denominator.as_ref()), &above, &below) {
            let bar = self.product(&denominator.unwrap_or_default(), &[]);
            return self.beside(format!("\\frac{{{numerator}}}{{{bar}}}"), &above);
        }
        let top = self.product(&numerator, &above);
        if below.is_empty() && denominator.is_none() {
            return top;
        }
        format!("\\frac{{{top}}}{{{}}}", self.product(&denominator.unwrap_or("1".into()), &below))
    }

    /// A number and powers side by side; a sum alone needs no brackets over or under a bar.
    fn product(&self, number: &str, factors: &[&Factor]) -> String {
        match factors {
            [only] if number == "1" && only.exponent.abs().is_one() => self.bare(&only.base),
            [_, ..] if number == "1" => self.beside(String::new(), factors),
            _ => self.beside(decimal(number), factors),
        }
    }

    /// Powers behind what is written already.
    fn beside(&self, mut out: String, factors: &[&Factor]) -> String {
        let mut after_word = false;
        for factor in factors {
            let next = self.power(&factor.base, &factor.exponent.abs());
            let is_word = begins_with_word(&next);
            if !out.is_empty() {
                out.push_str(match next.starts_with(|c: char| c.is_ascii_digit()) {
                    true => " \\cdot ",
                    false if is_word || after_word => " \\, ",
                    false => " ",
                });
            }
            out.push_str(&next);
            after_word = is_word;
        }
        out
    }

    fn power(&self, base: &Base, exponent: &Number) -> String {
        if exponent.is_one() {
            let open = matches!(base, Base::Group(_) | Base::Function(Function::Piecewise, _));
            return if open { brackets(&self.bare(base)) } else { self.bare(base) };
        }
        match exponent.to_small() {
            Some((1, 2)) => format!("\\sqrt{{{}}}", self.bare(base)),
            Some((1, degree)) if is_fraction(exponent) => format!("\\sqrt[{degree}]{{{}}}", self.bare(base)),
            _ => self.raised(base, &exponent.to_string()),
        }
    }

    /// A power; the exponent of a function of one argument stands beside its name.
    fn raised(&self, base: &Base, exponent: &str) -> String {
        match base {
            Base::Function(function, args) => match (function_name(*function), args.len()) {
                (Some(name), 1) => format!("{name}^{{{exponent}}}{}", self.arguments(args)),
                (Some(_), _) => format!("{}^{{{exponent}}}", self.bare(base)),
                (None, _) => format!("{}^{{{exponent}}}", self.closed(base)),
            },
            _ => format!("{}^{{{exponent}}}", self.closed(base)),
        }
    }

    /// A base that may carry an exponent.
    fn closed(&self, base: &Base) -> String {
        let brackets_needed = match base {
            Base::Group(_) | Base::Application { .. } => true,
            Base::Function(function, _) => !matches!(function, Function::Abs),
            Base::Number(number) => is_fraction(number),
            Base::TimeFunction { name, order, .. } => self.names.name(name, *order).has_superscript,
            Base::Symbol { name, .. } => self.names.name(name, 0).has_superscript,
            Base::Pi | Base::Time => false,
        };
        if brackets_needed { brackets(&self.bare(base)) } else { self.bare(base) }
    }

    fn arguments(&self, args: &[Sum]) -> String {
        let args: Vec<String> = args.iter().map(|arg| self.argument(arg)).collect();
        let text = args.join(", ");
        // Brackets that grow have a space before them: `cos(q)` has none in print.
        if TALL.iter().any(|part| text.contains(part)) { brackets(&text) } else { format!("({text})") }
    }

    /// A base without brackets around it.
    fn bare(&self, base: &Base) -> String {
        match base {
            Base::Number(number) if is_fraction(number) => {
                format!("\\frac{{{}}}{{{}}}", number.numerator(), number.denominator())
            }
            Base::Number(number) => decimal(&number.to_string()),
            Base::Pi => "\\pi".into(),
            Base::Time => "t".into(),
            Base::Symbol { name, assumption, explicit: true, .. } => {
                let word = assumption_word(*assumption);
                format!("{{{}}}_{{\\mathrm{{{word}}}}}", self.names.name(name, 0).text)
            }
            Base::Symbol { name, .. } => self.names.name(name, 0).text,
            Base::TimeFunction { name, order, explicit, mark, .. } => {
                let argument = if *explicit { "\\left(t\\right)" } else { "" };
                let text = self.names.name(name, *order).text;
                let text = if mark.is_empty() { text } else { format!("{{{text}}}_{{\\mathrm{{{mark}}}}}") };
                text + argument
            }
            Base::Application { name, args, orders } => {
                let indices = indices(orders);
                let derivative = if indices.is_empty() { String::new() } else { format!("D_{{{indices}}} ") };
                derivative + &self.names.name(name, 0).text + &self.arguments(args)
            }
            Base::Function(function, args) => self.function(*function, args),
            Base::Group(sum) => self.sum(sum),
        }
    }

    fn function(&self, function: Function, args: &[Sum]) -> String {
        match function {
            Function::Abs => format!("\\left|{}\\right|", self.argument(&args[0])),
            Function::Exp => format!("e^{{{}}}", self.argument(&args[0])),
            Function::Power => {
                let plain = |number: &&Number| {
                    !number.is_negative() && !is_fraction(number) && !number.to_string().contains('e')
                };
                let base = match (args[0].as_base(), args[0].as_number().filter(plain)) {
                    (Some(base), _) => self.closed(base),
                    (None, Some(number)) => number.to_string(),
                    (None, None) => brackets(&self.sum(&args[0])),
                };
                format!("{base}^{{{}}}", self.argument(&args[1]))
            }
            Function::Piecewise => self.piecewise(args),
            _ => {
                function_name(function).expect("a function without a name has a notation above")
                    + &self.arguments(args)
            }
        }
    }

    fn piecewise(&self, args: &[Sum]) -> String {
        let branches: Vec<String> = args
            .chunks(2)
            .map(|pair| match pair {
                [value, condition] => {
                    format!("{} & \\text{{if }} {} > 0", self.sum(value), self.sum(condition))
                }
                _ => format!("{} & \\text{{otherwise}}", self.sum(&pair[0])),
            })
            .collect();
        format!("\\begin{{cases}} {} \\end{{cases}}", branches.join(" \\\\ "))
    }
}

/// 1.5e-7 and 15000000000.0 are 1.5 times a power of ten.
fn decimal(number: &str) -> String {
    let scientific = with_exponent(number);
    match scientific.as_deref().unwrap_or(number).split_once('e') {
        Some(("1", exponent)) => format!("10^{{{exponent}}}"),
        Some((mantissa, exponent)) => format!("{mantissa} \\cdot 10^{{{exponent}}}"),
        None => number.to_owned(),
    }
}

/// A decimal number that ends with many zeros, with a power of ten.
fn with_exponent(number: &str) -> Option<String> {
    let whole = number.strip_suffix(".0")?;
    let digits = whole.trim_end_matches('0');
    if whole.len() - digits.len() < MANY_ZEROS || digits.is_empty() {
        return None;
    }
    let point = if digits.len() > 1 { "." } else { "" };
    Some(format!("{}{point}{}e{}", &digits[..1], &digits[1..], whole.len() - 1))
}

/// The zeros at the end of a decimal number from which on it is written with a power of ten.
const MANY_ZEROS: usize = 5;

fn brackets(text: &str) -> String {
    format!("\\left({text}\\right)")
}

/// Whether a factor is a name of several letters, which would run into its neighbours.
fn begins_with_word(text: &str) -> bool {
    let mut letter = text;
    while let Some(inner) = ACCENTS.iter().find_map(|accent| letter.strip_prefix(accent)) {
        letter = inner;
    }
    letter.starts_with("\\mathrm{") || letter.starts_with("\\mathtt{")
}

/// What is higher than brackets of the usual size.
const TALL: [&str; 5] = ["\\frac", "\\sqrt", "\\begin", "\\left", "^"];

/// What may stand before the letters of a name.
const ACCENTS: [&str; 6] = ["{", "\\dot{", "\\ddot{", "\\dddot{", "\\hat{", "\\tilde{"];
