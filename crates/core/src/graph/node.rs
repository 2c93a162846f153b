//! The kinds of nodes, and the views that show them.

use crate::value::Number;

use super::function::Function;

/// A node of the graph: an index into its append-only table. Children have smaller ids.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Id(pub u32);

impl Id {
    /// The number 0; it and the number 1 are the first two nodes of every graph.
    pub const ZERO: Self = Self(0);
    /// The number 1.
    pub const ONE: Self = Self(1);
    /// The circle constant, the third node of every graph.
    pub const PI: Self = Self(2);

    pub(crate) const fn index(self) -> usize {
        self.0 as usize
    }
}

/// The number of an exact number in its table: a coefficient or an exponent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct NumberId(pub(crate) u32);

impl NumberId {
    /// The numbers 0, 1 and -1 are the first three of every graph.
    pub(crate) const ZERO: Self = Self(0);
    /// The number 1: the coefficient and exponent of a plain term or factor.
    pub const ONE: Self = Self(1);
    pub(crate) const MINUS_ONE: Self = Self(2);

    /// The number of 0, 1 or -1, which are needed most often and have no need of a search.
    pub(crate) fn of_unit(number: &Number) -> Option<Self> {
        match number.to_i64() {
            Some(0) => Some(Self::ZERO), // there is only one zero, so that `is_zero` recognises it
            Some(1) if !number.is_decimal() => Some(Self::ONE),
            Some(-1) if !number.is_decimal() => Some(Self::MINUS_ONE),
            _ => None,
        }
    }
}

/// What the user asserts about a symbol or a function of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Assumption {
    /// Any complex value.
    None,
    /// A real value (the default).
    Real,
    /// A positive real value: its roots are taken exactly.
    Positive,
    /// A small real value: expansions are in powers of such variables. Derivatives of small functions are small.
    Small,
}

/// The kind of a node as stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Kind {
    Number,
    Pi,
    Time,
    Symbol(Assumption),
    /// Either real or small.
    TimeFunction(Assumption),
    Application,
    Scale,
    Sum,
    Product,
    Function(Function),
    /// Words: the matrix row by row, then the right side. It has no value as a number: only `Solution` may refer to it.
    LinearSystem,
    /// Words: the linear system, the index of the component.
    Solution,
}

/// A node with its parts.
#[derive(Clone, Copy, Debug)]
pub enum View<'a> {
    /// An exact number.
    Number(NumberId),
    /// The circle constant.
    Pi,
    /// The independent variable t.
    Time,
    /// A parameter or unknown.
    Symbol(&'a str, Assumption),
    /// x(t) or its derivative of the given order; real or small.
    TimeFunction(&'a str, u32, Assumption),
    /// An undefined function of arguments, differentiated `orders[i]` times by argument i.
    Application {
        /// The name of the function.
        name: &'a str,
        /// The arguments.
        args: Ids<'a>,
        /// How often the function is differentiated by each argument.
        orders: &'a [u32],
    },
    /// A numeric multiple; the child is neither a number nor a `Scale`.
    Scale(NumberId, Id),
    /// Two or more terms, ordered by value; no two have equal or opposite values.
    Sum(Terms<'a>),
    /// Powers of distinct bases, ordered by value; a single factor has an exponent other than one.
    Product(Factors<'a>),
    /// A function of the table.
    Function(Function, Ids<'a>),
    /// A linear system A x = b: it has no value by itself, and is a part of its solutions.
    LinearSystem {
        /// The entries of A, row by row.
        matrix: Ids<'a>,
        /// The entries of b.
        right: Ids<'a>,
    },
    /// A component of the solution of a linear system.
    Solution(Id, u32),
}

/// Child nodes.
#[derive(Clone, Copy, Debug)]
pub struct Ids<'a>(pub(crate) &'a [u32]);

impl<'a> Ids<'a> {
    /// In stored order.
    pub fn iter(self) -> impl DoubleEndedIterator<Item = Id> + ExactSizeIterator + 'a {
        self.0.iter().map(|&word| Id(word))
    }
    /// How many there are.
    #[must_use]
    pub const fn len(self) -> usize {
        self.0.len()
    }
    /// Whether there is none.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.0.is_empty()
    }
    /// The child at a position.
    #[must_use]
    pub fn get(self, index: usize) -> Id {
        Id(self.0[index])
    }
}

/// The terms of a sum: coefficient and node; a constant term is a multiple of the node 1.
#[derive(Clone, Copy, Debug)]
pub struct Terms<'a>(pub(crate) &'a [u32]);

