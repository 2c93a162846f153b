//! Graphs a hundred thousand levels deep, through everything that visits them, on a small stack.

use symbody_core::{Assumption, Error, Function, Graph, Id};

const LEVELS: usize = 100_000;

/// The body of a test on a thread whose stack holds no recursion of that depth.
fn on_a_small_stack(body: fn() -> Result<(), Error>) -> Result<(), Error> {
    let builder = std::thread::Builder::new().stack_size(256 * 1024);
    let Ok(thread) = builder.spawn(body) else { panic!("no thread") };
    thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}

/// Sums, products, quotients and functions in turn.
fn tower(g: &mut Graph) -> Result<(Id, Id), Error> {
    let x = g.time_function("x", 0);
    let a = g.symbol("a", Assumption::Real);
    let mut node = x;
    for level in 0..LEVELS {
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
        let (root, x) = tower(g)?;
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
        let (root, x) = tower(g)?;
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
        let (root, x) = tower(g)?;
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
