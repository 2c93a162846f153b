//! Graphs of more levels than a small stack holds calls, through everything that visits them.

use symbody_core::{Assumption, Error, Function, Graph, Id};

/// Each call of a recursion takes 16 bytes at least.
const LEVELS: usize = 2 * STACK / 16;
const STACK: usize = 256 * 1024;

/// The body of a test on a thread whose stack holds no recursion of that depth.
fn on_a_small_stack(body: fn() -> Result<(), Error>) -> Result<(), Error> {
    let builder = std::thread::Builder::new().stack_size(STACK);
    let Ok(thread) = builder.spawn(body) else { panic!("no thread") };
    thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}

/// Sums, products, quotients and functions in turn.
fn tower(g: &mut Graph, levels: usize) -> Result<(Id, Id), Error> {
    let x = g.time_function("x", 0)?;
    let a = g.symbol("a", Assumption::Real);
    let mut node = x;
    for level in 0..levels {
        node = match level % 4 {
            0 => g.mul(node, a)?,
            1 => g.add(node, x),
            2 => g.apply(Function::Cos, &[node])?,
            _ => g.div(a, node)?,
        };
    }
    Ok((node, x))
}

#[test]
fn visits_and_derivatives() -> Result<(), Error> {
    on_a_small_stack(|| {
        let g = &mut Graph::new();
        let (root, x) = tower(g, LEVELS)?;
        assert!(g.post_order(&[root]).len() >= LEVELS);
        let slope = g.diff(root, x)?;
        assert!(g.post_order(&[slope]).len() >= LEVELS);
        let rate = g.time_derivative(root)?;
        assert!(!g.equal(rate, slope));
        Ok(())
    })
}

#[test]
fn substitution_and_derivations() -> Result<(), Error> {
    on_a_small_stack(|| {
        let g = &mut Graph::new();
        let (root, x) = tower(g, LEVELS)?;
        let y = g.symbol("y", Assumption::Real);
        let replaced = g.substitute(&[root], &[(x, y)])?[0];
        let back = g.substitute(&[replaced], &[(y, x)])?[0];
        assert_eq!(back, root);
        g.enter(Box::default());
        let adopted = g.add(root, y);
        g.leave();
        let outside = g.add(root, y);
        assert!(g.equal(adopted, outside));
        Ok(())
    })
}

#[test]
fn tapes_costs_and_linear_forms() -> Result<(), Error> {
    on_a_small_stack(|| {
        let g = &mut Graph::new();
        let (root, x) = tower(g, LEVELS)?;
        let a = g.symbol("a", Assumption::Real);
        let tape = g.tape(&[x, a], &[root])?;
        let cost = g.cost(&[root]);
        assert_eq!(tape.operations().total(), cost.total());
        // u in a sum at every level of a chain of products
        let u = g.symbol("u", Assumption::Real);
        let mut equation = u;
        for _ in 0..LEVELS / 2 {
            let product = g.mul(equation, a)?;
            equation = g.sub(x, product);
        }
        let solution = g.solve(&[equation], &[u])?;
        assert!(!g.equal(solution[0], Id::ZERO));
        Ok(())
    })
}

#[test]
fn printing() -> Result<(), Error> {
    on_a_small_stack(|| {
        let g = &mut Graph::new();
        let (root, _) = tower(g, LEVELS)?;
        for text in [g.to_text(root), g.to_latex(root), g.to_maple(root)] {
            assert!(!text.is_empty());
        }
        Ok(())
    })
}

#[test]
fn rewrites() -> Result<(), Error> {
    on_a_small_stack(|| {
        let g = &mut Graph::new();
        let (root, x) = tower(g, LEVELS)?;
        let rewritten =
            [g.expand(root)?, g.collect(root, &[x])?, g.factor_terms(root)?, g.combine_trig(root)?];
        for id in rewritten {
            assert!(g.equal(id, root));
        }
        // Many rewrites of every node: a tower that would still be too deep for a recursion.
        let (root, _) = tower(g, LEVELS / 5)?;
        let simple = g.simplify(root)?;
        assert!(g.equal(simple, root));
        Ok(())
    })
}
