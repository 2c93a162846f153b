//! Expressions as linear forms in unknowns: constant + sum of coefficient * unknown.

use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

use crate::error::Error;
use crate::graph::{ByValue, Graph, Id, NumberId, View};

/// constant + sum of coefficient * unknown, with the unknowns by number; no coefficient is zero.
#[derive(Clone)]
pub(super) struct LinearForm {
    pub constant: Id,
    pub coefficients: BTreeMap<usize, Id>,
}

/// The nodes that depend on an unknown: their forms, or `None` where they are not linear as written.
type Forms = FxHashMap<Id, Option<LinearForm>>;

impl Graph {
    /// The equations as linear forms in the unknowns.
    ///
    /// # Errors
    /// If an unknown is not a variable, or an equation is not linear in one.
    pub(super) fn linear_forms(
        &mut self,
        equations: &[Id],
        unknowns: &[Id],
    ) -> Result<Vec<LinearForm>, Error> {
        let mut numbers: ByValue<usize> = ByValue::default();
        for (number, &unknown) in unknowns.iter().enumerate() {
            if !self.is_variable(unknown) {
                return Err(Error::NotAVariable(self.to_quotation(unknown)));
            }
            numbers.push(self.value(unknown), unknown, number);
        }
        let mut forms = Forms::default();
        for id in self.post_order_where(equations, |_| true) {
            let form = match self.find(&numbers, id) {
                Some(&number) => {
                    let coefficients = BTreeMap::from([(number, Id::ONE)]);
                    Some(LinearForm { constant: Id::ZERO, coefficients })
                }
                None if !self.children(id).iter().any(|child| forms.contains_key(child)) => continue,
                None => self.form_of(id, &forms)?,
            };
            forms.insert(id, form);
        }
        equations.iter().map(|&equation| self.form_of_equation(equation, unknowns, &forms)).collect()
    }

    fn form_of_equation(
        &mut self,
        equation: Id,
        unknowns: &[Id],
        forms: &Forms,
    ) -> Result<LinearForm, Error> {
        match forms.get(&equation) {
            Some(Some(form)) => Ok(form.clone()),
            Some(None) => self.form_by_derivatives(equation, unknowns),
            None => Ok(LinearForm { constant: equation, coefficients: BTreeMap::new() }),
        }
    }

    /// The form of a node from those of its children.
    fn form_of(&mut self, id: Id, forms: &Forms) -> Result<Option<LinearForm>, Error> {
        match self.view(id) {
            View::Scale(factor, child) => {
                let terms = [(factor, child)];
                Ok(self.form_of_sum(&terms, forms))
            }
            View::Sum(terms) => {
                let terms: Vec<_> = terms.iter().collect();
                Ok(self.form_of_sum(&terms, forms))
            }
            View::Product(factors) => {
                let factors: Vec<_> = factors.iter().collect();
                self.form_of_product(&factors, forms)
            }
            _ => Ok(None),
        }
    }

    fn form_of_sum(&mut self, terms: &[(NumberId, Id)], forms: &Forms) -> Option<LinearForm> {
        let mut constants = Vec::new();
        let mut coefficients: BTreeMap<usize, Vec<(NumberId, Id)>> = BTreeMap::new();
        for &(factor, node) in terms {
            let Some(form) = forms.get(&node) else {
                constants.push((factor, node));
                continue;
            };
            let form = form.as_ref()?;
            constants.push((factor, form.constant));
            for (&number, &coefficient) in &form.coefficients {
                coefficients.entry(number).or_default().push((factor, coefficient));
            }
        }
        let constant = self.sum(&constants);
        let sums = coefficients.into_iter().map(|(number, terms)| (number, self.sum(&terms)));
        let coefficients = sums.filter(|&(_, sum)| sum != Id::ZERO).collect();
        Some(LinearForm { constant, coefficients })
    }

    /// One factor may depend on the unknowns, and only in its first power.
    fn form_of_product(
        &mut self,
        factors: &[(Id, NumberId)],
        forms: &Forms,
    ) -> Result<Option<LinearForm>, Error> {
        let (dependent, rest): (Vec<_>, Vec<_>) =
            factors.iter().copied().partition(|(base, _)| forms.contains_key(base));
        let [(base, NumberId::ONE)] = dependent[..] else { return Ok(None) };
        let Some(form) = &forms[&base] else { return Ok(None) };
        let rest = self.product(&rest)?;
        let mut coefficients = BTreeMap::new();
        for (&number, &coefficient) in &form.coefficients {
            coefficients.insert(number, self.mul(rest, coefficient)?);
        }
        Ok(Some(LinearForm { constant: self.mul(rest, form.constant)?, coefficients }))
    }

    /// The form of an equation that is not linear as written: the values of its derivatives decide.
    fn form_by_derivatives(&mut self, equation: Id, unknowns: &[Id]) -> Result<LinearForm, Error> {
        let mut coefficients = BTreeMap::new();
        for (number, &unknown) in unknowns.iter().enumerate() {
            let slope = self.partial_derivatives(&[equation], unknown)?[0];
            // A slope that has a pole where the unknowns are zero depends on them.
            let coefficient = self.without(slope, unknowns).ok();
            let Some(coefficient) = coefficient.filter(|&coefficient| self.equal(slope, coefficient)) else {
                let (equation, unknown) = (self.to_quotation(equation), self.to_quotation(unknown));
                return Err(Error::NotLinear { equation, unknown });
            };
            if coefficient != Id::ZERO {
                coefficients.insert(number, coefficient);
            }
        }
        Ok(LinearForm { constant: self.without(equation, unknowns)?, coefficients })
    }

    /// The expression where the unknowns are zero; their derivatives are other variables and stay.
    fn without(&mut self, root: Id, unknowns: &[Id]) -> Result<Id, Error> {
        let mut rebuilt: FxHashMap<Id, Id> = FxHashMap::default();
        for id in self.post_order_where(&[root], |_| true) {
            let result = if unknowns.iter().any(|&unknown| self.same(unknown, id)) {
                Id::ZERO
            } else {
                self.rebuild(id, &|_: &Self, child| rebuilt[&child])?
            };
            rebuilt.insert(id, result);
        }
        Ok(rebuilt[&root])
    }
}
