//! Names: in natural order, and quoted for Maple where they must be.

use std::cmp::Ordering;

/// Natural order: l2 before l10, letters without regard to case, then exactly.
pub(crate) fn compare(a: &str, b: &str) -> Ordering {
    let (mut x, mut y) = (a, b);
    while !x.is_empty() && !y.is_empty() {
        let (left, right) = (chunk(x), chunk(y));
        let order = match (number(left), number(right)) {
            (Some(m), Some(n)) => m.len().cmp(&n.len()).then(m.cmp(n)),
            _ => left.to_lowercase().cmp(&right.to_lowercase()),
        };
        if order.is_ne() {
            return order;
        }
        (x, y) = (&x[left.len()..], &y[right.len()..]);
    }
    x.len().cmp(&y.len()).then(a.len().cmp(&b.len())).then(a.cmp(b))
}

/// The longest prefix that consists of digits only, or that has no digit.
fn chunk(text: &str) -> &str {
    let digits = text.starts_with(|c: char| c.is_ascii_digit());
    let end = text.find(|c: char| c.is_ascii_digit() != digits).unwrap_or(text.len());
    &text[..end]
}

/// The digits of a number without leading zeros.
fn number(chunk: &str) -> Option<&str> {
    chunk.starts_with(|c: char| c.is_ascii_digit()).then(|| chunk.trim_start_matches('0'))
}

/// Words of Maple's language: in backquotes they are names like any other.
const MAPLE_WORDS: [&str; 48] = [
    "and",
    "assuming",
    "break",
    "by",
    "catch",
    "description",
    "do",
    "done",
    "elif",
    "else",
    "end",
    "error",
    "export",
    "fi",
    "finally",
    "for",
    "from",
    "global",
    "if",
    "implies",
    "in",
    "intersect",
    "local",
    "minus",
    "mod",
    "module",
    "next",
    "not",
    "od",
    "option",
    "options",
    "or",
    "proc",
    "quit",
    "read",
    "return",
    "save",
    "stop",
    "subset",
    "then",
    "to",
    "try",
    "union",
    "until",
    "use",
    "uses",
    "while",
    "xor",
];

/// Names to which Maple gives a meaning, in backquotes too.
const MAPLE_MEANINGS: [&str; 84] = [
    "I",
    "D",
    "O",
    "Pi",
    "gamma",
    "Catalan",
    "infinity",
    "undefined",
    "true",
    "false",
    "FAIL",
    "NULL",
    "Digits",
    "Order",
    "GAMMA",
    "Beta",
    "Zeta",
    "Psi",
    "Ei",
    "Li",
    "Si",
    "Ci",
    "Chi",
    "Shi",
    "Re",
    "Im",
    "W",
    "LambertW",
    "sin",
    "cos",
    "tan",
    "cot",
    "sec",
    "csc",
    "sinh",
    "cosh",
    "tanh",
    "arcsin",
    "arccos",
    "arctan",
    "exp",
    "ln",
    "log",
    "sqrt",
    "root",
    "abs",
    "signum",
    "min",
    "max",
    "floor",
    "ceil",
    "round",
    "trunc",
    "frac",
    "piecewise",
    "diff",
    "Diff",
    "int",
    "Int",
    "sum",
    "Sum",
    "product",
    "Product",
    "limit",
    "Limit",
    "series",
    "solve",
    "subs",
    "eval",
    "evalf",
    "simplify",
    "expand",
    "factor",
    "collect",
    "coeff",
    "normal",
    "map",
    "seq",
    "op",
    "type",
    "time",
    "rhs",
    "lhs",
    "norm",
];

/// The name in Maple: in backquotes unless it is made of letters, digits and underscores and no word of the
/// language; a name with a meaning gets one underscore more (`I` is `I_`, and `I_` is `I__`).
pub(super) fn to_maple(name: &str) -> String {
    if MAPLE_MEANINGS.contains(&name.trim_end_matches('_')) {
        return format!("{name}_");
    }
    let letter = |c: char| c.is_ascii_alphabetic() || c == '_';
    let plain = name.starts_with(letter) && name.chars().all(|c| letter(c) || c.is_ascii_digit());
    if plain && !MAPLE_WORDS.contains(&name) {
        name.to_owned()
    } else {
        format!("`{}`", name.replace('`', "``"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_in_natural_order() {
        let mut names = ["l10", "m", "l2", "I1", "l", "L2", "l02"];
        names.sort_by(|a, b| compare(a, b));
        assert_eq!(names, ["I1", "l", "L2", "l2", "l02", "l10", "m"]);
    }

    #[test]
    fn maple_names_mean_nothing_else() {
        let names = ["q1", "in", "I", "I_", "gamma", "D", "a b"].map(to_maple);
        assert_eq!(names, ["q1", "`in`", "I_", "I__", "gamma_", "D_", "`a b`"]);
    }
}
