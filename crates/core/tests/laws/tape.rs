//! Laws of tapes: the same numbers as an independent evaluation, few operations, bounded memory of the stack.

use std::collections::HashMap;

use symbody_core::{
    Assumption, Column, Cost, Error, Evaluator, Function, Graph, Id, Instruction, Number, NumberId, Operand,
    View,
};

/// The value of a node, straight from its definition.
fn value(graph: &Graph, root: Id, variables: &HashMap<Id, f64>) -> f64 {
    let mut values: HashMap<Id, f64> = HashMap::new();
    for id in graph.post_order(&[root]) {
        let number = |n: NumberId| graph.get_number(n).to_f64();
        let result = match graph.view(id) {
            View::Number(n) => number(n),
            View::Pi => std::f64::consts::PI,
            View::Scale(factor, child) => number(factor) * values[&child],
            View::Sum(terms) => terms.iter().map(|(c, node)| number(c) * values[&node]).sum(),
            View::Product(factors) => factors.iter().map(|(base, e)| values[&base].powf(number(e))).product(),
            View::Function(function, args) => {
                function.evaluate(&args.iter().map(|arg| values[&arg]).collect::<Vec<_>>())
            }
            _ => variables[&id],
        };
        values.insert(id, result);
    }
    values[&root]
}

/// A small generator of pseudo-random numbers (Steele, Lea & Flood 2014).
struct Random(u64);

impl Random {
    fn between(&mut self, low: i64, high: i64) -> i64 {
        low + i64::try_from(self.below(usize::try_from(high - low + 1).unwrap_or(1))).unwrap_or(0)
    }

    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        usize::try_from((z ^ (z >> 31)) % n as u64).expect("a remainder by a usize")
    }
}

fn variables(graph: &mut Graph) -> Vec<Id> {
    let mut all: Vec<Id> = ["a", "b", "c"].map(|name| graph.symbol(name, Assumption::Positive)).to_vec();
    all.extend((0..3).map(|order| graph.time_function("x", order).expect("few derivatives")));
    let argument = all[0];
    all.push(graph.application("f", &[argument], &[1]).expect("one argument"));
    all
}

/// A node made of random earlier ones.
fn random_node(graph: &mut Graph, pool: &[Id], random: &mut Random) -> Result<Id, Error> {
    let (a, b, c) = (pool[random.below(pool.len())], pool[random.below(pool.len())], pool[random.below(7)]);
    match random.below(14) {
        0 | 1 => Ok(graph.add(a, b)),
        2 => Ok(graph.sub(a, b)),
        3 | 4 => graph.mul(a, b),
        5 => graph.div(a, b),
        6 => {
            let exponent = Number::rational(random.between(-6, 6), random.between(1, 2));
            graph.pow_number(c, &exponent)
        }
        7 => {
            let factor = Number::rational(random.between(-4, 4), 3);
            let factor = graph.number(&factor);
            graph.mul(factor, a)
        }
        8 => graph.apply(Function::Sin, &[a]),
        9 => graph.apply(Function::Cos, &[a]),
        10 => graph.apply(Function::Atan2, &[a, b]),
        11 => graph.apply([Function::Min, Function::Max][random.below(2)], &[a, b, c]),
        12 => graph.apply(Function::Piecewise, &[a, b, b, c, c]),
        _ => {
            let three = graph.integer(3);
            let root = graph.sqrt(three)?;
            graph.mul(root, a)
        }
    }
}

