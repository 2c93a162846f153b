//! Names in LaTeX as a person typesets them: the table of rules, and the names that the rules would make look alike.
//!
//! | name | typeset as |
//! |---|---|
//! | `m1`, `m_1`, `x__G` | a letter with an index: `m_{1}`, `x_{G}`; underscores only separate |
//! | `l1_x`, `omega_NB` | indices with commas, several letters upright: `l_{1,x}`, `\omega_{\mathrm{NB}}` |
//! | `I__xx`, `Ixx`, `Fx` | axes are italic, and the index of a capital that stands before them: `I_{xx}`, `F_{x}` |
//! | `omega0`, `varphi`, `Omega`, `θ` | Greek letters; capitals that are Latin letters too are upright: `\mathrm{A}` |
//! | `load`, `lc1` | several letters upright: `\mathrm{load}`, `\mathrm{lc}_{1}` |
//! | `theta_dot`, `x_hat`, `r_vec`, `x'` | accents: `\dot{\theta}`, `\hat{x}`, `\vec{r}`, `x^{\prime}` |
//! | `a b`, `x-y`, `1a` | as it is written, if it has other characters than letters, digits and `_`: `\mathtt{x-y}` |
//!
//! Invariant: in one text, different names are typeset differently. Of the names that the rules make equal, such as `m1`
//! and `m_1`, one keeps this form and the others are written as they are: `\mathtt{m\_1}`.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::graph::{Function, Graph, Id, View};

use super::linear::indices;
use super::name;
use super::plan::Plan;
use super::tree::assumption_word;

/// Greek letters: the name, which is that of LaTeX, and the character.
const GREEK: [(&str, &str); 40] = [
    ("alpha", "α"),
    ("beta", "β"),
    ("gamma", "γ"),
    ("delta", "δ"),
    ("epsilon", "ϵ"),
    ("varepsilon", "ε"),
    ("zeta", "ζ"),
    ("eta", "η"),
    ("theta", "θ"),
    ("vartheta", "ϑ"),
    ("iota", "ι"),
    ("kappa", "κ"),
    ("lambda", "λ"),
    ("mu", "μ"),
    ("nu", "ν"),
    ("xi", "ξ"),
    ("pi", "π"),
    ("varpi", "ϖ"),
    ("rho", "ρ"),
    ("varrho", "ϱ"),
    ("sigma", "σ"),
    ("varsigma", "ς"),
    ("tau", "τ"),
    ("upsilon", "υ"),
    ("phi", "ϕ"),
    ("varphi", "φ"),
    ("chi", "χ"),
    ("psi", "ψ"),
    ("omega", "ω"),
    ("Gamma", "Γ"),
    ("Delta", "Δ"),
    ("Theta", "Θ"),
    ("Lambda", "Λ"),
    ("Xi", "Ξ"),
    ("Pi", "Π"),
    ("Sigma", "Σ"),
    ("Upsilon", "Υ"),
    ("Phi", "Φ"),
    ("Psi", "Ψ"),
    ("Omega", "Ω"),
];

/// Greek capitals that look like Latin ones: LaTeX has no names for them.
const LATIN_CAPITALS: [(&str, &str, char); 13] = [
    ("Alpha", "Α", 'A'),
    ("Beta", "Β", 'B'),
    ("Epsilon", "Ε", 'E'),
    ("Zeta", "Ζ", 'Z'),
    ("Eta", "Η", 'H'),
    ("Iota", "Ι", 'I'),
    ("Kappa", "Κ", 'K'),
    ("Mu", "Μ", 'M'),
    ("Nu", "Ν", 'N'),
    ("Omicron", "Ο", 'O'),
    ("Rho", "Ρ", 'P'),
    ("Tau", "Τ", 'T'),
    ("Chi", "Χ", 'X'),
];

/// Other spellings of Greek letters: Python has a use of its own for the word lambda.
const SPELLINGS: [(&str, &str); 2] = [("lamda", "lambda"), ("µ", "mu")];

/// Parts of a name that are accents over its letter.
const ACCENTS: [(&str, &str); 4] =
    [("hat", "\\hat"), ("tilde", "\\tilde"), ("bar", "\\bar"), ("vec", "\\vec")];
