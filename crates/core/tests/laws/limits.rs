//! What is too large is an error or is kept whole: nothing is cut off in silence.

use symbody_core::{
    Assumption, Error, Function, Graph, Id, LARGEST_ORDER, Matrix, Number, NumberId, View, check_rows, vector,
};

const MOST_ARGUMENTS: usize = 60_000;

fn symbols(g: &mut Graph, count: usize) -> Vec<Id> {
    (0..count).map(|k| g.symbol(&format!("x{k}"), Assumption::Real)).collect()
}

fn is_limit<T>(result: &Result<T, Error>) -> bool {
    matches!(result, Err(Error::Limit { .. }))
}

#[test]
fn an_application_keeps_all_its_arguments() -> Result<(), Error> {
    let g = &mut Graph::new();
    for count in [32_767, 32_768, 40_000, MOST_ARGUMENTS] {
        let args = symbols(g, count);
        let orders: Vec<u32> = (0..count).map(|k| u32::from(k + 1 == count)).collect();
        let applied = g.application("f", &args, &orders)?;
        let View::Application { args: kept, orders: kept_orders, .. } = g.view(applied) else {
            panic!("{:?}", g.view(applied));
        };
        assert!(kept.iter().eq(args.iter().copied()), "{count} arguments");
        assert_eq!(kept_orders, orders);
        // Another last argument is another application.
        let others = [&args[..count - 1], &[Id::ONE]].concat();
        let other = g.application("f", &others, &orders)?;
        assert!(!g.equal(applied, other));
    }
    Ok(())
}

#[test]
fn functions_have_a_most_of_arguments() {
    let g = &mut Graph::new();
    let args = symbols(g, MOST_ARGUMENTS + 1);
    let orders = vec![0; args.len()];
    assert!(is_limit(&g.application("f", &args, &orders)));
    assert!(is_limit(&g.apply(Function::Max, &args)));
    assert!(matches!(g.application("f", &args[..2], &[0]), Err(Error::Shape { .. })));
}

#[test]
fn long_sums_are_nested() {
    let g = &mut Graph::new();
    let (args, one) = (symbols(g, 70_000), NumberId::ONE);
    let terms: Vec<_> = args.iter().map(|&id| (one, id)).collect();
    let whole = g.sum(&terms);
    let (left, right) = (g.sum(&terms[..35_000]), g.sum(&terms[35_000..]));
    let difference = g.sub(whole, left);
    assert!(g.equal(difference, right));
}

#[test]
fn long_products_are_nested() -> Result<(), Error> {
    let g = &mut Graph::new();
    let factors: Vec<_> = symbols(g, 31_000).into_iter().map(|id| (id, NumberId::ONE)).collect();
    let product = g.product(&factors)?;
    let (left, right) = (g.product(&factors[..500])?, g.product(&factors[500..])?);
    assert!(g.children(product).len() < factors.len());
    let again = g.mul(left, right)?;
    assert!(g.equal(product, again));
    Ok(())
}

#[test]
fn orders_of_derivatives_end() -> Result<(), Error> {
    let g = &mut Graph::new();
    let (last, next) = (LARGEST_ORDER, LARGEST_ORDER + 1);
    let x = g.symbol("x", Assumption::Real);
    let q = g.time_function("q", last)?;
    assert!(is_limit(&g.time_derivative(q)));
    assert!(is_limit(&g.time_function("q", next)) && is_limit(&g.time_function("q", u32::MAX)));
    let f = g.application("f", &[x], &[last])?;
    assert!(is_limit(&g.diff(f, x)));
    assert!(is_limit(&g.application("f", &[x, q], &[u32::MAX, u32::MAX])));
    assert!(is_limit(&g.diff_times(x, x, u64::MAX)));
    assert_eq!(g.diff_times(x, x, u64::from(last))?, Id::ZERO);
    Ok(())
}

#[test]
fn shapes_that_overflow_fit_nothing() -> Result<(), Error> {
    let g = &mut Graph::new();
    let huge = usize::MAX / 2;
    // (2^63 - 1)^2 is 1 modulo 2^64.
    for (rows, columns, entries) in [(huge, huge, vec![Id::ONE]), (1 << 32, 1 << 32, vec![])] {
        assert!(matches!(Matrix::new(rows, columns, entries), Err(Error::Shape { .. })));
    }
    assert!(is_limit(&Matrix::new(0, huge, Vec::new())) && is_limit(&Matrix::new(huge, 0, Vec::new())));
    let (tall, wide) = (Matrix::new(1 << 20, 0, Vec::new())?, Matrix::new(0, 1 << 20, Vec::new())?);
    assert!(is_limit(&g.matrix_product(&tall, &wide)));
    assert_eq!(g.determinant(&Matrix::identity(0))?, Id::ONE);
    assert_eq!(g.determinant(&Matrix::identity(64))?, Id::ONE);
    assert!(is_limit(&g.determinant(&Matrix::identity(65))));
    assert!(check_rows(244).is_ok() && is_limit(&check_rows(245)) && is_limit(&check_rows(huge)));
    for axis in [3, usize::MAX] {
        assert!(is_limit(&vector::rotate(g, axis, Id::ONE, [Id::ONE; 3])));
    }
    Ok(())
}

#[test]
fn stages_are_given_for_each_input_or_for_none() -> Result<(), Error> {
    let g = &mut Graph::new();
    let args = symbols(g, 2);
    let sum = g.add(args[0], args[1]);
    let tape = g.tape(&args, &[sum])?;
    assert!(tape.staged(&[]).is_ok() && tape.staged(&[0, 1]).is_ok());
    assert!(matches!(tape.staged(&[0]), Err(Error::Shape { .. })));
    Ok(())
}

/// 0^(a - 3/2) took for ever; 0^(a - 1) was 0, as 0^a times the reciprocal of zero.
#[test]
fn zero_to_an_unknown_power_is_opaque() -> Result<(), Error> {
    let g = &mut Graph::new();
    let a = g.symbol("a", Assumption::Real);
    let mut values = vec![Id::ZERO, Id::ONE];
    for exponent in [(-1, 1), (-3, 2), (1, 1), (1, 3)] {
        let shift = g.number(&Number::rational(exponent.0, exponent.1));
        let exponent = g.add(a, shift);
        let power = g.apply(Function::Power, &[Id::ZERO, exponent])?;
        assert!(values.iter().all(|&known| !g.equal(known, power)));
        values.push(power);
    }
    Ok(())
}

/// The least exponent of 64 bits has no magnitude of 63 bits.
#[test]
fn the_least_exponent_stays_closed() -> Result<(), Error> {
    let g = &mut Graph::new();
    let args = symbols(g, 2);
    let sum = g.add(args[0], args[1]);
    let power = g.pow_number(sum, &Number::integer(i64::MIN))?;
    let product = g.mul(power, args[0])?;
    let expanded = g.expand(product)?;
    assert!(g.equal(expanded, product));
    Ok(())
}