#[test]
fn tapes_give_the_numbers_of_the_definition() -> Result<(), Error> {
    let numbers = [0.7, 1.3, 2.1, -0.4, 0.9, -1.7, 0.3];
    let mut compared = 0;
    for seed in 0..60 {
        let graph = &mut Graph::new();
        let inputs = variables(graph);
        let (mut pool, mut random) = (inputs.clone(), Random(seed));
        for _ in 0..40 {
            // A division by what happens to be zero, or a root of a negative number: no node.
            pool.extend(random_node(graph, &pool, &mut random).ok().filter(|&id| id != Id::ZERO));
        }
        let given: HashMap<Id, f64> = inputs.iter().copied().zip(numbers).collect();
        let evaluator = Evaluator::new(&graph.tape(&inputs, &pool)?);
        let found = evaluator.evaluate(&numbers)?;
        for (&id, found) in pool.iter().zip(found) {
            let expected = value(graph, id, &given);
            let close = (found - expected).abs() <= 1e-9 * (1.0 + expected.abs());
            if expected.abs() < 1e6 {
                compared += 1;
                assert!(close, "seed {seed}: {found} for {expected}: {}", graph.to_text(id));
            }
        }
    }
    assert!(compared > 1000, "only {compared} comparisons");
    Ok(())
}

#[test]
fn a_tape_does_no_more_than_its_expressions_cost() -> Result<(), Error> {
    for seed in 0..60 {
        let graph = &mut Graph::new();
        let inputs = variables(graph);
        let (mut pool, mut random) = (inputs.clone(), Random(seed));
        for _ in 0..40 {
            pool.extend(random_node(graph, &pool, &mut random).ok());
        }
        for outputs in [&pool[..], &pool[30..], &pool[pool.len() - 1..]] {
            let (done, expected) = (graph.tape(&inputs, outputs)?.operations(), graph.cost(outputs));
            let text: Vec<String> = outputs.iter().map(|&id| graph.to_text(id)).collect();
            let arithmetic = |cost: Cost| cost.total() - cost.functions;
            assert!(arithmetic(done) <= arithmetic(expected), "seed {seed}: {done:?} {expected:?} {text:?}");
        }
    }
    Ok(())
}

#[test]
fn columns_give_the_numbers_of_single_points() -> Result<(), Error> {
    let graph = &mut Graph::new();
    let inputs = variables(graph);
    let (mut pool, mut random) = (inputs.clone(), Random(7));
    for _ in 0..60 {
        pool.extend(random_node(graph, &pool, &mut random).ok());
    }
    let evaluator = Evaluator::new(&graph.tape(&inputs, &pool)?);
    for points in [0_u32, 1, 15, 256, 1000] {
        let arrays: Vec<Vec<f64>> =
            (0..7).map(|k| (0..points).map(|i| f64::from(k * 5000 + i).sin()).collect()).collect();
        let points = points as usize;
        let columns: Vec<Column> =
            (0..7).map(|k| if k == 4 { Column::Scalar(0.25) } else { Column::Array(&arrays[k]) }).collect();
        let found = evaluator.evaluate_columns(&columns, points)?;
        assert_eq!(found.len(), pool.len() * points);
        for point in 0..points {
            let here: Vec<f64> = (0..7).map(|k| if k == 4 { 0.25 } else { arrays[k][point] }).collect();
            for (output, expected) in evaluator.evaluate(&here)?.into_iter().enumerate() {
                assert_eq!(found[output * points + point].to_bits(), expected.to_bits());
            }
        }
    }
    Ok(())
}

#[test]
fn signs_end_in_subtractions_and_powers_in_one_division() -> Result<(), Error> {
    let g = &mut Graph::new();
    let [a, b, c] = ["a", "b", "c"].map(|name| g.symbol(name, Assumption::Real));
    // -a*b - 3*c + b/(a^2 c), and its opposite.
    let (ab, three) = (g.mul(a, b)?, g.integer(3));
    let (c3, a2) = (g.mul(three, c)?, g.mul(a, a)?);
    let below = g.mul(a2, c)?;
    let quotient = g.div(b, below)?;
    let positive = g.add(ab, c3);
    let difference = g.sub(quotient, positive);
    let opposite = g.neg(difference);
    let tape = g.tape(&[a, b, c], &[difference, opposite])?;
    let count = tape.operations();
    assert_eq!((count.additions, count.multiplications, count.divisions), (3, 4, 1), "{tape:?}");
    let signs = tape.instructions.iter().filter(|i| matches!(i, Instruction::Neg(_))).count();
    assert_eq!(signs, 0);
    Ok(())
}

