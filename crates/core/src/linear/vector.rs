//! Vectors of three components.

use crate::error::Error;
use crate::graph::{Function, Graph, Id, NumberId};

/// The components of a vector in one frame.
pub type Vector3 = [Id; 3];

/// The sum `a + b`.
pub fn add(graph: &mut Graph, a: Vector3, b: Vector3) -> Vector3 {
    std::array::from_fn(|i| graph.add(a[i], b[i]))
}

/// The difference `a - b`.
pub fn sub(graph: &mut Graph, a: Vector3, b: Vector3) -> Vector3 {
    std::array::from_fn(|i| graph.sub(a[i], b[i]))
}

/// The multiple `s a`.
///
/// # Errors
/// Never: products of nodes do not divide.
pub fn scale(graph: &mut Graph, s: Id, a: Vector3) -> Result<Vector3, Error> {
    Ok([graph.mul(s, a[0])?, graph.mul(s, a[1])?, graph.mul(s, a[2])?])
}

/// The scalar product `a . b`.
///
/// # Errors
/// Never: products of nodes do not divide.
pub fn dot(graph: &mut Graph, a: Vector3, b: Vector3) -> Result<Id, Error> {
    let terms = [graph.mul(a[0], b[0])?, graph.mul(a[1], b[1])?, graph.mul(a[2], b[2])?];
    Ok(graph.sum(&terms.map(|term| (NumberId::ONE, term))))
}

/// The vector product `a x b`.
///
/// # Errors
/// Never: products of nodes do not divide.
pub fn cross(graph: &mut Graph, a: Vector3, b: Vector3) -> Result<Vector3, Error> {
    let mut component = |i: usize, j: usize| -> Result<Id, Error> {
        let (plus, minus) = (graph.mul(a[i], b[j])?, graph.mul(a[j], b[i])?);
        Ok(graph.sub(plus, minus))
    };
    Ok([component(1, 2)?, component(2, 0)?, component(0, 1)?])
}

/// R v for the rotation about axis 0, 1 or 2 by an angle.
///
/// # Errors
/// If there is no such axis.
pub fn rotate(graph: &mut Graph, axis: usize, angle: Id, v: Vector3) -> Result<Vector3, Error> {
    let [cos, sin] = wave(graph, angle)?;
    let opposite = graph.neg(sin);
    turn_back(graph, axis, [cos, opposite], v)
}

/// R^T v for the rotation about axis 0, 1 or 2 by an angle.
///
/// # Errors
/// If there is no such axis.
pub fn rotate_back(graph: &mut Graph, axis: usize, angle: Id, v: Vector3) -> Result<Vector3, Error> {
    let wave = wave(graph, angle)?;
    turn_back(graph, axis, wave, v)
}

/// The cosine and the sine, as far as the derivation in progress keeps them: those of small angles are short.
fn wave(graph: &mut Graph, angle: Id) -> Result<[Id; 2], Error> {
    let (cos, sin) = (graph.apply(Function::Cos, &[angle])?, graph.apply(Function::Sin, &[angle])?);
    let kept = graph.kept(vec![cos, sin])?;
    Ok([kept[0], kept[1]])
}

fn turn_back(graph: &mut Graph, axis: usize, [cos, sin]: [Id; 2], v: Vector3) -> Result<Vector3, Error> {
    if axis > 2 {
        return Err(Error::Limit { what: "number of an axis", limit: 2, found: axis });
    }
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut out = v;
    let (cj, sk) = (graph.mul(cos, v[j])?, graph.mul(sin, v[k])?);
    out[j] = graph.add(cj, sk);
    let (ck, sj) = (graph.mul(cos, v[k])?, graph.mul(sin, v[j])?);
    out[k] = graph.sub(ck, sj);
    Ok(out)
}

/// M v for the nine entries of M, row by row.
///
/// # Errors
/// Never: products of nodes do not divide.
pub fn matrix_times(graph: &mut Graph, m: &[Id; 9], v: Vector3) -> Result<Vector3, Error> {
    let mut row = |i: usize| dot(graph, [m[3 * i], m[3 * i + 1], m[3 * i + 2]], v);
    Ok([row(0)?, row(1)?, row(2)?])
}
