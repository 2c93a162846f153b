//! The rational number that has given values in several lanes.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::lane::FieldId;
use super::number::Number;
use super::quadratic::Quadratic;

/// The bits by which a number is shorter than what any values would give: others are found with a probability of 2^-this.
const SPARE: u64 = 128;

/// The number with these values in lanes, if there is one of far fewer digits than all values have together.
pub(crate) fn likely_number(values: impl Iterator<Item = (FieldId, Quadratic)>) -> Option<Number> {
    let (mut modulus, mut residue) = (BigInt::one(), BigInt::zero());
    for (field, value) in values {
        let Quadratic::Real(word) = value else { return None };
        let prime = field.field().prime();
        let p = BigInt::from(prime.p);
        let steps = ((prime.residue(word) - &residue) * modulus.modinv(&p)?).mod_floor(&p);
        residue += &modulus * steps;
        modulus *= p;
    }
    short_fraction(modulus, residue)
}

/// The fraction that a residue is, by the algorithm of Euclid [von zur Gathen & Gerhard 2013, sec. 5.10].
fn short_fraction(modulus: BigInt, residue: BigInt) -> Option<Number> {
    let largest = BigInt::one() << (modulus.bits().checked_sub(SPARE)? / 2);
    let (mut r, mut t) = ((modulus, residue), (BigInt::zero(), BigInt::one()));
    while r.1 > largest {
        let quotient = &r.0 / &r.1;
        (r.1, r.0) = (r.0 - &quotient * &r.1, r.1);
        (t.1, t.0) = (t.0 - quotient * &t.1, t.1);
    }
    if t.1.abs() > largest { None } else { Number::from_big(r.1, t.1).ok() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_many_digits_are_found_and_other_values_are_none() {
        let digits: BigInt = num_traits::Pow::pow(BigInt::from(10), 200u32) + 3;
        let number = Number::from_big(-digits.clone(), digits + 4).expect("a quotient");
        let fields = || FieldId::others(0).take(32);
        let values = fields().map(|field| (field, field.field().number(&number)));
        assert_eq!(likely_number(values), Some(number));
        let key = super::super::key::Key::new("any value");
        assert_eq!(likely_number(fields().map(|field| (field, field.draw(&key)))), None);
    }
}