#[test]
fn constants_are_computed_when_the_tape_is_made() -> Result<(), Error> {
    let g = &mut Graph::new();
    let a = g.symbol("a", Assumption::Real);
    let (two, pi) = (g.integer(2), g.pi());
    let (root, sine) = (g.sqrt(two)?, g.apply(Function::Sin, &[two])?);
    let factors = g.mul(root, pi)?;
    let product = g.mul(factors, a)?;
    let twice = g.mul(two, product)?;
    let sum = g.add(sine, root);
    let all = g.add(twice, sum);
    let tape = g.tape(&[a], &[all, sum])?;
    let count = tape.operations();
    assert_eq!((count.additions, count.multiplications, count.functions), (1, 1, 0), "{tape:?}");
    let root = 2f64.sqrt();
    let expected = 2.0 * root * std::f64::consts::PI * 0.5 + 2f64.sin() + root;
    let found = Evaluator::new(&tape).evaluate(&[0.5])?;
    assert!((found[0] - expected).abs() < 1e-15 * expected && (found[1] - 2f64.sin() - root).abs() < 1e-15);
    Ok(())
}

#[test]
fn logarithms_and_powers_of_numbers_beyond_the_doubles_are_doubles() -> Result<(), Error> {
    let g = &mut Graph::new();
    let [x, y] = ["x", "y"].map(|name| g.symbol(name, Assumption::Real));
    let large = g.number(&Number::integer(10).powi(400)?);
    let small = g.number(&Number::integer(10).powi(-400)?);
    let product = g.mul(x, y)?;
    let mut outputs = Vec::new();
    for argument in [x, product] {
        let argument = g.mul(large, argument)?;
        outputs.push(g.apply(Function::Log, &[argument])?);
    }
    outputs.push(g.apply(Function::Log, &[small])?);
    for base in [large, small] {
        outputs.push(g.apply(Function::Power, &[base, y])?);
    }
    let multiple = g.mul(large, x)?;
    outputs.push(g.apply(Function::Power, &[multiple, y])?);
    let tape = g.tape(&[x, y], &outputs)?;
    let unit = 400.0 * std::f64::consts::LN_10;
    let found = Evaluator::new(&tape).evaluate(&[2.0, 0.75])?;
    let expected = [unit + 2f64.ln(), unit + 1.5f64.ln(), -unit, 1e300, 1e-300, 2f64.powf(0.75) * 1e300];
    for (value, expected) in found.iter().zip(expected) {
        assert!((value / expected - 1.0).abs() < 1e-13, "{value} {expected}");
    }
    let negative = Evaluator::new(&g.tape(&[x, y], &[outputs[5]])?);
    assert!((negative.evaluate(&[-1e-200, 1.0])?[0] / -1e200 - 1.0).abs() < 1e-13);
    assert!(negative.evaluate(&[-1.0, 0.5])?[0].is_nan());
    Ok(())
}

#[test]
fn a_cosine_follows_its_sine() -> Result<(), Error> {
    let g = &mut Graph::new();
    let inputs: Vec<Id> =
        (0..20).map(|i| g.time_function(&format!("q{i}"), 0).expect("few derivatives")).collect();
    let mut sum = Id::ZERO;
    for pair in inputs.windows(2) {
        let (sine, cosine) = (g.apply(Function::Sin, &[pair[0]])?, g.apply(Function::Cos, &[pair[1]])?);
        let product = g.mul(sine, cosine)?;
        sum = g.add(sum, product);
    }
    let tape = g.tape(&inputs, &[sum])?;
    let place = |function, q| {
        let wanted = Instruction::Unary(function, Operand::Input(q));
        tape.instructions.iter().position(|&i| i == wanted)
    };
    for q in 1..19 {
        let pair = [place(Function::Sin, q), place(Function::Cos, q)].map(|p| p.map_or(0, |p| p + 1));
        assert!(pair[0] > 0 && pair[0].abs_diff(pair[1]) == 1, "q{q}: {pair:?}");
    }
    Ok(())
}