/// Parts of a name that are dots over its letter, as many as their place in this list.
const DOT_WORDS: [&str; 3] = ["dot", "ddot", "dddot"];
/// The dots over a letter. Beyond that a derivative is written x^{(4)}.
const DOTS: [&str; 3] = ["\\dot", "\\ddot", "\\dddot"];
const PRIME_WORD: &str = "prime";

/// A typeset name.
pub(super) struct Glyph {
    pub(super) text: String,
    /// Whether it has a superscript, so that its powers need brackets.
    pub(super) has_superscript: bool,
}

/// The names of one text.
pub(super) struct Typeset {
    /// The names that are written as they are.
    literal: FxHashSet<String>,
}

impl Typeset {
    /// Find the names in these expressions, and in the plan of their text, that would look like others.
    pub(super) fn new(graph: &Graph, ids: &[Id], plan: &Plan) -> Self {
        let mut found = Found::default();
        for id in graph.post_order(ids) {
            found.visit(graph, id, plan);
        }
        for piece in plan.pieces() {
            found.add(&piece.name, 0, "");
        }
        Self { literal: found.doubles() }
    }

    /// The name, of a function of time differentiated `order` times.
    pub(super) fn name(&self, name: &str, order: u32) -> Glyph {
        let letters = if self.literal.contains(name) { None } else { Letters::of(name) };
        letters.unwrap_or_else(|| Letters::literal(name)).glyph(order)
    }
}

/// The typeset forms of the names in a text.
#[derive(Default)]
struct Found<'a> {
    /// Form -> the names that have it, each with its rank.
    forms: FxHashMap<String, Vec<(bool, &'a str)>>,
    seen: FxHashSet<(&'a str, u32, &'static str)>,
    reserved: FxHashSet<String>,
}

impl<'a> Found<'a> {
    fn visit(&mut self, graph: &'a Graph, id: Id, plan: &Plan) {
        match graph.view(id) {
            View::Symbol(name, assumption) => {
                let word = if plan.is_explicit(name, assumption) { assumption_word(assumption) } else { "" };
                self.add(name, 0, word);
            }
            View::TimeFunction(name, order, _) => {
                if plan.is_ambiguous(name) {
                    self.reserve("t");
                }
                self.add(name, order, "");
            }
            View::Application { name, orders, .. } => {
                if orders.iter().any(|&order| order > 0) {
                    self.reserve(&format!("D_{{{}}}", indices(orders)));
                }
                self.add(name, 0, "");
            }
            View::Pi => self.reserve("\\pi"),
            View::Time => self.reserve("t"),
            View::Function(Function::Exp, _) => self.reserve("e"),
            View::Function(function, _) => {
                let operator = function_name(function).unwrap_or_default();
                let word = operator.trim_start_matches("\\operatorname{").trim_end_matches('}');
                self.reserve(&format!("\\mathrm{{{}}}", word.trim_start_matches('\\')));
            }
            _ => {}
        }
    }

    fn reserve(&mut self, form: &str) {
        if !self.reserved.contains(form) {
            self.reserved.insert(form.to_owned());
        }
    }

    /// Note a name; `word` is the index that distinguishes symbols of one name.
    fn add(&mut self, name: &'a str, order: u32, word: &'static str) {
        if !self.seen.insert((name, order, word)) {
            return;
        }
        let Some(mut letters) = Letters::of(name) else { return };
        let accented = !letters.accents.is_empty() || letters.dots > 0 || letters.primes > 0;
        if !word.is_empty() && letters.indices.is_empty() {
            letters.indices.push(format!("\\mathrm{{{word}}}"));
        }
        self.forms.entry(letters.glyph(order).text).or_default().push((accented, name));
    }

    /// The names that must be written as they are, because others have the same form. A name without accents keeps
    /// the form, then the shortest one.
    fn doubles(self) -> FxHashSet<String> {
        let mut literal = FxHashSet::default();
        #[expect(clippy::iter_over_hash_type, reason = "the set doesn't depend on the order")]
        for (form, mut names) in self.forms {
            names.sort_by(|(p, a), (q, b)| {
                p.cmp(q).then(a.len().cmp(&b.len())).then_with(|| name::compare(a, b))
            });
            let kept = if self.reserved.contains(&form) { None } else { names.first().copied() };
            let others = names.into_iter().filter(|&(_, name)| kept.is_none_or(|(_, first)| first != name));
            literal.extend(others.map(|(_, name)| name.to_owned()));
        }
        literal
    }
}

