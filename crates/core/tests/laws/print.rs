//! Printed forms: what a reader expects to see, and how large expressions are cut.

use symbody_core::{Assumption, Error, Format, Function, Graph, Id, Number, NumberId};

type Outcome = Result<(), Error>;

fn symbol(g: &mut Graph, name: &str) -> Id {
    g.symbol(name, Assumption::Real)
}

/// The product of nodes.
fn product(g: &mut Graph, factors: &[Id]) -> Result<Id, Error> {
    factors.iter().try_fold(Id::ONE, |product, &factor| g.mul(product, factor))
}

fn sum(g: &mut Graph, terms: &[Id]) -> Id {
    terms.iter().fold(Id::ZERO, |sum, &term| g.add(sum, term))
}

fn square(g: &mut Graph, base: Id) -> Result<Id, Error> {
    g.pow_number(base, &Number::integer(2))
}

/// The mass matrix entry of a two-link arm, as every textbook has it.
fn arm(g: &mut Graph) -> Result<Id, Error> {
    let [m1, m2, l1, lc1, lc2, i1, i2] =
        ["m1", "m2", "l1", "lc1", "lc2", "I1", "I2"].map(|name| symbol(g, name));
    let q2 = g.time_function("q2", 0)?;
    let cos = g.apply(Function::Cos, &[q2])?;
    let (two, l1_squared, lc1_squared, lc2_squared) =
        (g.integer(2), square(g, l1)?, square(g, lc1)?, square(g, lc2)?);
    let mixed = product(g, &[two, l1, lc2, cos])?;
    let inner = sum(g, &[mixed, lc2_squared, l1_squared]);
    let (first, second) = (g.mul(m1, lc1_squared)?, g.mul(m2, inner)?);
    Ok(sum(g, &[i2, second, i1, first]))
}

#[test]
fn terms_and_factors_are_in_the_order_of_a_textbook() -> Outcome {
    let g = &mut Graph::new();
    let entry = arm(g)?;
    assert_eq!(g.to_text(entry), "I1 + I2 + m1*lc1**2 + m2*(l1**2 + lc2**2 + 2*l1*lc2*cos(q2))");
    Ok(())
}

/// Three notations of one expression.
fn notations(g: &Graph, id: Id) -> [String; 3] {
    [g.to_text(id), g.to_latex(id), g.to_maple(id)]
}

#[test]
fn an_equation_of_motion_begins_with_its_accelerations() -> Outcome {
    let g = &mut Graph::new();
    let [m, c, k, k3, f] = ["m", "c", "k", "k3", "F"].map(|name| symbol(g, name));
    let [x, v, a] = [0, 1, 2].map(|order| g.time_function("x", order).expect("few derivatives"));
    let cube = g.pow_number(x, &Number::integer(3))?;
    let terms = [g.mul(k, x)?, g.neg(f), g.mul(c, v)?, g.mul(k3, cube)?, g.mul(m, a)?];
    let equation = sum(g, &terms);
    assert_eq!(
        notations(g, equation),
        [
            "m*x'' + c*x' + k3*x**3 + k*x - F",
            "m \\ddot{x} + c \\dot{x} + k_{3} x^{3} + k x - F",
            "m*diff(x(t),`$`(t,2))+c*diff(x(t),t)+k3*x(t)^3+k*x(t)-F",
        ]
    );
    Ok(())
}

#[test]
fn derivatives_have_primes_up_to_the_third() {
    let g = &mut Graph::new();
    let printed: Vec<[String; 3]> = (0..5)
        .map(|order| {
            let id = g.time_function("theta1", order).expect("few derivatives");
            notations(g, id)
        })
        .collect();
    assert_eq!(printed[0], ["theta1", "\\theta_{1}", "theta1(t)"]);
    assert_eq!(printed[1], ["theta1'", "\\dot{\\theta}_{1}", "diff(theta1(t),t)"]);
    assert_eq!(printed[2], ["theta1''", "\\ddot{\\theta}_{1}", "diff(theta1(t),`$`(t,2))"]);
    assert_eq!(printed[3], ["theta1'''", "\\dddot{\\theta}_{1}", "diff(theta1(t),`$`(t,3))"]);
    assert_eq!(printed[4], ["diff(theta1, t, 4)", "\\theta_{1}^{(4)}", "diff(theta1(t),`$`(t,4))"]);
}

