//! Piecewise functions: branches that are decided, and conditions without positive factors.

use crate::error::Error;
use crate::graph::{Function, Graph, Id, NumberId};

impl Graph {
    /// Drop the branches whose condition is a number; the first positive one decides. Conditions have no positive factors.
    pub(super) fn decided_piecewise(&mut self, args: &[Id]) -> Result<Option<Id>, Error> {
        let mut kept: Vec<Id> = Vec::new();
        let mut otherwise = args[args.len() - 1];
        for pair in args[..args.len() - 1].chunks_exact(2) {
            let condition = self.decided(pair[1]);
            match self.as_number(condition) {
                Some(number) if number.is_zero() || number.is_negative() => {}
                None if !self.is_positive(condition) => {
                    kept.extend([pair[0], self.without_positive_number(pair[1])]);
                }
                _ => {
                    otherwise = pair[0];
                    break;
                }
            }
        }
        while kept.len() >= 2 && kept[kept.len() - 2] == otherwise {
            kept.truncate(kept.len() - 2);
        }
        kept.push(otherwise);
        Ok(match kept[..] {
            [single] => Some(single),
            _ if kept == args => None,
            _ => Some(self.apply(Function::Piecewise, &kept)?),
        })
    }

    /// The node of which a condition is a positive multiple.
    fn without_positive_number(&mut self, condition: Id) -> Id {
        let (factor, node) = self.split_multiple(NumberId::ONE, condition);
        if self.get_number(factor).is_negative() { self.scale(NumberId::MINUS_ONE, node) } else { node }
    }
}
