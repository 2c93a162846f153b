//! Divisors that several products have: a / d, b / d, ... take one division, 1 / d, and multiplications.

use rustc_hash::{FxHashMap, FxHashSet};
use std::hash::Hash;

use crate::graph::Graph;
use crate::node::{Factors, Id, NumberId, View};

/// So many products are worth the one operation more that a reciprocal takes; a division lasts as long as several.
const WORTH: u32 = 4;

/// The one divisor of a product: a base and its negative exponent; `None` if there are none or several.
pub(crate) fn lone_divisor(graph: &Graph, factors: Factors<'_>) -> Option<(Id, NumberId)> {
    let divides = |&(base, e): &(Id, NumberId)| graph.get_number(e).is_negative() && !graph.is_constant(base);
    let mut divisors = factors.iter().filter(divides);
    divisors.next().filter(|_| divisors.next().is_none())
}

/// The divisors that are the only ones of enough products; a base by what the key makes of it.
pub(crate) fn shared_divisors<K: Copy + Eq + Hash>(
    graph: &Graph,
    nodes: &[Id],
    key: impl Fn(Id) -> K,
) -> FxHashSet<(K, NumberId)> {
    let mut uses: FxHashMap<(K, NumberId), u32> = FxHashMap::default();
    for &node in nodes {
        if let View::Product(factors) = graph.view(node)
            && let Some((base, exponent)) = lone_divisor(graph, factors)
        {
            *uses.entry((key(base), exponent)).or_default() += 1;
        }
    }
    uses.retain(|_, count| *count >= WORTH);
    uses.into_keys().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::node::Assumption;

    #[test]
    fn products_with_one_divisor_share_its_reciprocal() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| g.symbol(name, Assumption::Real));
        let sum = g.add(a, b);
        let quotients = [g.div(a, sum)?, g.div(b, sum)?, g.div(c, sum)?, g.div(d, sum)?];
        let cost = g.cost(&quotients);
        assert_eq!((cost.additions, cost.multiplications, cost.divisions), (1, 4, 1));
        let tape = g.tape(&[a, b, c, d], &quotients)?;
        assert_eq!(tape.instructions.len() as u64, cost.total());
        let few = g.cost(&quotients[..3]);
        assert_eq!((few.additions, few.multiplications, few.divisions), (1, 0, 3));
        Ok(())
    }
}