#[test]
fn a_function_of_time_is_told_from_a_symbol_of_its_name() -> Outcome {
    let g = &mut Graph::new();
    let (x, x_of_t, v) = (symbol(g, "x"), g.time_function("x", 0)?, g.time_function("x", 1)?);
    let applied = g.application("y", &[x], &[0])?;
    let y_of_t = g.time_function("y", 0)?;
    let mixed = g.add(applied, y_of_t);
    assert_eq!(g.to_text(mixed), "y(t) + y(x)");
    let total = sum(g, &[x, x_of_t, v]);
    assert_eq!(
        notations(g, total),
        ["x'(t) + x(t) + x", "\\dot{x}\\left(t\\right) + x\\left(t\\right) + x", "diff(x(t),t)+x(t)+x"]
    );
    Ok(())
}

#[test]
fn divisions_and_roots() -> Outcome {
    let g = &mut Graph::new();
    let [a, b, c] = ["a", "b", "c"].map(|name| symbol(g, name));
    let (root, sum_ab) = (g.sqrt(c)?, g.add(a, b));
    let under = g.mul(b, root)?;
    let quotient = g.div(a, under)?;
    assert_eq!(notations(g, quotient), ["a/(b*sqrt(c))", "\\frac{a}{b \\sqrt{c}}", "a/(b*sqrt(c))"]);
    let half = g.number(&Number::rational(1, 2));
    let mean = g.mul(half, sum_ab)?;
    assert_eq!(notations(g, mean), ["(a + b)/2", "\\frac{a + b}{2}", "(a+b)/2"]);
    let inverse = g.div(Id::ONE, sum_ab)?;
    let three_halves = g.pow_number(inverse, &Number::rational(3, 2))?;
    let printed = notations(g, three_halves);
    assert_eq!(printed[0], "(1/(a + b))**(3/2)");
    assert_eq!(printed[1], "\\left(\\frac{1}{a + b}\\right)^{3/2}");
    let third = g.pow_number(a, &Number::rational(1, 3))?;
    assert_eq!(notations(g, third), ["a**(1/3)", "\\sqrt[3]{a}", "a^(1/3)"]);
    let (x, y) = (g.number(&Number::rational(3, 4)), g.pi());
    let angle = g.mul(x, y)?;
    assert_eq!(notations(g, angle), ["3*pi/4", "\\frac{3 \\pi}{4}", "3*Pi/4"]);
    Ok(())
}

#[test]
fn signs_stand_where_they_read_best() -> Outcome {
    let g = &mut Graph::new();
    let [a, b, m] = ["a", "b", "m"].map(|name| symbol(g, name));
    let (forth, back) = (g.sub(a, b), g.sub(b, a));
    assert_eq!([g.to_text(forth), g.to_text(back)], ["a - b", "b - a"]);
    let (plus, minus) = (g.mul(m, forth)?, g.mul(m, back)?);
    assert_eq!([g.to_text(plus), g.to_text(minus)], ["m*(a - b)", "m*(b - a)"]);
    let negative = g.neg(minus);
    let shifted = g.add(b, negative);
    assert_eq!(g.to_text(shifted), "m*(a - b) + b");
    let square = square(g, a)?;
    let one_minus = g.sub(Id::ONE, square);
    assert_eq!(g.to_text(one_minus), "1 - a**2");
    let both = g.add(a, b);
    let opposite = g.neg(both);
    assert_eq!(g.to_text(opposite), "-a - b");
    let scaled = g.mul(opposite, m)?;
    assert_eq!(g.to_text(scaled), "-m*(a + b)");
    Ok(())
}

