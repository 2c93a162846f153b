//! Laws of linear solving: solutions satisfy their equations, and what cannot be solved is named.

use symbody_core::{Assumption, Element, Error, Evaluator, Function, Graph, Id, Matrix};

fn symbol(g: &mut Graph, name: &str) -> Id {
    g.symbol(name, Assumption::Real)
}

fn symbols<const N: usize>(g: &mut Graph, names: [&str; N]) -> [Id; N] {
    names.map(|name| symbol(g, name))
}

fn number(g: &mut Graph, value: i64) -> Id {
    g.integer(value)
}

/// The sum of products, less the right-hand side.
fn equation(g: &mut Graph, terms: &[(Id, Id)], right: Id) -> Result<Id, Error> {
    let mut sum = g.neg(right);
    for &(a, b) in terms {
        let product = g.mul(a, b)?;
        sum = g.add(sum, product);
    }
    Ok(sum)
}

/// Whether the solution makes every equation zero, as mathematics.
fn satisfies(g: &mut Graph, equations: &[Id], unknowns: &[Id], solution: &[Id]) -> Result<bool, Error> {
    let pairs: Vec<(Id, Id)> = unknowns.iter().copied().zip(solution.iter().copied()).collect();
    let residuals = g.substitute(equations, &pairs)?;
    Ok(residuals.iter().all(|&id| g.value(id) == Element::ZERO))
}

