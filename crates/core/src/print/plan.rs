//! The nodes that get a name of their own when an expression is too large or too deep to read in one piece.

use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeSet;
use std::ops::Range;

use crate::graph::{Assumption, ByValue, Graph, Id, View};
use crate::interrupt::tick;
use crate::value::Number;

/// Up to this many printed leaves an expression is written out whole.
const WHOLE: usize = 2000;
/// Beyond that, a node of this many leaves gets a name: two or three lines of text.
const PIECE: usize = 40;
/// Beyond that, a node that is used again gets a name from this many leaves on.
const SHARED: usize = 4;
/// Brackets never nest deeper than this.
const DEEPEST: usize = 60;

/// The letters of names, in the order in which they are tried: a name must not look like one of the user's.
const LETTERS: [&str; 8] = ["z", "r", "p", "h", "e", "n", "w", "y"];

/// A named quantity: a node, or a slice of a long sum or product.
pub(super) struct Piece {
    pub(super) name: String,
    pub(super) id: Id,
    pub(super) slice: Option<Range<usize>>,
}

/// The named quantities, each after those that it uses.
pub(super) struct Plan {
    pieces: Vec<Piece>,
    /// Node -> its piece.
    named: FxHashMap<Id, usize>,
    /// Long sum or product -> the pieces of its slices.
    sliced: FxHashMap<Id, Range<usize>>,
    /// Node -> the first node of its value, which is written in its place: one quantity has one name.
    twins: FxHashMap<Id, Id>,
    /// Names of symbols and undefined functions, from which functions of time must be distinguished.
    others: FxHashSet<String>,
    /// Names that several symbols have, with different assumptions.
    shared: FxHashSet<String>,
    /// Names of functions of time of which one is small and another one is not.
    small_too: FxHashSet<String>,
}

/// The printed extent of a node: leaves, and levels of brackets.
#[derive(Clone, Copy)]
struct Extent {
    leaves: usize,
    levels: usize,
}

impl Plan {
    pub(super) fn new(graph: &Graph, roots: &[Id]) -> Self {
        let mut order = graph.post_order(roots);
        let names = Names::of(graph, &order);
        let mut plan = Self {
            pieces: Vec::new(),
            named: FxHashMap::default(),
            sliced: FxHashMap::default(),
            twins: FxHashMap::default(),
            others: names.others,
            shared: names.shared,
            small_too: names.small_too,
        };
        let large = tree_leaves(graph, &order, roots) > WHOLE;
        if large {
            plan.twins = twins(graph, &order);
            order = written_order(graph, roots, &plan.twins);
        }
        let uses = uses(graph, &order, roots, &plan.twins);
        let root_set: FxHashSet<Id> = roots.iter().map(|&root| plan.written(root)).collect();
        let mut extents: FxHashMap<Id, Extent> = FxHashMap::default();
        for &id in &order {
            tick();
            let mut extent = extent(graph, id, |child| extents[&plan.written(child)]);
            if large && extent.leaves > 4 * PIECE {
                extent = plan.slice(graph, id, extent, &extents, &names.prefix);
            }
            let used_again = uses[&id] > 1;
            let inner = !root_set.contains(&id) || used_again;
            let long = large && (extent.leaves >= PIECE || (used_again && extent.leaves >= SHARED));
            if (inner && long || extent.levels >= DEEPEST) && may_be_named(graph, id) {
                plan.named.insert(id, plan.pieces.len());
                plan.push(&names.prefix, id, None);
                extent = Extent { leaves: 1, levels: 0 };
            }
            extents.insert(id, extent);
        }
        plan
    }

    fn push(&mut self, prefix: &str, id: Id, slice: Option<Range<usize>>) {
        let name = format!("{prefix}{}", self.pieces.len() + 1);
        self.pieces.push(Piece { name, id, slice });
    }

    /// Cut a long sum or product into slices, about as many as each is long.
    fn slice(
        &mut self,
        graph: &Graph,
        id: Id,
        extent: Extent,
        extents: &FxHashMap<Id, Extent>,
        prefix: &str,
    ) -> Extent {
        if !matches!(graph.view(id), View::Sum(_) | View::Product(_)) {
            return extent;
        }
        let length = PIECE.max(extent.leaves.isqrt());
        let (first, mut start, mut leaves) = (self.pieces.len(), 0, 0);
        let children = graph.children(id);
        for (position, child) in children.iter().enumerate() {
            leaves += extents[&self.written(*child)].leaves;
            if leaves >= length || position + 1 == children.len() {
                self.push(prefix, id, Some(start..position + 1));
                (start, leaves) = (position + 1, 0);
            }
        }
        let slices = first..self.pieces.len();
        let leaves = slices.len();
        self.sliced.insert(id, slices);
        Extent { leaves, levels: 1 }
    }

