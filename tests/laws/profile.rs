//! The profile of the random cases: the same cases in every run, failures kept.

use std::cell::RefCell;
use std::path::Path;

use proptest::prelude::*;
use proptest::test_runner::{FileFailurePersistence, RngSeed, TestRunner};

use crate::common::{divisor, profile};

fn drawn(profile: &ProptestConfig) -> Vec<u64> {
    let cases = RefCell::new(Vec::new());
    let few = ProptestConfig { cases: 20, failure_persistence: None, ..profile.clone() };
    let keep = |case| {
        cases.borrow_mut().push(case);
        Ok(())
    };
    TestRunner::new(few).run(&any::<u64>(), keep).unwrap();
    cases.into_inner()
}

#[test]
fn every_run_draws_the_same_cases() {
    let profile = profile();
    assert!(matches!(profile.rng_seed, RngSeed::Fixed(_)), "{:?}", profile.rng_seed);
    let cases = drawn(&profile);
    assert_eq!(cases, drawn(&profile));
    assert_ne!(cases, drawn(&ProptestConfig { rng_seed: RngSeed::Fixed(1), ..profile }));
}

#[test]
fn there_are_two_thousand_cases_by_default() {
    let asked =
        std::env::var("PROPTEST_CASES").map_or(2000 / divisor(), |count| count.parse().unwrap());
    assert_eq!(profile().cases as usize, asked);
}

#[test]
fn the_seed_of_a_failure_is_kept_in_a_file_of_the_repository() {
    let kept = profile().failure_persistence.unwrap();
    let Some(FileFailurePersistence::Direct(path)) = kept.as_any().downcast_ref() else {
        unreachable!("{kept:?} is no file")
    };
    assert!(Path::new(path).ends_with("tests/regressions.txt") && Path::new(path).exists());
}
