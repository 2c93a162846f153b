//! Rewriting from the innermost parts outwards, outside any derivation.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

use rustc_hash::{FxHashMap, FxHashSet};

use crate::error::Error;
use crate::graph::{Graph, Id, View};
use crate::value::Number;

impl Graph {
    /// Run a rewrite outside the derivation in progress, so that the result keeps the form that the rewrite makes.
    pub(super) fn choose_form<T>(&mut self, rewrite: impl FnOnce(&mut Self) -> T) -> T {
        let classes = self.leave();
        let result = catch_unwind(AssertUnwindSafe(|| rewrite(self))); // also if the work is interrupted
        if let Some(classes) = classes {
            self.enter(classes);
        }
        result.unwrap_or_else(|payload| resume_unwind(payload))
    }

    /// Rewrite the parts that `find` returns from the innermost outwards, and the root last.
    pub(crate) fn inside_out(
        &mut self,
        root: Id,
        find: impl Fn(&Self, Id, &mut FxHashSet<Id>),
        rewrite: &mut impl FnMut(&mut Self, Id) -> Result<Id, Error>,
    ) -> Result<Id, Error> {
        let order = self.post_order(&[root]);
        let mut enclosed: FxHashSet<Id> = FxHashSet::default();
        enclosed.insert(root);
        for &id in &order {
            find(self, id, &mut enclosed);
        }
        let mut map: FxHashMap<Id, Id> = FxHashMap::default();
        for id in order {
            let children = self.children(id);
            let changed = children.iter().any(|child| map.get(child) != Some(child));
            let lookup = |_: &Self, child: Id| map[&child];
            let mut forms = vec![id];
            if changed {
                forms.push(self.rebuild(id, &lookup)?);
            }
            if enclosed.contains(&id) && !children.is_empty() {
                forms.push(rewrite(self, forms[forms.len() - 1])?);
            }
            // The lanes must prove each step: functions nested deeper than the tower of fields, and some roots, have
            // drawn values there (docs/values.md).
            let is_same = |form: &Id| self.same(*form, id);
            let last = forms.into_iter().rfind(is_same).expect("the node itself is the first form");
            map.insert(id, last);
        }
        Ok(map[&root])
    }

    /// The children of a node that are not part of its polynomial: arguments, divisors, radicands.
    pub(super) fn push_enclosed(&self, id: Id, out: &mut FxHashSet<Id>) {
        match self.view(id) {
            View::Function(_, args) | View::Application { args, .. } => out.extend(args.iter()),
            View::Product(factors) => {
                let is_natural = |e| {
                    let e: &Number = self.get_number(e);
                    e.is_integer() && !e.is_negative()
                };
                out.extend(factors.iter().filter(|&(_, e)| !is_natural(e)).map(|(base, _)| base));
            }
            _ => {}
        }
    }

    /// Also the sums among the factors of a product.
    pub(super) fn push_enclosed_or_factors(&self, id: Id, out: &mut FxHashSet<Id>) {
        self.push_enclosed(id, out);
        if let View::Product(factors) = self.view(id) {
            out.extend(factors.iter().map(|(base, _)| base));
        }
    }
}
