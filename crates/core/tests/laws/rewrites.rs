//! Laws of the rewrites on random expressions: the value stays, simplification costs nothing, texts repeat.

use symbody_core::{Assumption, Error, Function, Graph, Id, Number};

type Result<T> = std::result::Result<T, Error>;

const SEEDS: u64 = 60;

/// A small generator of reproducible choices (`SplitMix64`).
struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % sides
    }

    fn pick(&mut self, ids: &[Id]) -> Id {
        let recent = ids.len() as u64;
        ids[usize::try_from(self.roll(recent)).unwrap_or(0)]
    }
}

/// An expression of sums, products, powers, quotients, roots and trigonometric functions.
fn random_expression(g: &mut Graph, seed: u64, size: usize) -> Result<Id> {
    let dice = &mut Dice(seed);
    let mut known: Vec<Id> = ["a", "b", "k"].map(|name| g.symbol(name, Assumption::Real)).to_vec();
    for name in ["u", "v"] {
        known.extend([0, 1, 2].map(|order| g.time_function(name, order).expect("few derivatives")));
    }
    known.push(g.number(&Number::rational(3, 2)));
    known.push(g.number(&Number::from_f64(0.1)?));
    for _ in 0..size {
        let (x, y) = (dice.pick(&known), dice.pick(&known));
        let id = match dice.roll(20) {
            0..=3 => g.add(x, y),
            4 => g.sub(x, y),
            5..=7 => g.mul(x, y)?,
            8 => g.apply(Function::Sin, &[x])?,
            9 => g.apply(Function::Cos, &[x])?,
            10 => g.pow_number(x, &Number::integer(2))?,
            11 => sum_of_a_square(g, x, Graph::sqrt)?,
            12 => sum_of_a_square(g, x, |g, y| g.apply(Function::Log, &[y]))?,
            13 => g.apply(Function::Exp, &[x])?,
            14 => g.apply(Function::Tan, &[x])?,
            15 => g.apply(Function::Abs, &[x])?,
            16 => g.apply(Function::Max, &[x, y])?,
            17 => g.apply(Function::Tanh, &[x])?,
            _ if g.as_number(y).is_some() => g.sub(y, x),
            _ => g.div(x, y)?,
        };
        known.push(id);
    }
    Ok(known[known.len() - 4..].iter().fold(Id::ZERO, |sum, &id| g.add(sum, id)))
}

/// f(1 + x**2)
fn sum_of_a_square(g: &mut Graph, x: Id, f: impl Fn(&mut Graph, Id) -> Result<Id>) -> Result<Id> {
    let square = g.mul(x, x)?;
    let sum = g.add(square, Id::ONE);
    f(g, sum)
}

#[test]
fn rewrites_keep_the_value() -> Result<()> {
    let g = &mut Graph::new();
    for seed in 0..SEEDS {
        let e = random_expression(g, seed, 14)?;
        let variables = [g.time_function("u", 1)?, g.symbol("a", Assumption::Real)];
        let rewritten = [
            g.expand(e),
            g.expand_trig(e),
            g.collect(e, &variables),
            g.factor_terms(e),
            g.combine_trig(e),
            g.simplify(e),
        ];
        for (rule, result) in rewritten.into_iter().enumerate() {
            match result {
                Ok(new) => assert_eq!(g.value(new), g.value(e), "rule {rule}, seed {seed}"),
                Err(Error::Limit { .. }) => assert!(rule < 5, "simplify never fails"),
                Err(error) => return Err(error),
            }
        }
    }
    Ok(())
}

#[test]
fn simplification_never_costs() -> Result<()> {
    let g = &mut Graph::new();
    let mut gained = 0;
    for seed in 100..180 {
        let e = random_expression(g, seed, 18)?;
        let expanded = g.expand(e).unwrap_or(e);
        for form in [e, expanded] {
            let simple = g.simplify(form)?;
            let (before, after) = (g.cost(&[form]).total(), g.cost(&[simple]).total());
            assert!(after <= before, "seed {seed}: {before} -> {after}");
            gained += usize::from(after < before);
        }
    }
    assert!(gained > 20, "{gained} of 160");
    Ok(())
}

#[test]
fn texts_do_not_depend_on_what_was_done_before() -> Result<()> {
    let texts = |prepare: &dyn Fn(&mut Graph) -> Result<()>| -> Result<Vec<String>> {
        let g = &mut Graph::new();
        prepare(g)?;
        let mut texts = Vec::new();
        for seed in 200..230 {
            let e = random_expression(g, seed, 14)?;
            for result in [g.simplify(e), g.expand(e), g.factor_terms(e), g.combine_trig(e)] {
                texts.push(result.map_or_else(|error| error.to_string(), |id| g.to_text(id)));
            }
        }
        Ok(texts)
    };
    let fresh = texts(&|_| Ok(()))?;
    let used = texts(&|g| {
        for seed in (0..40).rev() {
            let e = random_expression(g, seed + 210, 20)?;
            g.simplify(e)?;
        }
        Ok(())
    })?;
    assert_eq!(fresh, used);
    Ok(())
}

#[test]
fn a_rewrite_leaves_the_derivation_as_it_was() -> Result<()> {
    let g = &mut Graph::new();
    let [a, b, c] = ["a", "b", "c"].map(|name| g.symbol(name, Assumption::Real));
    g.enter(Box::default());
    let sum = g.add(b, c);
    let closed = g.mul(a, sum)?;
    let open = g.expand(closed)?;
    assert_ne!(open, closed);
    assert_eq!(g.value(open), g.value(closed));
    let (ab, ac) = (g.mul(a, b)?, g.mul(a, c)?);
    assert_eq!(g.add(ab, ac), closed);
    assert!(g.leave().is_some());
    Ok(())
}

#[test]
fn quotients_cancel_exactly() -> Result<()> {
    let g = &mut Graph::new();
    let [a, b] = ["a", "b"].map(|name| g.symbol(name, Assumption::Real));
    let (sum, difference) = (g.add(a, b), g.sub(a, b));
    let product = g.mul(sum, difference)?;
    let expanded = g.expand(product)?;
    let quotient = g.div(expanded, sum)?;
    assert_eq!(g.simplify(quotient)?, difference);
    let (x, y) = (g.div(a, sum)?, g.div(b, product)?);
    let two = g.add(x, y);
    let simple = g.simplify(two)?;
    assert!(g.cost(&[simple]).total() <= g.cost(&[two]).total());
    Ok(())
}

#[test]
fn deep_and_wide_expressions_are_done_or_left() -> Result<()> {
    let g = &mut Graph::new();
    let [a, b] = ["a", "b"].map(|name| g.symbol(name, Assumption::Real));
    let mut chain = a;
    for level in 0..40_000 {
        let sum = g.add(chain, b);
        chain = if level % 2 == 0 { g.mul(sum, a)? } else { g.apply(Function::Sin, &[sum])? };
    }
    let simple = g.simplify(chain)?;
    assert_eq!(g.value(simple), g.value(chain));
    let factored = g.factor_terms(chain)?;
    assert_eq!(g.value(factored), g.value(chain));
    assert!(matches!(g.collect(chain, &[b]), Ok(_) | Err(Error::Limit { .. })));
    Ok(())
}