#[test]
fn nested_sums_and_products_are_flat_and_like_terms_one() -> Outcome {
    let g = &mut Graph::new();
    let [a, b, c] = ["a", "b", "c"].map(|name| symbol(g, name));
    let ab = g.add(a, b);
    let inner = g.mul(c, ab)?;
    let (twice, abc) = (g.add(inner, ab), g.add(ab, c));
    let all = g.add(twice, abc);
    assert_eq!(g.to_text(all), "c*(a + b) + 2*a + 2*b + c");
    let (left, right) = (g.mul(a, b)?, g.mul(a, c)?);
    let both = g.mul(left, right)?;
    assert_eq!(g.to_text(both), "b*c*a**2");
    let half = g.number(&Number::rational(1, 2));
    let halves = g.mul(half, b)?;
    let mixed = g.add(a, halves);
    let two = g.integer(2);
    let doubled = g.mul(two, mixed)?;
    assert_eq!(g.to_text(doubled), "2*a + b");
    Ok(())
}

#[test]
fn names_are_in_natural_order() -> Outcome {
    let g = &mut Graph::new();
    let names = ["l10", "l2", "l1", "q"].map(|name| symbol(g, name));
    let (all, times) = (sum(g, &names), product(g, &names)?);
    assert_eq!([g.to_text(all), g.to_text(times)], ["l1 + l2 + l10 + q", "l1*l2*l10*q"]);
    Ok(())
}

#[test]
fn functions_of_every_kind() -> Outcome {
    let g = &mut Graph::new();
    let [x, y] = ["x", "y"].map(|name| symbol(g, name));
    let expected = [
        (Function::Asin, "asin(x)", "\\arcsin(x)", "arcsin(x)"),
        (Function::Log, "log(x)", "\\log(x)", "ln(x)"),
        (Function::Exp, "exp(x)", "e^{x}", "exp(x)"),
        (Function::Abs, "Abs(x)", "\\left|x\\right|", "abs(x)"),
        (Function::Sign, "sign(x)", "\\operatorname{sign}(x)", "signum(x)"),
    ];
    for (function, text, latex, maple) in expected {
        let id = g.apply(function, &[x])?;
        assert_eq!(notations(g, id), [text, latex, maple]);
    }
    let angle = g.apply(Function::Atan2, &[y, x])?;
    assert_eq!(notations(g, angle), ["atan2(y, x)", "\\operatorname{atan2}(y, x)", "arctan(y,x)"]);
    let power = g.apply(Function::Power, &[x, y])?;
    assert_eq!(notations(g, power), ["x**y", "x^{y}", "x^y"]);
    let tower = g.apply(Function::Power, &[power, y])?;
    assert_eq!(notations(g, tower), ["(x**y)**y", "\\left(x^{y}\\right)^{y}", "(x^y)^y"]);
    let sine = g.apply(Function::Sin, &[x])?;
    let squared = square(g, sine)?;
    assert_eq!(notations(g, squared), ["sin(x)**2", "\\sin^{2}(x)", "sin(x)^2"]);
    let pieces = g.apply(Function::Piecewise, &[x, y, Id::ZERO])?;
    assert_eq!(
        notations(g, pieces),
        [
            "Piecewise((x, y > 0), (0, True))",
            "\\begin{cases} x & \\text{if } y > 0 \\\\ 0 & \\text{otherwise} \\end{cases}",
            "piecewise(0 < y,x,0)",
        ]
    );
    let product = g.mul(pieces, x)?;
    assert_eq!(
        g.to_latex(product),
        "x \\left(\\begin{cases} x & \\text{if } y > 0 \\\\ 0 & \\text{otherwise} \\end{cases}\\right)"
    );
    let largest = g.apply(Function::Max, &[y, x, Id::ONE])?;
    assert_eq!(g.to_text(largest), "Max(1, x, y)");
    let partial = g.application("f", &[x, y], &[1, 2])?;
    assert_eq!(notations(g, partial), ["D[1,2,2](f)(x, y)", "D_{1,2,2} f(x, y)", "D[1,2,2](f)(x,y)"]);
    Ok(())
}

/// x(n+1) = sin(x(n)) * x(n) + 1: the tree doubles with every level.
fn doubling(g: &mut Graph, levels: usize) -> Result<Id, Error> {
    let mut id = symbol(g, "x");
    for _ in 0..levels {
        let sine = g.apply(Function::Sin, &[id])?;
        let times = g.mul(sine, id)?;
        id = g.add(times, Id::ONE);
    }
    Ok(id)
}

