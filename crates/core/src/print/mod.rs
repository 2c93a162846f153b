//! Printing for readers: plain text that parses back, LaTeX, and Maple's one-dimensional notation.
//!
//! The graph is brought into the reader's form (`reader` makes it, `tree` holds it, `assemble` merges and signs its
//! terms, `order` sorts them) and then written by one of three writers. A large or deep expression is written as named
//! intermediate quantities (`plan`), so that a shared graph never unfolds: `z1 = ...`, `z2 = ...`, and the result in
//! terms of them.
//!
//! Invariant: the text depends on the structure and the names of an expression only, never on the order in which nodes
//! were made.

mod assemble;
mod latex;
mod latex_name;
mod linear;
mod maple;
mod name;
mod namesake;
mod order;
mod plan;
mod reader;
mod text;
mod tree;
mod usage;

use crate::error::quoted;
use crate::graph::{Graph, Id};

use latex_name::Typeset;
pub(crate) use name::compare as compare_names;
use plan::Plan;
use reader::Reader;
use tree::{Factor, Sum};
pub use usage::Usage;

/// A notation to print in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Plain text: `m*x'' + 2*sin(q)**2`; it parses back.
    Text,
    /// LaTeX without the dollar signs.
    Latex,
    /// Maple input, as Maple's `lprint` writes it.
    Maple,
}

/// Printed expressions: named intermediate quantities, if the expressions are large, and the results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Listing {
    /// Name and expression; each uses only names that come before it.
    pub definitions: Vec<(String, String)>,
    /// The text of each expression, in order.
    pub results: Vec<String>,
}

/// The writer of a format; of text and LaTeX with the place of fractions.
enum Notation {
    Text(text::Text),
    Latex(Typeset, Fractions),
    Maple,
}

/// Where the number of a product stands that is a fraction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fractions {
    /// The product has one bar: `3*m*l**2/2`.
    OverAll,
    /// The fraction leads: `3/2*m*l**2`.
    InFront,
}

impl Fractions {
    /// Whether the number leads the product of such factors. Neither `q/2` nor `3*pi/2` nor `a*b/(2*c)` reads better
    /// for it.
    fn lead(
        self,
        (numerator, denominator): (&str, Option<&String>),
        above: &[&Factor],
        below: &[&Factor],
    ) -> bool {
        let is_product = match above {
            [] => false,
            [only] => numerator != "1" && !only.is_constant(),
            _ => true,
        };
        self == Self::InFront && denominator.is_some() && below.is_empty() && is_product
    }

    /// The same in an argument of a function, which has one bar if it is one term: `cos(3*q/2)`.
    fn in_argument(self, argument: &Sum) -> Self {
        if argument.terms.len() == 1 { Self::OverAll } else { self }
    }
}

impl Notation {
    fn new(graph: &Graph, ids: &[Id], plan: &Plan, format: Format, fractions: Fractions) -> Self {
        match format {
            Format::Text => Self::Text(text::Text { fractions }),
            Format::Latex => Self::Latex(Typeset::new(graph, ids, plan), fractions),
            Format::Maple => Self::Maple,
        }
    }

    fn sum(&self, sum: &Sum) -> String {
        match self {
            Self::Text(text) => linear::write(text, sum),
            Self::Latex(names, fractions) => latex::write(names, *fractions, sum),
            Self::Maple => linear::write(&maple::Maple, sum),
        }
    }

    fn name(&self, name: &str) -> String {
        match self {
            Self::Text(_) => name.to_owned(),
            Self::Latex(names, _) => names.name(name, 0).text,
            Self::Maple => name::to_maple(name),
        }
    }
}

impl Format {
    /// The definitions, one per line, and then the result.
    fn join(self, listing: &Listing) -> String {
        let result = listing.results.join("\n");
        if listing.definitions.is_empty() {
            return result;
        }
        let (open, equals, end, close) = match self {
            Self::Text => ("", " = ", "\n", ""),
            Self::Latex => ("\\begin{aligned}\n", " &= ", " \\\\\n", "\n\\end{aligned}"),
            Self::Maple => ("", " := ", ";\n", ""),
        };
        let mut out = String::from(open);
        for (name, value) in &listing.definitions {
            for part in [name, equals, value, end] {
                out.push_str(part);
            }
        }
        if self == Self::Latex {
            out.push('&');
        }
        out + &result + close
    }
}

impl Graph {
    /// Plain text that parses back; a large expression as lines `z1 = ...` and, last, the result.
    #[must_use]
    pub fn to_text(&self, id: Id) -> String {
        self.printed(id, Format::Text)
    }

    /// The plain text as a message quotes it: shortened if it is long.
    #[must_use]
    pub fn to_quotation(&self, id: Id) -> String {
        quoted(&self.to_text(id))
    }

    /// LaTeX without dollar signs; a large expression as an `aligned` list of definitions and the result.
    #[must_use]
    pub fn to_latex(&self, id: Id) -> String {
        self.printed(id, Format::Latex)
    }

    /// Maple input; a large expression as assignments and, last, the result.
    #[must_use]
    pub fn to_maple(&self, id: Id) -> String {
        self.printed(id, Format::Maple)
    }

    fn printed(&self, id: Id, format: Format) -> String {
        format.join(&self.listing(&[id], format))
    }

    /// Several expressions printed together: shared parts are named once.
    #[must_use]
    pub fn listing(&self, ids: &[Id], format: Format) -> Listing {
        self.listed(ids, format, &Usage::default(), Fractions::OverAll)
    }

    /// The terms of equations, printed together: functions of time in the order of the equations, fractions in front.
    #[must_use]
    pub fn listing_of_equations(&self, ids: &[Id], format: Format, usage: &Usage) -> Listing {
        self.listed(ids, format, usage, Fractions::InFront)
    }

    fn listed(&self, ids: &[Id], format: Format, usage: &Usage, fractions: Fractions) -> Listing {
        let plan = Plan::new(self, ids);
        let reader = Reader::new(self, &plan, usage);
        let notation = Notation::new(self, ids, &plan, format, fractions);
        Listing {
            definitions: plan
                .pieces()
                .iter()
                .map(|piece| (notation.name(&piece.name), notation.sum(&reader.piece(piece))))
                .collect(),
            results: ids.iter().map(|&id| notation.sum(&reader.expression(id))).collect(),
        }
    }
}
