use symbody_core::{Assumption, Error, Function, Graph, Id, Number};

pub fn equal_mathematics_has_one_value() -> Result<(), Error> {
    let mut g = Graph::new();
    let x = g.symbol("x", Assumption::Real);
    let (sin, cos) = (g.apply(Function::Sin, &[x])?, g.apply(Function::Cos, &[x])?);

    // sin(x)**2 + cos(x)**2 is the number 1 as soon as it is made.
    let (sin_squared, cos_squared) = (g.mul(sin, sin)?, g.mul(cos, cos)?);
    assert_eq!(g.add(sin_squared, cos_squared), Id::ONE);

    // (x + 1)**2 and x**2 + 2*x + 1 are two forms, hence two nodes, of one value.
    let sum = g.add(x, Id::ONE);
    let square = g.pow_number(sum, &Number::integer(2))?;
    let expanded = g.expand(square)?;
    assert_ne!(square, expanded);
    assert!(g.equal(square, expanded));
    assert_eq!(g.to_text(expanded), "x**2 + 2*x + 1");

    // Their difference is the number 0.
    assert_eq!(g.sub(square, expanded), Id::ZERO);
    Ok(())
}
