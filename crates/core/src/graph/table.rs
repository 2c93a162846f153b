//! The append-only, hash-consed graph: one table of nodes, one fingerprint each.

use hashbrown::HashTable;
use rustc_hash::{FxHashMap, FxHasher};
use std::hash::{Hash, Hasher};

use crate::error::Error;
use crate::interrupt::tick;
use crate::value::{Element, Number};
use std::cell::RefCell;

use super::classes::Classes;
use super::function::Function;
use super::lanes::{Lanes, draw_pi, draw_symbol, draw_time, draw_time_function, drawn};
use super::node::{Assumption, Factors, Flags, Id, Ids, Kind, NumberId, Terms, View};
use super::representatives::Representatives;
use super::simplest_form::{Part, SimplestForm};

/// One row of the table.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// Where the node's words start in `words`.
    start: u32,
    len: u32,
    flags: Flags,
    kind: Kind,
}

// A shorter `len` would save nothing, because the row is padded to 12 bytes.
const _: () = assert!(size_of::<Row>() == 12);

/// The most words of a sum or a product (longer ones are nested), and the most arguments of a function.
pub(crate) const LONGEST: usize = 60_000;

/// The most derivatives of one function: each of them is made and printed on its own.
pub const LARGEST_ORDER: u32 = 1000;

/// The error for more than [`LARGEST_ORDER`] derivatives.
pub(crate) fn check_order(order: u64) -> Result<(), Error> {
    if order <= u64::from(LARGEST_ORDER) {
        return Ok(());
    }
    let found = usize::try_from(order).unwrap_or(usize::MAX); // a message on a machine of 32 bits
    Err(Error::Limit { what: "derivatives of one function", limit: LARGEST_ORDER as usize, found })
}

/// A place in a table, or the length of one, in 32 bits: of expressions, and of the code and the parts made from them.
///
/// # Panics
/// If the table is full, before anything is changed: an id that stood for two entries would make `==` wrong. Four
/// billion rows take 200 GB. Every operation makes rows, so every operation would have to return this error.
pub(crate) fn word(length: usize) -> u32 {
    u32::try_from(length).expect("the table is full: its places have 32 bits")
}

/// All expressions of a process.
///
/// Invariants: rows are never changed or removed; equal rows are one row; children precede parents;
/// `values[i]` is the fingerprint of row i; nothing depends on ids but identity.
#[derive(Default)]
pub struct Graph {
    rows: Vec<Row>,
    values: Vec<Element>,
    words: Vec<u32>,
    index: HashTable<u32>,
    numbers: Vec<Number>,
    number_values: Vec<Element>,
    number_index: FxHashMap<Number, u32>,
    names: Vec<Box<str>>,
    name_index: FxHashMap<Box<str>, u32>,
    /// The kinds of variables that have each name, one bit per kind.
    name_kinds: Vec<u8>,
    /// Values that are recognised when they are made: small integers and simple fractions, unsigned.
    pub(crate) plain_values: FxHashMap<Element, NumberId>,
    /// Values in the fields of all lanes, as far as they were asked for; a cache, derived from the graph alone.
    pub(crate) lanes: RefCell<Lanes>,
    /// Whether there are numbers that their fingerprints do not show.
    pub(crate) has_large_numbers: bool,
    /// Which nodes stand for others where functions are evaluated.
    pub(crate) representatives: RefCell<Representatives>,
    /// Values of solutions of linear systems; a cache, derived from the graph alone.
    pub(crate) solutions: FxHashMap<Id, Vec<Element>>,
    /// The simplest forms of parts; a cache, which saves time and no counted work.
    pub(crate) simplest_forms: FxHashMap<Part, SimplestForm>,
    /// The classes of the derivation in progress, if there is one.
    pub(crate) classes: Option<Box<Classes>>,
}