    pub(super) fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// The node that is written for a node.
    pub(super) fn written(&self, id: Id) -> Id {
        self.twins.get(&id).copied().unwrap_or(id)
    }

    /// The name of a node, if it has one.
    pub(super) fn name(&self, id: Id) -> Option<&str> {
        self.named.get(&id).map(|&piece| self.pieces[piece].name.as_str())
    }

    /// The slices of a node, if it is cut.
    pub(super) fn slices(&self, id: Id) -> Option<&[Piece]> {
        self.sliced.get(&id).map(|range| &self.pieces[range.clone()])
    }

    /// Whether the node is written in place, as it is.
    pub(super) fn is_open(&self, id: Id) -> bool {
        !self.named.contains_key(&id) && !self.sliced.contains_key(&id) && !self.twins.contains_key(&id)
    }

    /// Whether the name of a function of time is also the name of something else.
    pub(super) fn is_ambiguous(&self, name: &str) -> bool {
        self.others.contains(name)
    }

    /// The word that distinguishes a small function of time from one of its name that is not small; as a rule none.
    pub(super) fn mark(&self, name: &str, assumption: Assumption) -> &'static str {
        if assumption == Assumption::Small && self.small_too.contains(name) { "small" } else { "" }
    }

    /// Whether a symbol is written with its assumption: another symbol has the same name.
    pub(super) fn is_explicit(&self, name: &str, assumption: Assumption) -> bool {
        assumption != Assumption::Real && self.shared.contains(name)
    }
}

fn may_be_named(graph: &Graph, id: Id) -> bool {
    matches!(
        graph.view(id),
        View::Sum(_) | View::Product(_) | View::Function(..) | View::Application { .. } | View::Solution(..)
    )
}

/// The leaves of the unfolded tree, saturating: a shared graph has exponentially many.
fn tree_leaves(graph: &Graph, order: &[Id], roots: &[Id]) -> usize {
    let mut leaves: FxHashMap<Id, usize> = FxHashMap::default();
    let mut children = Vec::new();
    for &id in order {
        tick();
        children.clear();
        graph.push_children(id, &mut children);
        let total = children.iter().fold(0, |sum: usize, child| sum.saturating_add(leaves[child]));
        leaves.insert(id, total.max(1));
    }
    roots.iter().fold(0, |sum: usize, root| sum.saturating_add(leaves[root]))
}

/// Node -> the node of its value with the smallest tree, if that is another one.
fn twins(graph: &Graph, order: &[Id]) -> FxHashMap<Id, Id> {
    let sizes = tree_sizes(graph, order);
    let is_candidate = |id: &&Id| may_be_named(graph, **id) && sizes[*id] < usize::MAX;
    let mut candidates: Vec<Id> = order.iter().filter(is_candidate).copied().collect();
    candidates.sort_by_key(|id| sizes[id]); // what is written in a tree is smaller than the tree: no circles
    let mut known: ByValue<Id> = ByValue::default();
    let mut twins = FxHashMap::default();
    for id in candidates {
        tick();
        match graph.find(&known, id) {
            Some(&smallest) => {
                twins.insert(id, smallest);
            }
            None => known.push(graph.value(id), id, id),
        }
    }
    twins
}

/// The nodes of the unfolded trees, saturating.
fn tree_sizes(graph: &Graph, order: &[Id]) -> FxHashMap<Id, usize> {
    let mut sizes: FxHashMap<Id, usize> = FxHashMap::default();
    for &id in order {
        let size = graph.children(id).iter().fold(1, |sum: usize, child| sum.saturating_add(sizes[child]));
        sizes.insert(id, size);
    }
    sizes
}

/// The nodes that are written, each after its children.
fn written_order(graph: &Graph, roots: &[Id], twins: &FxHashMap<Id, Id>) -> Vec<Id> {
    let written = |id: Id| twins.get(&id).copied().unwrap_or(id);
    let mut order = Vec::new();
    let mut seen: FxHashSet<Id> = FxHashSet::default();
    let mut stack: Vec<(Id, bool)> = roots.iter().rev().map(|&root| (written(root), false)).collect();
    while let Some((id, is_left)) = stack.pop() {
        tick();
        if is_left {
            order.push(id);
        } else if seen.insert(id) {
            stack.push((id, true));
            stack.extend(graph.children(id).iter().rev().map(|&child| (written(child), false)));
        }
    }
    order
}

