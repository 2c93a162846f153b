//! The chapters of the crate use only chapters below them, and every file lies in a chapter or in one of its sections,
//! which are folders. No files of a chapter or section, and of the crates above, use one another in a circle.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// From the lowest to the highest: a chapter may use those before it.
const CHAPTERS: [&str; 13] = [
    "error",
    "interrupt",
    "value",
    "polynomial",
    "kernel",
    "graph",
    "evaluate",
    "print",
    "canonical",
    "tape",
    "calculus",
    "rewrite",
    "linear",
];

/// Files that are not in a folder: the front page, and the errors that every chapter reports.
const OUTSIDE: [&str; 3] = ["lib.rs", "error.rs", "interrupt.rs"];

fn sources() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).expect("a source file")
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let mut paths: Vec<PathBuf> =
        fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    paths
}

/// The files of a folder and of its sections.
fn files_below(folder: &Path) -> Vec<PathBuf> {
    let (sections, mut files): (Vec<PathBuf>, Vec<PathBuf>) =
        entries(folder).into_iter().partition(|path| path.is_dir());
    files.extend(sections.iter().flat_map(|section| files_below(section)));
    files
}

/// The text of a file, or of each file of a section.
fn texts(path: &Path) -> Vec<String> {
    let files = if path.is_dir() { files_below(path) } else { vec![path.to_owned()] };
    files.iter().map(|file| read(file)).collect()
}

fn name(path: &Path) -> &str {
    path.file_name().and_then(|name| name.to_str()).expect("names are text")
}

fn rank(chapter: &str) -> Option<usize> {
    CHAPTERS.iter().position(|known| *known == chapter)
}

/// The modules that the code of a file names after a prefix such as `crate::`; its unit tests may use any.
fn named_after(prefix: &str, text: &str) -> Vec<String> {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    lines
        .flat_map(|line| line.split(prefix).skip(1))
        .map(|path| path.chars().take_while(|&c| is_name(c)).collect())
        .collect()
}

#[test]
fn every_file_lies_in_a_chapter() {
    for path in entries(&sources()) {
        let known = if path.is_dir() { rank(name(&path)).is_some() } else { OUTSIDE.contains(&name(&path)) };
        assert!(known, "{} is neither a chapter nor in one", path.display());
        if path.is_dir() {
            let paragraph = read(&path.join("mod.rs"));
            assert!(paragraph.starts_with("//! "), "{}/mod.rs says what lives there", name(&path));
            assert!(paragraph.contains("nvariant"), "{}/mod.rs states its invariant", name(&path));
        }
    }
}

#[test]
fn chapters_use_only_chapters_below_them() {
    for folder in entries(&sources()).iter().filter(|path| path.is_dir()) {
        for path in files_below(folder) {
            for chapter in named_after("crate::", &read(&path)) {
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

/// The files and sections of a folder, by name, and those among them that each one uses.
fn uses(folder: &Path, prefixes: &[&str]) -> BTreeMap<String, Vec<String>> {
    let files = entries(folder).into_iter();
    let stem =
        |path: &Path| path.file_stem().and_then(|stem| stem.to_str()).expect("names are text").to_owned();
    let mut uses: BTreeMap<String, Vec<String>> = files
        .filter(|path| !["lib", "mod"].contains(&stem(path).as_str()))
        .map(|path| {
            let texts = texts(&path);
            let used =
                texts.iter().flat_map(|text| prefixes.iter().flat_map(|prefix| named_after(prefix, text)));
            (stem(&path), used.collect())
        })
        .collect();
    let known: Vec<String> = uses.keys().cloned().collect();
    for (file, used) in &mut uses {
        used.retain(|other| other != file && known.contains(other));
    }
    uses
}

/// What is left of the files after those that use none of the others have been taken away, again and again.
fn in_circles(mut uses: BTreeMap<String, Vec<String>>) -> Vec<String> {
    loop {
        let left: Vec<String> = uses.keys().cloned().collect();
        uses.retain(|_, used| used.iter().any(|other| left.contains(other)));
        if uses.len() == left.len() {
            return left;
        }
    }
}

#[test]
fn no_files_use_one_another_in_a_circle() {
    for chapter in CHAPTERS.iter().filter(|chapter| !["error", "interrupt"].contains(*chapter)) {
        let (folder, prefix) = (sources().join(chapter), format!("crate::{chapter}::"));
        let found = in_circles(uses(&folder, &["super::", &prefix]));
        assert!(found.is_empty(), "{chapter}: a circle among {found:?}");
        for section in entries(&folder).iter().filter(|path| path.is_dir()) {
            let found = in_circles(uses(section, &["super::"]));
            assert!(found.is_empty(), "{}: a circle among {found:?}", section.display());
        }
    }
    for other in ["integrate", "python"] {
        let found = in_circles(uses(&sources().join("../..").join(other).join("src"), &["crate::"]));
        assert!(found.is_empty(), "{other}: a circle among {found:?}");
    }
}