#[test]
fn missing_inputs_are_named() -> Result<(), Error> {
    let g = &mut Graph::new();
    let [m, k] = ["m", "k"].map(|name| g.symbol(name, Assumption::Real));
    let x = g.time_function("x", 0)?;
    let force = g.mul(k, x)?;
    let friction = g.application("f", &[m], &[0])?;
    let total = g.add(force, friction);
    let Err(error) = g.tape(&[x], &[total]) else { panic!("k and f have no value") };
    assert_eq!(error.to_string(), "no value for f(m), k: make each an input, or substitute it");
    let Err(error) = g.tape_or_advice(&[x], &[total], "give one for each") else { panic!("k has no value") };
    assert_eq!(error.to_string(), "no value for f(m), k: give one for each, or substitute it");
    assert!(matches!(g.tape(&[total], &[total]), Err(Error::NotAVariable(_))));
    let evaluator = Evaluator::new(&g.tape(&[x, k, friction], &[total])?);
    let Err(error) = evaluator.evaluate(&[1.0]) else { panic!("k and f have no value") };
    assert_eq!(error.to_string(), "no value for k, f(m): 1 of 3 inputs given");
    assert!(matches!(evaluator.evaluate(&[1.0; 4]), Err(Error::Limit { .. })));
    assert_eq!(evaluator.evaluate(&[2.0, 3.0, 4.0])?, [10.0]);
    Ok(())
}

#[test]
fn deep_and_large_tapes_need_no_stack() -> Result<(), Error> {
    let g = &mut Graph::new();
    let [a, b] = ["a", "b"].map(|name| g.symbol(name, Assumption::Real));
    let (mut x, mut expected) = (a, 0.3_f64);
    for _ in 0..40_000 {
        let product = g.mul(x, b)?;
        let sine = g.apply(Function::Sin, &[product])?;
        x = g.add(sine, a);
        expected = (expected * 0.9).sin() + 0.3;
    }
    let tape = g.tape(&[a, b], &[x])?;
    assert_eq!(tape.instructions.len(), 120_000);
    assert!(tape.registers().count <= 3, "{} registers", tape.registers().count);
    let found = Evaluator::new(&tape).evaluate(&[0.3, 0.9])?;
    assert!((found[0] - expected).abs() < 1e-12);
    Ok(())
}

#[test]
fn a_tape_of_hundreds_of_thousands_of_nodes() -> Result<(), Error> {
    let g = &mut Graph::new();
    let [a, b] = ["a", "b"].map(|name| g.symbol(name, Assumption::Real));
    let (mut x, mut y, mut expected) = (a, b, (0.3_f64, 0.2_f64));
    while g.len() < 300_000 {
        let product = g.mul(x, a)?;
        (x, y) = (g.add(product, y), g.mul(x, b)?);
        expected = (expected.0 * 0.3 + expected.1, expected.0 * 0.2);
    }
    let tape = g.tape(&[a, b], &[x, y])?;
    let (length, registers) = (tape.instructions.len(), tape.registers().count);
    assert!(length > 297_000 && registers < 10, "{length} instructions, {registers} registers");
    let found = Evaluator::new(&tape).evaluate(&[0.3, 0.2])?;
    let close = (found[0] - expected.0).abs() < 1e-9 && (found[1] - expected.1).abs() < 1e-9;
    assert!(close, "{found:?} {expected:?}");
    Ok(())
}

#[test]
fn tapes_do_not_depend_on_earlier_work() -> Result<(), Error> {
    let build = |graph: &mut Graph| -> Result<symbody_core::Tape, Error> {
        let inputs = variables(graph);
        let (mut pool, mut random) = (inputs.clone(), Random(3));
        for _ in 0..60 {
            pool.extend(random_node(graph, &pool, &mut random).ok());
        }
        graph.tape(&inputs, &pool[30..])
    };
    let fresh = build(&mut Graph::new())?;
    let graph = &mut Graph::new();
    let (z, c) = (graph.symbol("z", Assumption::Real), graph.symbol("c", Assumption::Positive));
    let sum = graph.add(c, z);
    graph.mul(sum, c)?;
    assert_eq!(build(graph)?, fresh);
    Ok(())
}
