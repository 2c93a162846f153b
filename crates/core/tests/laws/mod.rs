//! Tests of the crate from outside, as other crates see it. They are a module of its own tests, so that `cargo test`
//! compiles the crate once.

mod chapters;
mod depth;
mod factorization;
mod first_example;
mod limits;
mod matrix;
mod memory;
mod positive_definite;
mod print;
mod rewrites;
mod simplify;
mod solve;
mod tape;

#[test]
fn the_example_of_the_front_page_holds() -> Result<(), symbody_core::Error> {
    first_example::equal_mathematics_has_one_value()
}
