//! Block triangular form: the smallest coupled systems inside a sparse system, in the order of their solution.
//!
//! Every equation is matched with one of its unknowns. The blocks are the strongly connected components of the relation
//! "needs the unknown of" [Duff & Reid 1978; components: Tarjan 1972].

use std::collections::VecDeque;

/// Equations and unknowns that are solved together.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Block {
    pub equations: Vec<usize>,
    pub unknowns: Vec<usize>,
}

/// The blocks of a square pattern (the unknowns of each equation), each after the blocks that it needs.
///
/// Equations without a partner are left out: a pattern of full structural rank has none.
pub(super) fn blocks(pattern: &[Vec<usize>], unknowns: usize) -> Vec<Block> {
    let owner = matching(pattern, unknowns);
    let mut unknown_of = vec![None; pattern.len()];
    for (unknown, equation) in owner.iter().enumerate() {
        if let Some(equation) = equation {
            unknown_of[*equation] = Some(unknown);
        }
    }
    let needs: Vec<Vec<usize>> =
        pattern.iter().map(|row| row.iter().filter_map(|&unknown| owner[unknown]).collect()).collect();
    let mut blocks = Vec::new();
    for mut equations in components(&needs) {
        equations.sort_unstable();
        let unknowns: Option<Vec<usize>> = equations.iter().map(|&equation| unknown_of[equation]).collect();
        if let Some(mut unknowns) = unknowns {
            unknowns.sort_unstable();
            blocks.push(Block { equations, unknowns });
        }
    }
    blocks
}

/// The equation matched with each unknown, as many as possible.
fn matching(pattern: &[Vec<usize>], unknowns: usize) -> Vec<Option<usize>> {
    let mut owner: Vec<Option<usize>> = vec![None; unknowns];
    for equation in 0..pattern.len() {
        augment(pattern, &mut owner, equation);
    }
    owner
}

/// Match another equation, along a shortest path that exchanges unknowns.
fn augment(pattern: &[Vec<usize>], owner: &mut [Option<usize>], equation: usize) {
    // The equation from which each unknown was reached.
    let mut reached: Vec<Option<usize>> = vec![None; owner.len()];
    let mut queue = VecDeque::from([equation]);
    while let Some(from) = queue.pop_front() {
        for &unknown in &pattern[from] {
            if reached[unknown].is_some() {
                continue;
            }
            reached[unknown] = Some(from);
            match owner[unknown] {
                Some(next) => queue.push_back(next),
                None => return exchange(owner, &reached, unknown),
            }
        }
    }
}

fn exchange(owner: &mut [Option<usize>], reached: &[Option<usize>], free: usize) {
    let mut next = Some(free);
    while let Some(unknown) = next {
        let equation = reached[unknown];
        // The unknown that this equation had before, to be taken by the one that reached it.
        next = owner.iter().position(|&known| known == equation);
        owner[unknown] = equation;
    }
}

/// The strongly connected components, each after those to which it points.
fn components(edges: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let mut search =
        Search { index: vec![None; edges.len()], low: vec![0; edges.len()], ..Search::default() };
    for root in 0..edges.len() {
        if search.index[root].is_none() {
            search.from(root, edges);
        }
    }
    search.components
}

/// Tarjan's depth-first search, with its own stack.
#[derive(Default)]
struct Search {
    /// The order of the first visits.
    index: Vec<Option<usize>>,
    /// The earliest visited node that a node leads back to; no index once its component is complete.
    low: Vec<usize>,
    visited: usize,
    open: Vec<usize>,
    components: Vec<Vec<usize>>,
}

impl Search {
    fn from(&mut self, root: usize, edges: &[Vec<usize>]) {
        let mut path: Vec<(usize, usize)> = vec![(root, 0)];
        self.enter(root);
        while let Some((node, next)) = path.pop() {
            if let Some(&target) = edges[node].get(next) {
                path.push((node, next + 1));
                match self.index[target] {
                    None => {
                        self.enter(target);
                        path.push((target, 0));
                    }
                    Some(index) if self.low[target] != usize::MAX => {
                        self.low[node] = self.low[node].min(index);
                    }
                    Some(_) => {}
                }
                continue;
            }
            let low = self.low[node];
            self.close(node);
            if let Some(&(parent, _)) = path.last() {
                self.low[parent] = self.low[parent].min(low);
            }
        }
    }

    fn enter(&mut self, node: usize) {
        self.index[node] = Some(self.visited);
        self.low[node] = self.visited;
        self.visited += 1;
        self.open.push(node);
    }

    /// If the node leads to no earlier one, it and what is open after it are a component.
    fn close(&mut self, node: usize) {
        if self.index[node] != Some(self.low[node]) {
            return;
        }
        let start = self.open.iter().rposition(|&open| open == node);
        let start = start.expect("a node is open until its component is closed");
        let component = self.open.split_off(start);
        for &member in &component {
            self.low[member] = usize::MAX;
        }
        self.components.push(component);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(equations: &[usize], unknowns: &[usize]) -> Block {
        Block { equations: equations.to_vec(), unknowns: unknowns.to_vec() }
    }

    #[test]
    fn a_triangular_system_has_blocks_of_one() {
        let pattern = [vec![0, 1, 2], vec![1, 2], vec![2]];
        let expected = [block(&[2], &[2]), block(&[1], &[1]), block(&[0], &[0])];
        assert_eq!(blocks(&pattern, 3), expected);
    }

    #[test]
    fn coupled_pairs_come_in_the_order_of_solving() {
        // 0 and 2 share x0, x3; 1 and 3 share x1, x2 and need x0.
        let pattern = [vec![0, 3], vec![0, 1, 2], vec![0, 3], vec![1, 2]];
        assert_eq!(blocks(&pattern, 4), [block(&[0, 2], &[0, 3]), block(&[1, 3], &[1, 2])]);
    }

    #[test]
    fn matches_are_exchanged_where_needed() {
        let pattern = [vec![0, 1], vec![0], vec![1, 2], vec![2, 3]];
        let found = blocks(&pattern, 4);
        assert_eq!(found.len(), 4);
        assert_eq!(found[0], block(&[1], &[0]));
        assert_eq!(found[3], block(&[3], &[3]));
    }

    #[test]
    fn a_cycle_is_one_block() {
        let pattern: Vec<Vec<usize>> = (0..50).map(|i| vec![i, (i + 1) % 50]).collect();
        let all: Vec<usize> = (0..50).collect();
        assert_eq!(blocks(&pattern, 50), [block(&all, &all)]);
    }
}