fn message(result: Result<Vec<Id>, Error>) -> String {
    match result {
        Ok(solution) => panic!("solved: {solution:?}"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn dense_systems_up_to_six_unknowns() -> Result<(), Error> {
    for n in 1..=6 {
        let g = &mut Graph::new();
        let unknowns: Vec<Id> = (0..n).map(|i| symbol(g, &format!("x{i}"))).collect();
        let mut equations = Vec::new();
        for i in 0..n {
            let row: Vec<(Id, Id)> = (0..n).map(|j| (symbol(g, &format!("a{i}{j}")), unknowns[j])).collect();
            let right = symbol(g, &format!("b{i}"));
            equations.push(equation(g, &row, right)?);
        }
        let solution = g.solve(&equations, &unknowns)?;
        assert!(satisfies(g, &equations, &unknowns, &solution)?, "{n} unknowns");
        let cost = g.cost(&solution);
        assert!(cost.divisions <= n as u64 && cost.total() < 1500, "{n} unknowns: {cost:?}");
    }
    Ok(())
}

#[test]
fn the_solution_is_that_of_a_numeric_elimination() -> Result<(), Error> {
    let g = &mut Graph::new();
    let unknowns = symbols(g, ["x", "y", "z", "w"]);
    let q = g.time_function("q", 0)?;
    let (s, c) = (g.apply(Function::Sin, &[q])?, g.apply(Function::Cos, &[q])?);
    let (m, three) = (symbol(g, "m"), number(g, 3));
    let entries = [[c, s, m, Id::ZERO], [Id::ONE, c, Id::ZERO, s], [three, m, s, c], [s, Id::ONE, three, m]];
    let rights = [m, s, three, Id::ONE];
    let mut equations = Vec::new();
    for (row, right) in entries.iter().zip(rights) {
        let terms: Vec<(Id, Id)> = row.iter().copied().zip(unknowns).collect();
        equations.push(equation(g, &terms, right)?);
    }
    let solution = g.solve(&equations, &unknowns)?;
    let found = Evaluator::new(&g.tape(&[q, m], &solution)?).evaluate(&[0.4, 1.7])?;
    let (s, c, m) = (0.4_f64.sin(), 0.4_f64.cos(), 1.7);
    let a = [[c, s, m, 0.0], [1.0, c, 0.0, s], [3.0, m, s, c], [s, 1.0, 3.0, m]];
    for (row, right) in a.iter().zip([m, s, 3.0, 1.0]) {
        let left: f64 = row.iter().zip(&found).map(|(a, x)| a * x).sum();
        assert!((left - right).abs() < 1e-13, "{left} for {right}");
    }
    Ok(())
}

#[test]
fn random_systems_are_solved_exactly_when_their_determinant_is_not_zero() -> Result<(), Error> {
    let (mut solved, mut singular) = (0, 0);
    for seed in 0..300_u32 {
        let g = &mut Graph::new();
        let n = 2 + seed as usize % 5;
        let [a, b] = symbols(g, ["a", "b"]);
        let q = g.time_function("q", 0)?;
        let (sine, minus, two) = (g.apply(Function::Sin, &[q])?, g.integer(-1), g.integer(2));
        let choices = [Id::ZERO, Id::ZERO, Id::ZERO, Id::ONE, minus, two, a, b, sine];
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            choices[(state >> 16) as usize % choices.len()]
        };
        let unknowns: Vec<Id> = (0..n).map(|i| symbol(g, &format!("x{i}"))).collect();
        let (mut equations, mut entries) = (Vec::new(), Vec::new());
        for _ in 0..n {
            let row: Vec<(Id, Id)> = unknowns.iter().map(|&unknown| (next(), unknown)).collect();
            equations.push(equation(g, &row, next())?);
            entries.extend(row.iter().map(|&(entry, _)| entry));
        }
        let regular = g.determinant(&Matrix::new(n, n, entries)?)? != Id::ZERO;
        match g.solve(&equations, &unknowns) {
            Ok(solution) => {
                assert!(regular && satisfies(g, &equations, &unknowns, &solution)?, "seed {seed}");
                solved += 1;
            }
            Err(Error::Singular(text)) => {
                assert!(!regular, "seed {seed}: {text}");
                singular += 1;
            }
            Err(error) => return Err(error),
        }
    }
    assert!(solved > 200 && singular > 30, "{solved} solved, {singular} singular");
    Ok(())
}

/// The trifilar pendulum: the plate's frame from three of its points, six unknowns in three pairs.
#[test]
fn the_trifilar_frame_stays_small() -> Result<(), Error> {
    let g = &mut Graph::new();
    let l = symbol(g, "l");
    let three = number(g, 3);
    let root = g.sqrt(three)?;
    let half = g.number(&symbody_core::Number::rational(1, 2));
    let (along, across) = (g.mul(half, l)?, g.mul(root, l)?);
    let across = g.mul(half, across)?;
    let (mut equations, mut unknowns) = (Vec::new(), Vec::new());
    for axis in ["x", "y", "z"] {
        let [u, v] = ["u", "v"].map(|name| symbol(g, &format!("{name}{axis}")));
        let [a, b, c] = ["A", "B", "C"]
            .map(|point| g.time_function(&format!("{axis}{point}"), 0).expect("few derivatives"));
        let (side, opposite, from_a) = (g.neg(along), g.sub(b, a), g.sub(c, a));
        equations.push(equation(g, &[(across, u), (along, v)], opposite)?);
        equations.push(equation(g, &[(across, u), (side, v)], from_a)?);
        unknowns.extend([u, v]);
    }
    let solution = g.solve(&equations, &unknowns)?;
    assert!(satisfies(g, &equations, &unknowns, &solution)?);
    assert!(g.cost(&solution).total() <= 21, "{:?}", g.cost(&solution));
    assert_eq!(g.to_text(solution[0]), "sqrt(3)*(xB - 2*xA + xC)/(3*l)");
    // vx = (xB - xC)/l
    let (b, c) = (g.time_function("xB", 0)?, g.time_function("xC", 0)?);
    let difference = g.sub(b, c);
    let expected = g.div(difference, l)?;
    assert!(g.equal(solution[1], expected));
    Ok(())
}

#[test]
fn what_stands_alone_is_solved_first() -> Result<(), Error> {
    // 40 unknowns in a chain, far beyond what may be coupled.
    let g = &mut Graph::new();
    let unknowns: Vec<Id> = (0..40).map(|i| symbol(g, &format!("x{i}"))).collect();
    let a = symbol(g, "a");
    let mut equations = vec![equation(g, &[(a, unknowns[0])], Id::ONE)?];
    for pair in unknowns.windows(2) {
        equations.push(equation(g, &[(a, pair[1]), (Id::ONE, pair[0])], a)?);
    }
    equations.reverse();
    let solution = g.solve(&equations, &unknowns)?;
    assert!(satisfies(g, &equations, &unknowns, &solution)?);
    Ok(())
}

#[test]
fn unknowns_may_be_derivatives_and_applications() -> Result<(), Error> {
    let g = &mut Graph::new();
    let [x, v, a] = [0, 1, 2].map(|order| g.time_function("x", order).expect("few derivatives"));
    let [m, k, s] = symbols(g, ["m", "k", "s"]);
    let force = g.application("F", &[s], &[0])?;
    let first = equation(g, &[(m, a), (k, x)], force)?;
    let second = equation(g, &[(k, v), (m, x)], force)?;
    let solution = g.solve(&[first, second], &[a, force])?;
    let kv = g.mul(k, v)?;
    let mx = g.mul(m, x)?;
    let expected = g.add(kv, mx);
    assert!(g.equal(solution[1], expected));
    let kx = g.mul(k, x)?;
    let numerator = g.sub(expected, kx);
    let expected = g.div(numerator, m)?;
    assert!(g.equal(solution[0], expected));
    Ok(())
}

#[test]
fn hidden_linearity_is_found_by_value() -> Result<(), Error> {
    let g = &mut Graph::new();
    let [x, a, b] = symbols(g, ["x", "a", "b"]);
    // (x + a)^2 - (x - a)^2 - 4 b
    let (sum, difference) = (g.add(x, a), g.sub(x, a));
    let (plus, minus) = (g.mul(sum, sum)?, g.mul(difference, difference)?);
    let left = g.sub(plus, minus);
    let four = number(g, 4);
    let right = g.mul(four, b)?;
    let hidden = g.sub(left, right);
    let solution = g.solve(&[hidden], &[x])?;
    let expected = g.div(b, a)?;
    assert!(g.equal(solution[0], expected), "{}", g.to_text(solution[0]));
    Ok(())
}

#[test]
fn equations_that_are_not_linear_name_the_unknown() -> Result<(), Error> {
    let g = &mut Graph::new();
    let [x, y, a] = symbols(g, ["x", "y", "a"]);
    let product = g.mul(x, y)?;
    let bilinear = g.sub(product, a);
    let sine = g.apply(Function::Sin, &[y])?;
    let hidden = g.add(x, sine);
    let reciprocal = g.div(a, x)?;
    let pole = g.sub(reciprocal, Id::ONE);
    assert_eq!(message(g.solve(&[bilinear], &[x, y])), "the equation x*y - a = 0 is not linear in x");
    assert_eq!(message(g.solve(&[hidden], &[x, y])), "the equation x + sin(y) = 0 is not linear in y");
    assert_eq!(message(g.solve(&[pole], &[x])), "the equation a/x - 1 = 0 is not linear in x");
    assert!(matches!(g.solve(&[bilinear], &[product]), Err(Error::NotAVariable(_))));
    Ok(())
}

#[test]
fn systems_without_one_solution_name_the_equations() -> Result<(), Error> {
    let g = &mut Graph::new();
    let [x, y, z, a, b] = symbols(g, ["x", "y", "z", "a", "b"]);
    let first = equation(g, &[(a, x), (b, y)], Id::ONE)?;
    let second = equation(g, &[(Id::ONE, z)], a)?;
    let doubled = {
        let sum = g.add(first, second);
        g.mul(a, sum)?
    };
    let contradiction = g.add(doubled, Id::ONE);
    assert_eq!(
        message(g.solve(&[first, second, doubled], &[x, y, z])),
        "2 independent equations for 3 unknowns leave y free; equation 3 (a*(a*x + b*y - a + z - 1) = 0) \
         follows from equations 1 and 2: add equations, or solve for fewer unknowns"
    );
    assert_eq!(
        message(g.solve(&[first, second, contradiction], &[x, y, z])),
        "no solution: equation 3 (a*(a*x + b*y - a + z - 1) + 1 = 0) contradicts equations 1 and 2"
    );
    assert_eq!(
        message(g.solve(&[first], &[z])),
        "no solution: equation 1 (a*x + b*y - 1 = 0) contains none of the unknowns and is not zero"
    );
    assert_eq!(
        message(g.solve(&[second], &[x, z])),
        "1 independent equation for 2 unknowns leave x free: add equations, or solve for fewer unknowns"
    );
    assert_eq!(message(g.solve(&[second, first], &[z, z])), "the unknown z is given twice");
    Ok(())
}

#[test]
fn equations_that_agree_may_be_more_than_the_unknowns() -> Result<(), Error> {
    let g = &mut Graph::new();
    let [x, y, a] = symbols(g, ["x", "y", "a"]);
    let first = equation(g, &[(a, x), (Id::ONE, y)], Id::ONE)?;
    let second = equation(g, &[(Id::ONE, x), (a, y)], Id::ONE)?;
    let sum = g.add(first, second);
    let solution = g.solve(&[first, sum, second], &[x, y])?;
    assert!(satisfies(g, &[first, second], &[x, y], &solution)?);
    Ok(())
}

#[test]
fn too_many_coupled_unknowns_are_refused() -> Result<(), Error> {
    let g = &mut Graph::new();
    let unknowns: Vec<Id> = (0..7).map(|i| symbol(g, &format!("x{i}"))).collect();
    let a = symbol(g, "a");
    let mut equations = Vec::new();
    for i in 0..7 {
        equations.push(equation(g, &[(a, unknowns[i]), (Id::ONE, unknowns[(i + 1) % 7])], Id::ONE)?);
    }
    assert_eq!(
        message(g.solve(&equations, &unknowns)),
        "coupled unknowns of a linear system in symbols (solve fewer at a time, or give numbers to the \
         coefficients and solve numerically): at most 6, found 7"
    );
    Ok(())
}
