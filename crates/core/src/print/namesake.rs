//! Different variables with one name: the reason why a value that was given seems to be missing.

use crate::graph::{Assumption, Graph, Id, View};

/// The most pairs that one message explains.
const SHOWN: usize = 3;

impl Graph {
    /// For each variable that is needed and not given: a given variable with the same name.
    #[must_use]
    pub fn namesakes(&self, needed: &[Id], given: &[Id]) -> Vec<(Id, Id)> {
        let mut pairs: Vec<(Id, Id)> = needed
            .iter()
            .filter(|id| !given.contains(id))
            .filter_map(|&id| Some((id, *given.iter().find(|&&other| self.is_namesake(id, other))?)))
            .collect();
        // A derivative says nothing more than its function.
        let explained: Vec<Id> =
            pairs.iter().filter(|pair| self.plain_name(pair.0).is_some()).map(|pair| pair.1).collect();
        pairs.retain(|pair| self.plain_name(pair.0).is_some() || !explained.contains(&pair.1));
        pairs
    }

    /// Explain how variables that are needed differ from given ones with the same names; `None` if there are none.
    ///
    /// `roles` describe the two in the message, such as "without a value" and "given".
    #[must_use]
    pub fn explain_namesakes(&self, needed: &[Id], given: &[Id], roles: (&str, &str)) -> Option<String> {
        let pairs = self.namesakes(needed, given);
        let explained: Vec<String> =
            pairs.iter().take(SHOWN).filter_map(|&pair| self.explanation(pair, roles)).collect();
        (!explained.is_empty()).then(|| explained.join("; "))
    }

    /// The same for variables that an operation doesn't find in the expressions. It costs nothing where each name
    /// belongs to one variable.
    #[must_use]
    pub fn explain_absent(&self, roots: &[Id], sought: &[Id], roles: (&str, &str)) -> Option<String> {
        let shared: Vec<Id> = sought.iter().copied().filter(|&id| self.shares_name(id)).collect();
        if shared.is_empty() {
            return None;
        }
        let present = self.variables(roots);
        let absent: Vec<Id> = shared.into_iter().filter(|id| !present.contains(id)).collect();
        let left: Vec<Id> = present.into_iter().filter(|id| !sought.contains(id)).collect();
        self.explain_namesakes(&left, &absent, roles)
    }

    fn is_namesake(&self, a: Id, b: Id) -> bool {
        if a == b {
            return false;
        }
        match (self.view(a), self.view(b)) {
            // The rate x' has no symbol x for a variable either.
            (View::TimeFunction(name, ..), View::Symbol(other, _)) => name == other,
            _ => self.plain_name(a).is_some_and(|name| self.plain_name(b) == Some(name)),
        }
    }

    /// The name of a symbol or a function of time, which its derivatives don't have.
    fn plain_name(&self, id: Id) -> Option<&str> {
        match self.view(id) {
            View::Symbol(name, _) | View::TimeFunction(name, 0, _) => Some(name),
            _ => None,
        }
    }

    fn shares_name(&self, id: Id) -> bool {
        self.plain_name(id).is_some_and(|name| self.has_namesakes(name))
    }

    fn explanation(&self, (needed, given): (Id, Id), roles: (&str, &str)) -> Option<String> {
        let ((needed_as, needed_kind), (given_as, given_kind)) =
            (self.constructor(needed)?, self.constructor(given)?);
        let (name, of) = (self.to_text(needed), self.to_text(given));
        let law = if needed_kind && given_kind {
            "a small function of time is not the one that is not small"
        } else if needed_kind == given_kind {
            "symbols with different assumptions are different symbols"
        } else {
            "a symbol is not a function of time"
        };
        Some(format!(
            "the {name} {} is {needed_as}, the {of} {} is {given_as}: {law}; use the same one in both places",
            roles.0, roles.1
        ))
    }

    /// How a user makes a variable, and whether it depends on time.
    fn constructor(&self, id: Id) -> Option<(String, bool)> {
        match self.view(id) {
            View::TimeFunction(name, order, assumption) => {
                let function = format!("functions_of_time('{name}')");
                let function =
                    if assumption == Assumption::Small { format!("small({function})") } else { function };
                Some((if order == 0 { function } else { format!("a derivative of {function}") }, true))
            }
            View::Symbol(name, Assumption::Small) => Some((format!("small(symbols('{name}'))"), false)),
            View::Symbol(name, assumption) => {
                let option = match assumption {
                    Assumption::Positive => ", positive=True",
                    Assumption::Real | Assumption::Small => "",
                    Assumption::None => ", real=False",
                };
                Some((format!("symbols('{name}'{option})"), false))
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn assumptions_make_namesakes_and_derivatives_do_not() {
        let g = &mut Graph::new();
        let (real, positive) = (g.symbol("m", Assumption::Real), g.symbol("m", Assumption::Positive));
        let (motion, rate) = (
            g.time_function("m", 0).expect("few derivatives"),
            g.time_function("m", 1).expect("few derivatives"),
        );
        assert_eq!(g.namesakes(&[real, rate], &[positive, motion]), [(real, positive)]);
        assert!(g.namesakes(&[real], &[real, positive]).is_empty());
    }

    #[test]
    fn absent_variables_are_explained() {
        let g = &mut Graph::new();
        let (real, positive, other) = (
            g.symbol("m", Assumption::Real),
            g.symbol("m", Assumption::Positive),
            g.symbol("k", Assumption::Real),
        );
        let sum = g.add(positive, other);
        assert!(g.explain_absent(&[sum], &[real], ("", "")).is_some());
        assert!(g.explain_absent(&[sum], &[real, positive], ("", "")).is_none());
        assert!(g.explain_absent(&[sum], &[other], ("", "")).is_none());
    }
}
