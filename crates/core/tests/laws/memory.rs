//! The memory budget: a million nodes in less than 150 MB, measured in a process of its own.

use std::env;
use std::fs;
use std::process::Command;

use symbody_core::{Assumption, Error, Function, Graph, Id};

const MEGABYTE: usize = 1_000_000;

/// What the process holds in memory, in bytes; `None` where the system does not tell.
fn resident() -> Option<usize> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmRSS:"))?;
    let kilobytes: usize = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes * 1024)
}

/// One node more: the mixture of a derivation.
fn grow(g: &mut Graph, pool: &[Id], step: u32) -> Result<Id, Error> {
    let at = |offset: usize| pool[(step as usize * 7 + offset * offset * 13) % pool.len()];
    match step % 8 {
        0 => {
            let (angle, turns) = (g.time_function("q", step % 5)?, g.integer(step.into()));
            let argument = g.mul(turns, angle)?;
            g.apply(Function::Sin, &[argument])
        }
        1..=3 => g.mul(at(1), at(2)),
        4 => {
            let sum = g.add(at(1), at(2));
            Ok(g.sub(sum, at(3)))
        }
        5 => g.div(at(1), at(2)),
        _ => Ok(g.add(at(1), at(2))),
    }
}

#[test]
fn a_process_holds_a_million_nodes() {
    let mut tests = Command::new(env::current_exe().expect("the program of these tests"));
    let measured = tests.args(["--exact", "laws::memory::a_million_nodes_fit", "--ignored"]).output();
    let measured = measured.expect("a process of its own");
    let report = String::from_utf8_lossy(&measured.stdout);
    assert!(measured.status.success() && report.contains("1 passed"), "{report}");
}

#[test]
#[ignore = "measures its process: the test above runs it in one of its own"]
fn a_million_nodes_fit() -> Result<(), Error> {
    let before = resident();
    let g = &mut Graph::new();
    let mut pool: Vec<Id> = (0..50).map(|i| g.symbol(&format!("p{i}"), Assumption::Real)).collect();
    let mut step: u32 = 0;
    while g.len() < 1_000_000 {
        let node = grow(g, &pool, step)?;
        step += 1;
        if g.is_constant(node) {
            continue;
        }
        pool[step as usize % 50] = node;
    }
    assert!(g.bytes() < 150 * MEGABYTE, "{} bytes by the graph's own count", g.bytes());
    if let (Some(before), Some(after)) = (before, resident()) {
        let growth = after.saturating_sub(before);
        assert!(
            growth < 150 * MEGABYTE,
            "{growth} bytes by the system's count, {} by the graph's",
            g.bytes()
        );
    }
    Ok(())
}
