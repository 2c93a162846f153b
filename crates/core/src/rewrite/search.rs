//! The state of one simplification: its work, and the forms that it has found.
//!
//! A form that another simplification found costs the work that finding it again would cost, for itself and for the parts
//! that this search has not met. So no result depends on what was simplified before. A form that was found when the work
//! was used up is not the simplest one, and is kept for this search only.

use rustc_hash::FxHashMap;

use crate::graph::{Graph, Id, Part, SimplestForm};
use crate::polynomial::Budget;

pub(super) struct Search {
    pub(super) work: Budget,
    /// The results so far, by part and by the levels of coefficients that were open to it.
    known: FxHashMap<Part, Id>,
    /// The parts that the part at hand has asked for, and the work for them.
    others: Vec<Part>,
    work_of_others: usize,
}

/// What is put aside while a part is simplified.
pub(super) struct Frame {
    others: Vec<Part>,
    work_of_others: usize,
    left: usize,
}

impl Search {
    pub(super) fn new(work: usize) -> Self {
        Self {
            work: Budget::new(usize::MAX, work),
            known: FxHashMap::default(),
            others: Vec::new(),
            work_of_others: 0,
        }
    }

    /// The form of a part, if it is known.
    pub(super) fn known(&mut self, graph: &Graph, part: Part) -> Option<Id> {
        if !self.known.contains_key(&part) {
            self.recall(graph, part)?;
        }
        self.others.push(part);
        self.known.get(&part).copied()
    }

    /// Take over a form that an earlier search found, and those of its parts, if the work for all of them is left.
    fn recall(&mut self, graph: &Graph, part: Part) -> Option<()> {
        let mut found: Vec<Part> = Vec::new();
        let (mut work, left) = (0_usize, self.work.left());
        let mut open = vec![part];
        while let Some(part) = open.pop() {
            if self.known.contains_key(&part) {
                continue;
            }
            let Some(form) = graph.simplest_forms.get(&part).filter(|form| work + form.work < left) else {
                for part in found {
                    self.known.remove(&part);
                }
                return None;
            };
            self.known.insert(part, form.form);
            found.push(part);
            work += form.work;
            open.extend(&form.others);
        }
        self.work_of_others += work;
        self.work.spend(work).ok()
    }

    /// Begin with a part.
    pub(super) fn begin(&mut self) -> Frame {
        let others = std::mem::take(&mut self.others);
        let work_of_others = std::mem::take(&mut self.work_of_others);
        Frame { others, work_of_others, left: self.work.left() }
    }

    /// Note the form of a part.
    pub(super) fn end(&mut self, graph: &mut Graph, frame: Frame, part: Part, form: Id) {
        let left = self.work.left();
        let all = frame.left - left;
        let others = std::mem::replace(&mut self.others, frame.others);
        if left > 0 {
            let work = all - self.work_of_others;
            graph.simplest_forms.insert(part, SimplestForm { form, work, others });
        }
        self.work_of_others = frame.work_of_others + all;
        self.known.insert(part, form);
        self.others.push(part);
    }
}