/// A name taken apart.
struct Letters {
    letter: String,
    indices: Vec<String>,
    accents: Vec<&'static str>,
    dots: usize,
    primes: usize,
}

impl Letters {
    /// The parts of a name, unless it can only be written as it is.
    fn of(name: &str) -> Option<Self> {
        let word = name.trim_end_matches('\'');
        let mut parts = word.split('_').filter(|part| !part.is_empty());
        let first = parts.next()?;
        let plain = word.chars().all(|c| c.is_alphanumeric() || c == '_');
        if !plain || !first.starts_with(char::is_alphabetic) {
            return None;
        }
        let (head, digits) = first.split_at(first.find(|c: char| c.is_ascii_digit()).unwrap_or(first.len()));
        let mut letters = Self::alone(letter(head).unwrap_or_else(|| upright(head)), name.len() - word.len());
        if let Some((capital, axes)) = axes_of_capital(head) {
            letters.letter = capital.into();
            letters.indices.push(axes.into());
        }
        if !digits.is_empty() {
            letters.indices.push(index(digits));
        }
        for part in parts {
            letters.add(part);
        }
        Some(letters)
    }

    fn alone(letter: String, primes: usize) -> Self {
        Self { letter, indices: Vec::new(), accents: Vec::new(), dots: 0, primes }
    }

    /// The name as it is written.
    fn literal(name: &str) -> Self {
        Self::alone(format!("\\mathtt{{{}}}", name.chars().map(escaped).collect::<String>()), 0)
    }

    /// A part after an underscore: an index, or an accent and perhaps an index.
    fn add(&mut self, part: &str) {
        let word = part.trim_end_matches(|c: char| c.is_ascii_digit());
        if let Some(place) = DOT_WORDS.iter().position(|&dots| dots == word) {
            self.dots += place + 1;
        } else if let Some((_, accent)) = ACCENTS.iter().find(|(name, _)| *name == word) {
            self.accents.push(accent);
        } else if word == PRIME_WORD {
            self.primes += 1;
        } else {
            self.indices.push(index(part));
            return;
        }
        if word.len() < part.len() {
            self.indices.push(part[word.len()..].into());
        }
    }

    fn glyph(&self, order: u32) -> Glyph {
        let mut text = self.letter.clone();
        for accent in &self.accents {
            text = format!("{accent}{{{text}}}");
        }
        let dots = self.dots + order as usize;
        let over = dots.checked_sub(1).map(|place| DOTS.get(place));
        let order = if over == Some(None) { format!("({dots})") } else { String::new() };
        if let Some(Some(accent)) = over {
            text = format!("{accent}{{{text}}}");
        }
        let above = "\\prime".repeat(self.primes) + &order;
        let script = |sign: char, inner: &str| {
            if inner.is_empty() { String::new() } else { format!("{sign}{{{inner}}}") }
        };
        let text = text + &script('_', &self.indices.join(",")) + &script('^', &above);
        Glyph { text, has_superscript: !above.is_empty() }
    }
}

/// A Greek or a single letter.
fn letter(word: &str) -> Option<String> {
    let word = SPELLINGS.iter().find(|(other, _)| *other == word).map_or(word, |(_, name)| *name);
    if let Some((name, _)) = GREEK.iter().find(|(name, letter)| word == *name || word == *letter) {
        return Some(format!("\\{name}"));
    }
    let capital = LATIN_CAPITALS.iter().find(|(name, letter, _)| word == *name || word == *letter);
    if let Some((_, _, latin)) = capital {
        return Some(format!("\\mathrm{{{latin}}}"));
    }
    (word.chars().count() == 1).then(|| word.to_owned())
}

fn upright(word: &str) -> String {
    format!("\\mathrm{{{word}}}")
}

/// The capital and the axes of `Ixx` or `Fx`.
fn axes_of_capital(head: &str) -> Option<(&str, &str)> {
    let axes = head.strip_prefix(|c: char| c.is_ascii_uppercase())?;
    (matches!(axes.len(), 1 | 2) && are_axes(axes)).then(|| head.split_at(1))
}