impl Graph {
    /// A graph that holds the numbers 0 and 1, and pi.
    #[must_use]
    pub fn new() -> Self {
        let mut graph = Self::default();
        for (value, id) in [(0, NumberId::ZERO), (1, NumberId::ONE), (-1, NumberId::MINUS_ONE)] {
            let interned = graph.intern_number(&Number::integer(value));
            debug_assert_eq!(interned, id);
        }
        graph.number(&Number::integer(0));
        graph.number(&Number::integer(1));
        graph.pi();
        for den in [1, 2, 3, 4, 6, 8, 12, 16] {
            for num in 1..=24 {
                let id = graph.number_id(&Number::rational(num, den));
                let (value, negated) = graph.number_value(id).unsigned();
                let id = if negated { graph.number_id(&Number::rational(-num, den)) } else { id };
                graph.plain_values.entry(value).or_insert(id);
            }
        }
        graph
    }

    /// The number of nodes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there is no node. A graph made by [`Self::new`] always has some.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The fingerprint of a node: a linear image of its exact values in the two hash lanes.
    ///
    /// Nodes without signs and roots that have one fingerprint are equal; for others see [`Self::equal`].
    #[must_use]
    pub fn value(&self, id: Id) -> Element {
        self.values[id.index()]
    }

    /// A node and its parts.
    #[must_use]
    pub fn view(&self, id: Id) -> View<'_> {
        let words = self.words_of(id);
        match self.kind(id) {
            Kind::Number => View::Number(NumberId(words[0])),
            Kind::Pi => View::Pi,
            Kind::Time => View::Time,
            Kind::Symbol(assumption) => View::Symbol(self.name(words[0]), assumption),
            Kind::TimeFunction(assumption) => View::TimeFunction(self.name(words[0]), words[1], assumption),
            Kind::Application => {
                let (args, orders) = words[1..].split_at((words.len() - 1) / 2);
                View::Application { name: self.name(words[0]), args: Ids(args), orders }
            }
            Kind::Scale => View::Scale(NumberId(words[0]), Id(words[1])),
            Kind::Sum => View::Sum(Terms(words)),
            Kind::Product => View::Product(Factors(words)),
            Kind::Function(function) => View::Function(function, Ids(words)),
            Kind::LinearSystem => {
                let n = words.len().isqrt();
                let (matrix, right) = words.split_at(n * n);
                View::LinearSystem { matrix: Ids(matrix), right: Ids(right) }
            }
            Kind::Solution => View::Solution(Id(words[0]), words[1]),
        }
    }

    pub(crate) fn kind(&self, id: Id) -> Kind {
        self.rows[id.index()].kind
    }

    pub(crate) fn flags(&self, id: Id) -> Flags {
        self.rows[id.index()].flags
    }

    fn words_of(&self, id: Id) -> &[u32] {
        let row = self.rows[id.index()];
        &self.words[row.start as usize..row.start as usize + row.len as usize]
    }

    fn name(&self, id: u32) -> &str {
        &self.names[id as usize]
    }

    /// The child nodes, in their stored order.
    #[must_use]
    pub fn children(&self, id: Id) -> Vec<Id> {
        let mut out = Vec::new();
        self.push_children(id, &mut out);
        out
    }

    /// Append the child nodes to `out`.
    pub fn push_children(&self, id: Id, out: &mut Vec<Id>) {
        match self.view(id) {
            View::Application { args, .. } | View::Function(_, args) => out.extend(args.iter()),
            View::Scale(_, child) | View::Solution(child, _) => out.push(child),
            View::LinearSystem { matrix, right } => out.extend(matrix.iter().chain(right.iter())),
            View::Sum(terms) => out.extend(terms.iter().map(|(_, node)| node)),
            View::Product(factors) => out.extend(factors.iter().map(|(node, _)| node)),
            View::Number(_) | View::Pi | View::Time | View::Symbol(..) | View::TimeFunction(..) => {}
        }
    }

    /// Whether a node is a variable: a symbol, t, a function of time, or an undefined function.
    #[must_use]
    pub fn is_variable(&self, id: Id) -> bool {
        matches!(self.kind(id), Kind::Time | Kind::Symbol(_) | Kind::TimeFunction(_) | Kind::Application)
    }

    /// Whether no symbol is below the node.
    #[must_use]
    pub fn is_constant(&self, id: Id) -> bool {
        self.flags(id).has(Flags::CONSTANT)
    }

    /// Whether the node depends on time.
    #[must_use]
    pub fn depends_on_time(&self, id: Id) -> bool {
        self.flags(id).has(Flags::TIME)
    }

    /// The number that a node is, if it is one.
    #[must_use]
    pub fn as_number(&self, id: Id) -> Option<&Number> {
        match self.view(id) {
            View::Number(number) => Some(self.get_number(number)),
            _ => None,
        }
    }

    /// An interned number.
    #[must_use]
    pub fn get_number(&self, id: NumberId) -> &Number {
        &self.numbers[id.0 as usize]
    }

    pub(crate) fn number_value(&self, id: NumberId) -> Element {
        self.number_values[id.0 as usize]
    }

    pub(crate) fn number_id(&mut self, number: &Number) -> NumberId {
        if let Some(id) = NumberId::of_unit(number) {
            return id;
        }
        self.intern_number(number)
    }

    fn intern_number(&mut self, number: &Number) -> NumberId {
        if let Some(&id) = self.number_index.get(number) {
            return NumberId(id);
        }
        let id = word(self.numbers.len());
        let mut value = Element::from_number(number);
        if value.is_singular() && !number.is_zero() {
            // A multiple of one of the primes: its image could not be distinguished from zero, so draw one.
            value = drawn(|field| field.field().number(number));
        }
        self.has_large_numbers |= value.to_simple_rational().is_none();
        self.numbers.push(number.clone());
        self.number_values.push(value);
        self.number_index.insert(number.clone(), id);
        NumberId(id)
    }

    pub(crate) fn name_id(&mut self, name: &str) -> u32 {
        if let Some(&id) = self.name_index.get(name) {
            return id;
        }
        let id = word(self.names.len());
        self.names.push(name.into());
        self.name_kinds.push(0);
        self.name_index.insert(name.into(), id);
        id
    }

    /// Whether variables of several kinds have this name: symbols with different assumptions, functions of time.
    pub(crate) fn has_namesakes(&self, name: &str) -> bool {
        let id = self.name_index.get(name);
        id.is_some_and(|&id| self.name_kinds[id as usize].count_ones() > 1)
    }

    /// The node of a number.
    pub fn number(&mut self, number: &Number) -> Id {
        let id = self.number_id(number);
        self.number_node(id)
    }

    pub(crate) fn number_node(&mut self, id: NumberId) -> Id {
        let node = self.intern(Kind::Number, Flags::CONSTANT, &[id.0], self.number_value(id));
        if self.has_large_numbers && self.value(node).to_simple_rational().is_none() {
            self.representative(node);
        }
        if node != Id::ZERO {
            self.remember(node);
        }
        node
    }

    /// The node of an integer.
    pub fn integer(&mut self, value: i64) -> Id {
        self.number(&Number::integer(value))
    }

    /// The circle constant.
    pub fn pi(&mut self) -> Id {
        self.intern(Kind::Pi, Flags::CONSTANT.with(Flags::INVERSE), &[], drawn(draw_pi))
    }

    /// The independent variable t.
    pub fn time(&mut self) -> Id {
        self.intern(Kind::Time, Flags::TIME.at_level(1), &[], drawn(draw_time))
    }

    /// A symbol. Symbols with one name and different assumptions are different symbols.
    pub fn symbol(&mut self, name: &str, assumption: Assumption) -> Id {
        let name_id = self.name_id(name);
        let kind = Kind::Symbol(assumption);
        if let Some(known) = self.row(kind, &[name_id]) {
            return known;
        }
        let value = drawn(|field| draw_symbol(field, name, assumption));
        let flags = match assumption {
            Assumption::None => Flags::COMPLEX,
            Assumption::Small => Flags::SMALL,
            Assumption::Real | Assumption::Positive => Flags::default(),
        };
        self.name_kinds[name_id as usize] |= 4 << assumption as u8;
        self.intern(kind, flags, &[name_id], value)
    }

    /// The function of time `name`, differentiated `order` times.
    ///
    /// # Errors
    /// When `order` is larger than [`LARGEST_ORDER`].
    pub fn time_function(&mut self, name: &str, order: u32) -> Result<Id, Error> {
        self.derivative_of_function(name, order, Assumption::Real)
    }

    /// The small function of time `name`, differentiated `order` times; it differs from the one that is not small.
    ///
    /// # Errors
    /// When `order` is larger than [`LARGEST_ORDER`].
    pub fn small_time_function(&mut self, name: &str, order: u32) -> Result<Id, Error> {
        self.derivative_of_function(name, order, Assumption::Small)
    }

    /// A derivative of a function of time under either assumption.
    pub(crate) fn derivative_of_function(
        &mut self,
        name: &str,
        order: u32,
        assumption: Assumption,
    ) -> Result<Id, Error> {
        check_order(order.into())?;
        let (name_id, kind) = (self.name_id(name), Kind::TimeFunction(assumption));
        if let Some(known) = self.row(kind, &[name_id, order]) {
            return Ok(known);
        }
        let value = drawn(|field| draw_time_function(field, name, order, assumption));
        let is_small = assumption == Assumption::Small;
        self.name_kinds[name_id as usize] |= if is_small { 2 } else { 1 };
        let flags = if is_small { Flags::TIME.with(Flags::SMALL) } else { Flags::TIME };
        // Level 3 is the highest one.
        let level = order.min(2) as u8 + 1;
        Ok(self.intern(kind, flags.at_level(level), &[name_id, order], value))
    }

    /// The node of this row, if there is one.
    pub(crate) fn row(&self, kind: Kind, words: &[u32]) -> Option<Id> {
        self.find_row(hash_row(kind, words), kind, words)
    }

    fn find_row(&self, hash: u64, kind: Kind, words: &[u32]) -> Option<Id> {
        let same = |&id: &u32| self.kind(Id(id)) == kind && self.words_of(Id(id)) == words;
        self.index.find(hash, same).copied().map(Id)
    }

    /// The node of a function of one argument, if there is one.
    pub(crate) fn known_function(&self, function: Function, argument: Id) -> Option<Id> {
        let (kind, words) = (Kind::Function(function), [argument.0]);
        self.find_row(hash_row(kind, &words), kind, &words)
    }

    /// The node of this row, made if it is new.
    pub(crate) fn intern(&mut self, kind: Kind, flags: Flags, words: &[u32], value: Element) -> Id {
        tick(); // before the first change
        let hash = hash_row(kind, words);
        if let Some(id) = self.find_row(hash, kind, words) {
            return id;
        }
        let (id, start) = (word(self.rows.len()), word(self.words.len()));
        // Every word has a number of 32 bits, so `start` and `len` of this row and of the next one fit.
        word(self.words.len() + words.len());
        self.words.extend_from_slice(words);
        self.rows.push(Row { start, len: word(words.len()), flags, kind });
        self.values.push(value);
        let (rows, table) = (&self.rows, &self.words);
        self.index.insert_unique(hash, id, |&id| {
            let row = rows[id as usize];
            hash_row(row.kind, &table[row.start as usize..row.start as usize + row.len as usize])
        });
        Id(id)
    }

    /// Begin a derivation with the given classes (fresh ones for a new derivation).
    pub fn enter(&mut self, classes: Box<Classes>) {
        self.classes = Some(classes);
    }

    /// End or suspend the derivation and hand its classes back.
    pub fn leave(&mut self) -> Option<Box<Classes>> {
        self.classes.take()
    }

    /// Enter a node made by the derivation in progress, if there is one, into its classes.
    pub(crate) fn remember(&mut self, id: Id) {
        let Some(classes) = self.classes.as_ref() else { return };
        let is_new = self.find_up_to_sign(classes.nodes(), id).is_none();
        let value = self.value(id);
        if let Some(classes) = self.classes.as_mut() {
            classes.remember(id, value, is_new);
        }
    }

    /// Do the same for a node whose fingerprint the derivation has not met.
    pub(crate) fn remember_new(&mut self, id: Id, value: Element) {
        if let Some(classes) = self.classes.as_mut() {
            classes.remember(id, value, true);
        }
    }

    /// Bytes held by the table, for the memory budget.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.rows.capacity() * size_of::<Row>()
            + self.values.capacity() * size_of::<Element>()
            + self.words.capacity() * size_of::<u32>()
            + self.index.capacity() * 8 * (size_of::<u32>() + 1) / 7
            + self.representatives.borrow().bytes()
    }
}

fn hash_row(kind: Kind, words: &[u32]) -> u64 {
    let mut hasher = FxHasher::default();
    kind.hash(&mut hasher);
    words.hash(&mut hasher);
    hasher.finish()
}