impl<'a> Terms<'a> {
    /// In stored order.
    pub fn iter(self) -> impl DoubleEndedIterator<Item = (NumberId, Id)> + ExactSizeIterator + 'a {
        self.0.chunks_exact(2).map(|pair| (NumberId(pair[0]), Id(pair[1])))
    }
    /// How many there are.
    #[must_use]
    pub const fn len(self) -> usize {
        self.0.len() / 2
    }
    /// Whether there is none.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.0.is_empty()
    }
}

/// The factors of a product: base and exponent.
#[derive(Clone, Copy, Debug)]
pub struct Factors<'a>(pub(crate) &'a [u32]);

impl<'a> Factors<'a> {
    /// In stored order.
    pub fn iter(self) -> impl DoubleEndedIterator<Item = (Id, NumberId)> + ExactSizeIterator + 'a {
        self.0.chunks_exact(2).map(|pair| (Id(pair[0]), NumberId(pair[1])))
    }
    /// How many there are.
    #[must_use]
    pub const fn len(self) -> usize {
        self.0.len() / 2
    }
    /// Whether there is none.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.0.is_empty()
    }
}

/// Facts about a node and everything below it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Flags(u16);

impl Flags {
    /// No symbol is below: the node is a constant, which lowering folds into one double.
    pub(crate) const CONSTANT: Self = Self(1);
    /// Depends on time: a function of time or t itself is below.
    pub(super) const TIME: Self = Self(2);
    /// A product with a root among its factors (which other products must merge with).
    pub(crate) const ROOT: Self = Self(4);
    /// Contains a symbol that may be complex: |z|^2 is not z^2, log(exp z) is not z.
    pub(crate) const COMPLEX: Self = Self(8);
    /// Contains a sign, a modulus or a root: what is equal to the node is found by all lanes.
    pub(crate) const BRANCH: Self = Self(16);
    /// Contains pi, a logarithm or an inverse function, to which the angles and exponents of sums are split.
    pub(crate) const INVERSE: Self = Self(32);
    /// Contains a small variable.
    pub(crate) const SMALL: Self = Self(64);
    /// Contains a root of odd degree or a power of e, which may make units of any order: lanes may draw roots of these.
    pub(crate) const UNITS: Self = Self(128);

    /// What a node has if one of its children has it.
    const INHERITED: u16 =
        Self::TIME.0 | Self::COMPLEX.0 | Self::BRANCH.0 | Self::INVERSE.0 | Self::SMALL.0 | Self::UNITS.0;

    pub(crate) const fn has(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }
    pub(crate) const fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
    /// The flags of a node from those of two children.
    pub(crate) const fn join(self, other: Self) -> Self {
        let level = if self.level() > other.level() { self.level() } else { other.level() };
        let joined = (self.0 & other.0 & Self::CONSTANT.0) | ((self.0 | other.0) & Self::INHERITED);
        Self(joined).at_level(level)
    }

    /// How often the node changes: 0 parameters, 1 time and positions, 2 speeds, 3 accelerations.
    pub(crate) const fn level(self) -> u8 {
        (self.0 >> LEVEL_SHIFT) as u8
    }

    pub(super) const fn at_level(self, level: u8) -> Self {
        let level = if level > 3 { 3 } else { level };
        Self((self.0 & ((1 << LEVEL_SHIFT) - 1)) | ((level as u16) << LEVEL_SHIFT))
    }
}

/// The level is stored in the two highest bits.
const LEVEL_SHIFT: u32 = 14;
