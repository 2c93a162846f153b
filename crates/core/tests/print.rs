//! Printed forms: what a reader expects to see, and how large expressions are cut.

use symbody_core::{Assumption, Error, Format, Function, Graph, Id, Number};

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
    let q2 = g.time_function("q2", 0);
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
    assert_eq!(g.to_text(entry), "m1*lc1**2 + m2*(l1**2 + lc2**2 + 2*l1*lc2*cos(q2)) + I1 + I2");
    Ok(())
}