#[test]
fn a_shared_graph_never_unfolds() -> Outcome {
    let g = &mut Graph::new();
    let id = doubling(g, 200)?;
    let listing = g.listing(&[id], Format::Text);
    assert!((60..=200).contains(&listing.definitions.len()), "{}", listing.definitions.len());
    let longest = listing.definitions.iter().map(|(_, value)| value.len()).max();
    assert!(longest.is_some_and(|length| length < 100));
    assert!(g.to_text(id).ends_with(&format!("\n{}", listing.results[0])));
    Ok(())
}

#[test]
fn deep_expressions_print_through_intermediates() -> Outcome {
    let g = &mut Graph::new();
    let mut id = symbol(g, "x");
    for _ in 0..40_000 {
        id = g.apply(Function::Sin, &[id])?;
    }
    let listing = g.listing(&[id], Format::Text);
    assert!(listing.definitions.len() > 400);
    assert!(listing.definitions[0].1.starts_with("sin(sin("));
    let x = symbol(g, "x");
    let mut long = Id::ZERO;
    for index in 0..300 {
        let next = symbol(g, &format!("a{index}"));
        long = g.add(long, next);
        long = g.add(long, x);
    }
    let text = g.to_text(long);
    assert!(text.starts_with("a0 + a1 + a2 + "), "a sum of sums is one sum: {text}");
    assert!(text.ends_with(" + a299 + 300*x"), "{text}");
    Ok(())
}

#[test]
fn a_wide_sum_is_cut_into_slices() {
    let g = &mut Graph::new();
    let names: Vec<Id> = (0..5000).map(|index| symbol(g, &format!("z{index}"))).collect();
    let terms: Vec<_> = names.iter().map(|&id| (NumberId::ONE, id)).collect();
    let id = g.sum(&terms);
    let listing = g.listing(&[id], Format::Text);
    assert!(listing.definitions.len() > 20);
    assert!(listing.definitions.iter().all(|(name, _)| name.starts_with('r')), "names in use are avoided");
    let terms = listing.definitions.iter().map(|(_, value)| value.matches('+').count() + 1);
    assert_eq!(terms.sum::<usize>(), 5000);
}

#[test]
fn names_look_like_none_of_the_users() -> Outcome {
    for (own, prefix) in [("z", "r"), ("z_a", "r"), ("z12", "r"), ("zeta", "z"), ("x", "z")] {
        let g = &mut Graph::new();
        let id = doubling(g, 30)?;
        let name = symbol(g, own);
        let total = g.sum(&[(NumberId::ONE, id), (NumberId::ONE, name)]);
        let listing = g.listing(&[total], Format::Text);
        assert!(listing.definitions.iter().all(|(name, _)| name.starts_with(prefix)), "{own}");
    }
    Ok(())
}

#[test]
fn several_expressions_share_their_intermediates() -> Outcome {
    let g = &mut Graph::new();
    let id = doubling(g, 30)?;
    let y = symbol(g, "y");
    let (first, second) = (g.mul(id, y)?, g.add(id, y));
    let alone = g.listing(&[first], Format::Text).definitions.len();
    let together = g.listing(&[first, second], Format::Maple);
    assert!(together.definitions.len() <= alone + 1);
    assert_eq!(together.results.len(), 2);
    let last = &together.definitions[together.definitions.len() - 1].0;
    assert_eq!(together.results, [format!("y*{last}"), format!("y+{last}")]);
    Ok(())
}

#[test]
fn the_text_does_not_depend_on_what_was_built_before() -> Outcome {
    let (fresh, used) = (&mut Graph::new(), &mut Graph::new());
    for name in ["q2", "l1", "zeta", "m2"] {
        let id = symbol(used, name);
        used.apply(Function::Cos, &[id])?;
    }
    doubling(used, 20)?;
    let (a, b) = (arm(fresh)?, arm(used)?);
    assert_eq!(notations(fresh, a), notations(used, b));
    Ok(())
}