/// How often each node is written; a multiple counts for the node under it.
fn uses(graph: &Graph, order: &[Id], roots: &[Id], twins: &FxHashMap<Id, Id>) -> FxHashMap<Id, usize> {
    let written = |id: Id| twins.get(&id).copied().unwrap_or(id);
    let mut uses: FxHashMap<Id, usize> = FxHashMap::default();
    for &root in roots {
        *uses.entry(written(root)).or_default() += 1;
    }
    let mut children = Vec::new();
    for &id in order.iter().rev() {
        tick();
        let times = match graph.view(id) {
            View::Scale(..) | View::LinearSystem { .. } => uses[&id],
            _ => 1,
        };
        children.clear();
        graph.push_children(id, &mut children);
        for &child in &children {
            *uses.entry(written(child)).or_default() += times;
        }
    }
    uses
}

fn extent(graph: &Graph, id: Id, of_child: impl Fn(Id) -> Extent) -> Extent {
    let mut total = Extent { leaves: 0, levels: 0 };
    let mut add = |child: Id, merges: bool| {
        let inner = of_child(child);
        total.leaves += inner.leaves;
        total.levels = total.levels.max(inner.levels + usize::from(!merges));
    };
    match graph.view(id) {
        View::Sum(terms) => {
            for (factor, node) in terms.iter() {
                let merges = matches!(graph.view(node), View::Sum(_)) && is_sign(graph.get_number(factor));
                add(node, merges);
            }
        }
        View::Product(factors) => {
            for (base, exponent) in factors.iter() {
                let merges =
                    matches!(graph.view(base), View::Product(_)) && graph.get_number(exponent).is_integer();
                add(base, merges);
            }
        }
        _ => {
            for child in graph.children(id) {
                add(child, false);
            }
        }
    }
    total.leaves = total.leaves.max(1);
    total
}

pub(super) fn is_sign(number: &Number) -> bool {
    number.is_one() || number.is_minus_one()
}

/// The names in use and one that is free.
struct Names {
    others: FxHashSet<String>,
    shared: FxHashSet<String>,
    /// Names of functions of time of which one is small and another one is not.
    small_too: FxHashSet<String>,
    /// A letter that no name in use is, alone or with an index.
    prefix: String,
}

impl Names {
    fn of(graph: &Graph, order: &[Id]) -> Self {
        let mut others = FxHashSet::default();
        let mut assumptions: FxHashMap<&str, Assumption> = FxHashMap::default();
        let mut shared = FxHashSet::default();
        let mut sizes: FxHashMap<&str, Assumption> = FxHashMap::default();
        let mut small_too = FxHashSet::default();
        let mut taken = BTreeSet::new();
        for &id in order {
            tick();
            if let View::Symbol(name, assumption) = graph.view(id)
                && *assumptions.entry(name).or_insert(assumption) != assumption
            {
                shared.insert(name.to_owned());
            }
            match graph.view(id) {
                View::Symbol(name, _) | View::Application { name, .. } => {
                    others.insert(name.to_owned());
                    taken.insert(name);
                }
                View::TimeFunction(name, _, size) => {
                    if *sizes.entry(name).or_insert(size) != size {
                        small_too.insert(name.to_owned());
                    }
                    taken.insert(name);
                }
                _ => {}
            }
        }
        let prefix = free_prefix(|prefix| taken.iter().any(|name| is_or_has_index(name, prefix)));
        Self { others, shared, small_too, prefix }
    }
}

/// The first letter that is not taken; two of them or more if all are.
fn free_prefix(is_taken: impl Fn(&str) -> bool) -> String {
    let free =
        |count: usize| LETTERS.map(|letter| letter.repeat(count)).into_iter().find(|name| !is_taken(name));
    (1..).find_map(free).unwrap_or_default()
}

/// Whether a name is a letter, alone or with an index: `z`, `z1`, `z_a`, but not `zeta`.
fn is_or_has_index(name: &str, letter: &str) -> bool {
    name.strip_prefix(letter)
        .is_some_and(|rest| rest.starts_with('_') || rest.bytes().all(|byte| byte.is_ascii_digit()))
}