fn are_axes(word: &str) -> bool {
    word.len() <= 3 && word.bytes().all(|c| matches!(c, b'x'..=b'z'))
}

/// An index: letters and digits in turn.
fn index(part: &str) -> String {
    let mut out = String::new();
    let mut rest = part;
    while let Some(first) = rest.chars().next() {
        let digits = first.is_ascii_digit();
        let (run, after) =
            rest.split_at(rest.find(|c: char| c.is_ascii_digit() != digits).unwrap_or(rest.len()));
        if digits || are_axes(run) {
            out.push_str(run);
        } else {
            out.push_str(&letter(run).unwrap_or_else(|| upright(run)));
        }
        rest = after;
    }
    out
}

/// A character of a name that is written as it is.
fn escaped(c: char) -> String {
    match c {
        '#' | '$' | '%' | '&' | '{' | '}' | '_' => format!("\\{c}"),
        '\\' => "\\backslash ".into(),
        '^' => "\\wedge ".into(),
        '~' => "\\sim ".into(),
        ' ' => "\\ ".into(),
        '\'' => "{\\prime}".into(),
        c if c.is_control() || c.is_whitespace() => format!("\\{{{:x}\\}}", u32::from(c)),
        c => c.into(),
    }
}

/// The name of a function that is written with a name; its powers are written over the name.
pub(super) fn function_name(function: Function) -> Option<String> {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn typeset(name: &str) -> String {
        Typeset { literal: FxHashSet::default() }.name(name, 0).text
    }

    #[test]
    fn names_are_typeset_by_the_table() {
        for (name, expected) in [
            ("x", "x"),
            ("x1", "x_{1}"),
            ("x_1", "x_{1}"),
            ("x_", "x"),
            ("x__G", "x_{G}"),
            ("I__xx", "I_{xx}"),
            ("Ixx", "I_{xx}"),
            ("Fx", "F_{x}"),
            ("Iz2", "I_{z,2}"),
            ("ax", "\\mathrm{ax}"),
            ("l1_x", "l_{1,x}"),
            ("q12", "q_{12}"),
            ("lc12", "\\mathrm{lc}_{12}"),
            ("load", "\\mathrm{load}"),
            ("_gravity", "\\mathrm{gravity}"),
            ("m_load2", "m_{\\mathrm{load}2}"),
            ("omega_NB", "\\omega_{\\mathrm{NB}}"),
            ("theta_B1", "\\theta_{B1}"),
            ("omega0", "\\omega_{0}"),
            ("lambda_", "\\lambda"),
            ("lamda", "\\lambda"),
            ("varphi2", "\\varphi_{2}"),
            ("Omega", "\\Omega"),
            ("Alpha", "\\mathrm{A}"),
            ("k_phi1", "k_{\\phi1}"),
            ("θ1", "\\theta_{1}"),
            ("theta_dot", "\\dot{\\theta}"),
            ("q1_ddot", "\\ddot{q}_{1}"),
            ("theta_dot1", "\\dot{\\theta}_{1}"),
            ("x_hat", "\\hat{x}"),
            ("omega_bar", "\\bar{\\omega}"),
            ("r_vec1", "\\vec{r}_{1}"),
            ("x_prime_1", "x_{1}^{\\prime}"),
            ("x''", "x^{\\prime\\prime}"),
            ("a b", "\\mathtt{a\\ b}"),
            ("x-y", "\\mathtt{x-y}"),
            ("1a", "\\mathtt{1a}"),
            ("__", "\\mathtt{\\_\\_}"),
        ] {
            assert_eq!(typeset(name), expected, "{name}");
        }
    }

    #[test]
    fn dots_of_names_and_of_derivatives_add() {
        let names = Typeset { literal: FxHashSet::default() };
        let texts = [("q1", 1), ("q1_dot", 1), ("q1_dot", 3), ("x_prime", 4)]
            .map(|(name, order)| names.name(name, order).text);
        assert_eq!(texts, ["\\dot{q}_{1}", "\\ddot{q}_{1}", "q_{1}^{(4)}", "x^{\\prime(4)}"]);
    }
}
