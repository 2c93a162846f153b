//! The chapters of the crate use only chapters below them, and every file lies in a chapter.

use std::fs;
use std::path::{Path, PathBuf};

/// From the lowest to the highest: a chapter may use those before it.
const CHAPTERS: [&str; 11] = [
    "error",
    "value",
    "polynomial",
    "kernel",
    "graph",
    "print",
    "canonical",
    "calculus",
    "rewrite",
    "linear",
    "tape",
];

/// Files that are not in a folder: the front page, and the errors that every chapter reports.
const OUTSIDE: [&str; 2] = ["lib.rs", "error.rs"];

fn sources() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let mut paths: Vec<PathBuf> =
        fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    paths
}

fn name(path: &Path) -> &str {
    path.file_name().and_then(|name| name.to_str()).expect("names are text")
}

fn rank(chapter: &str) -> Option<usize> {
    CHAPTERS.iter().position(|known| *known == chapter)
}

/// The chapters that the code of a file names after `crate::`; its unit tests may use any.
fn used(text: &str) -> Vec<String> {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    lines
        .flat_map(|line| line.split("crate::").skip(1))
        .map(|path| path.chars().take_while(|&c| is_name(c)).collect())
        .collect()
}

#[test]
fn every_file_lies_in_a_chapter() {
    for path in entries(&sources()) {
        let known = if path.is_dir() { rank(name(&path)).is_some() } else { OUTSIDE.contains(&name(&path)) };
        assert!(known, "{} is neither a chapter nor in one", path.display());
        if path.is_dir() {
            let paragraph = fs::read_to_string(path.join("mod.rs")).expect("a chapter has a mod.rs");
            assert!(paragraph.starts_with("//! "), "{}/mod.rs says what lives there", name(&path));
            assert!(paragraph.contains("nvariant"), "{}/mod.rs states its invariant", name(&path));
        }
    }
}

#[test]
fn chapters_use_only_chapters_below_them() {
    for folder in entries(&sources()).iter().filter(|path| path.is_dir()) {
        for path in entries(folder) {
            for chapter in used(&fs::read_to_string(&path).expect("a source file")) {
                let below = rank(&chapter).expect("paths begin with a chapter");
                assert!(
                    below < rank(name(folder)).expect("a chapter") || chapter == name(folder),
                    "{} uses {chapter}, which is above {}",
                    path.display(),
                    name(folder)
                );
            }
        }
    }
}
