//! Names: in natural order, with Greek letters and subscripts in LaTeX, quoted for Maple where they must be.

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

const GREEK: [&str; 34] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu",
    "nu", "xi", "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega", "Gamma", "Delta",
    "Theta", "Lambda", "Xi", "Pi", "Sigma", "Upsilon", "Phi", "Psi", "Omega",
];

/// The name in LaTeX, with an accent such as `\dot` over its letter: `\dot{\theta}_{1}`.
pub(super) fn to_latex(name: &str, accent: &str) -> String {
    let (head, subscript) = split_subscript(name);
    let letter = symbol(head, true);
    let letter = if accent.is_empty() { letter } else { format!("{accent}{{{letter}}}") };
    if subscript.is_empty() { letter } else { format!("{letter}_{{{}}}", subscript.join(",")) }
}

/// `theta_B1` is theta with the subscript B, 1.
fn split_subscript(name: &str) -> (&str, Vec<String>) {
    let end = name.char_indices().skip(1).find(|&(_, c)| c == '_' || c.is_ascii_digit());
    let end = end.map_or(name.len(), |(position, _)| position);
    let (head, rest) = name.split_at(end);
    // Show underscores that distinguish names: x_1 is not x1, and x_ is not x.
    let shown = |(position, part): (usize, &str)| match part.chars().next() {
        None => Some("\\_".to_owned()).filter(|_| position > 0),
        Some(c) if position == 1 && c.is_ascii_digit() && rest.starts_with('_') => {
            Some(format!("\\_{}", symbol(part, false)))
        }
        Some(_) => Some(symbol(part, false)),
    };
    let parts = rest.split('_').enumerate().filter_map(shown);
    (head, parts.collect())
}

fn symbol(part: &str, italic: bool) -> String {
    if GREEK.contains(&part) {
        return format!("\\{part}");
    }
    let mut escaped = String::new();
    for c in part.chars() {
        if "#$%&{}_".contains(c) {
            escaped.push('\\');
        }
        escaped.push(c);
    }
    let several = part.chars().count() > 1 && part.chars().any(char::is_alphabetic);
    match (several, italic) {
        (true, true) => format!("\\mathit{{{escaped}}}"),
        (true, false) => format!("\\mathrm{{{escaped}}}"),
        _ => escaped,
    }
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
    fn latex_has_greek_letters_and_subscripts() {
        assert_eq!(to_latex("theta1", "\\dot"), "\\dot{\\theta}_{1}");
        assert_eq!(to_latex("omega_NB", ""), "\\omega_{\\mathrm{NB}}");
        assert_eq!(to_latex("lc12", ""), "\\mathit{lc}_{12}");
        assert_eq!(to_latex("_gravity", ""), "\\mathit{\\_gravity}");
        let shown = ["x", "x1", "x_1", "x_", "x__1"].map(|name| to_latex(name, ""));
        assert_eq!(shown, ["x", "x_{1}", "x_{\\_1}", "x_{\\_}", "x_{\\_,1}"]);
    }

    #[test]
    fn maple_names_mean_nothing_else() {
        let names = ["q1", "in", "I", "I_", "gamma", "D", "a b"].map(to_maple);
        assert_eq!(names, ["q1", "`in`", "I_", "I__", "gamma_", "D_", "`a b`"]);
    }
}
