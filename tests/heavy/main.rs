//! The topics of `tests/it` that have thousands of cases, with all of them, and drawings with thousands of lines over one
//! another: some minutes, for `.ci/run`. A feature asks for
//! them, `cargo test --features heavy`, and no variable of the environment: without it they are not even built, which would
//! take as long as they do.

#[cfg(feature = "heavy")]
mod crowded;
#[cfg(feature = "heavy")]
#[path = "../it/damaged.rs"]
mod damaged;
#[cfg(feature = "heavy")]
#[path = "../it/entries.rs"]
mod entries;
#[cfg(feature = "heavy")]
#[path = "../it/motion.rs"]
mod motion;
#[cfg(feature = "heavy")]
mod nests;
#[cfg(feature = "heavy")]
mod patience;
#[cfg(feature = "heavy")]
#[path = "../it/properties/mod.rs"]
mod properties;
#[cfg(feature = "heavy")]
mod slow;
#[cfg(feature = "heavy")]
#[path = "../it/support/mod.rs"]
#[expect(dead_code, reason = "no page is read here, and the program is not run")]
mod support;
#[cfg(feature = "heavy")]
#[path = "../it/threads.rs"]
mod threads;
#[cfg(feature = "heavy")]
#[path = "../it/verifier/mod.rs"]
mod verifier;

/// Every case is tried.
#[cfg(feature = "heavy")]
const ONE_IN: usize = 1;

/// Written to the handle: what a test prints otherwise is not shown when it passes.
#[cfg(not(feature = "heavy"))]
#[test]
fn the_long_tests_are_left_out_and_said_to_be() {
    let line = b"skipped: the long tests; `cargo test --features heavy` runs them\n";
    std::io::Write::write_all(&mut std::io::stderr(), line).expect("standard error is open");
}
