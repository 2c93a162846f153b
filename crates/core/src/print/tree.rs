//! The reader's form as data: a sum of terms, each a number times powers. Trees are small (see `plan`), so recursion
//! is safe.

use crate::graph::{Assumption, Function};
use crate::value::Number;

use super::usage::Use;

/// Terms with a plus between them; zero is a term that is the number zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Sum {
    pub(super) terms: Vec<Term>,
}

/// A number times powers; the factors are ordered and have different bases.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Term {
    pub(super) coefficient: Number,
    pub(super) factors: Vec<Factor>,
}

/// A power.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Factor {
    pub(super) base: Base,
    pub(super) exponent: Number,
}

/// What may be raised to a power.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Base {
    /// A number under a root.
    Number(Number),
    Pi,
    Time,
    /// A symbol: of one name there may be several, with other assumptions. `explicit` where the name alone would mean
    /// another one of them; `is_subtracted` if it stands behind the minus sign in differences of the model.
    Symbol {
        name: String,
        assumption: Assumption,
        explicit: bool,
        is_subtracted: bool,
    },
    /// A function of time; `explicit` where the name alone would mean something else; `mark` is the assumption that
    /// distinguishes it from another one of its name, or empty.
    TimeFunction {
        name: String,
        order: u32,
        explicit: bool,
        mark: &'static str,
        usage: Use,
    },
    Application {
        name: String,
        args: Vec<Sum>,
        orders: Vec<u32>,
    },
    Function(Function, Vec<Sum>),
    /// A sum in brackets.
    Group(Sum),
}

impl Base {
    /// A name for a quantity, with nothing else of that name beside it.
    pub(super) fn plain(name: &str) -> Self {
        Self::Symbol {
            name: name.to_owned(),
            assumption: Assumption::Real,
            explicit: false,
            is_subtracted: false,
        }
    }
}

/// The word by which the symbols of one name are distinguished; the real one is written by its name alone.
pub(super) fn assumption_word(assumption: Assumption) -> &'static str {
    match assumption {
        Assumption::Positive => "positive",
        Assumption::Real => "real",
        Assumption::None => "complex",
        Assumption::Small => "small",
    }
}

impl Factor {
    /// Whether it is a number, such as a root or pi.
    pub(super) fn is_constant(&self) -> bool {
        matches!(self.base, Base::Number(_) | Base::Pi)
    }
}

impl Sum {
    pub(super) fn number(number: Number) -> Self {
        Self { terms: vec![Term { coefficient: number, factors: Vec::new() }] }
    }

    /// The base, if the sum is one base and nothing else.
    pub(super) fn as_base(&self) -> Option<&Base> {
        match &self.terms[..] {
            [Term { coefficient, factors }] if coefficient.is_one() => match &factors[..] {
                [Factor { base, exponent }] if exponent.is_one() => Some(base),
                _ => None,
            },
            _ => None,
        }
    }

    /// The number, if the sum is one.
    pub(super) fn as_number(&self) -> Option<&Number> {
        match &self.terms[..] {
            [Term { coefficient, factors }] if factors.is_empty() => Some(coefficient),
            _ => None,
        }
    }
}
