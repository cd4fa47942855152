//! Tests that cannot run on this machine report it: the harness cannot skip at run time.

use std::fs::OpenOptions;
use std::io::{Write, stderr};

/// Reports a test as skipped, past the harness's capture, and in the file that `IRBKIN_SKIPPED`
/// names, from which `make test` prints and counts them. The caller returns.
pub fn skip(test: &str, reason: &str) {
    let line = format!("skipped: {test}: {reason}\n");
    stderr().write_all(line.as_bytes()).unwrap();
    if let Ok(path) = std::env::var("IRBKIN_SKIPPED") {
        let mut file = OpenOptions::new().create(true).append(true).open(path).unwrap();
        file.write_all(line.as_bytes()).unwrap();
    }
}
