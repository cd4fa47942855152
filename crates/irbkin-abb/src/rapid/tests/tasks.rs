//! Tasks of a controller that wait for each other.

use std::format;
use std::string::String;
use std::time::{Duration, Instant};
use std::vec::Vec;

use crate::rapid::{CheckOptions, Code, Module, Severity, check, read};
use irbkin_motion::Arm;

const POINTS: &str = "PERS tasks both{2}:=[[\"T_ROB1\"],[\"T_ROB2\"]];
    PERS tasks none{0}:=[]; VAR syncident a; VAR syncident b; VAR syncident c; VAR bool f;";

fn program(body: &str) -> String {
    format!("MODULE M {POINTS} PROC main() {body} ENDPROC ENDMODULE")
}

/// The findings on the first of some tasks, T_ROB1 and so on, by severity and in words.
fn found_whole(texts: &[&str], is_whole: Option<bool>) -> Vec<(Severity, String)> {
    let arm = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    let modules: Vec<Module> = texts.iter().map(|text| read(text, &[])).collect();
    let names: Vec<String> = (1..=texts.len()).map(|it| format!("T_ROB{it}")).collect();
    let given = |it: &'_ usize| !texts[*it].is_empty();
    let tasks = (0..texts.len()).map(|it| {
        (names[it].as_str(), Some(it).filter(given).map(|it| &modules[it]).into_iter().collect())
    });
    let tasks: Vec<_> = tasks.collect();
    let codes = Some(&[Code::SyncDeadlock][..]);
    let options = CheckOptions { tasks: &tasks, is_whole, codes, ..Default::default() };
    let found = check(&arm, &[(&modules[0], texts[0])], &options).unwrap().findings;
    found.into_iter().map(|it| (it.severity(), it.message)).collect()
}

fn found(texts: &[&str]) -> Vec<(Severity, String)> {
    found_whole(texts, Some(true))
}

/// The findings on the first of two tasks with these statements in `main`.
fn found_in(own: &str, other: &str) -> Vec<(Severity, String)> {
    found(&[&program(own), &program(other)])
}

#[test]
fn tasks_that_meet_in_one_order_have_no_finding() {
    let meet = "ENDPROC PROC meet(VAR syncident s, PERS tasks t{*}) WaitSyncTask s,t;";
    for (own, other) in [
        ("WaitSyncTask a,both; WaitSyncTask b,both;", "WaitSyncTask a,both; WaitSyncTask b,both;"),
        ("WHILE TRUE DO WaitSyncTask a,both; ENDWHILE", "WaitSyncTask\\InPos,A,Both;"),
        ("SyncMoveOn a,both; SyncMoveOff b;", "go; ENDPROC PROC go() SyncMoveOn a,both;"),
        ("WaitSyncTask a,none;", ""),
        ("WaitSyncTask c,both\\TimeOut:=2;", ""),
        ("meet a,both;", "meet a,both; ENDPROC PROC meet(VAR syncident s, PERS tasks t{*})"),
        (&format!("meet a,both; {meet}"), &format!("meet a,both; {meet}")),
        // A call with a calculated name, and an unknown order.
        (
            "WaitSyncTask a,both; WaitSyncTask b,both;",
            "%\"r\"+\"Go\"%; ENDPROC PROC rGo() \
            IF f THEN WaitSyncTask a,both; ENDIF WaitSyncTask b,both;",
        ),
        // The list may be another one.
        ("both{2}.taskname:=\"T_ROB3\"; WaitSyncTask a,both;", ""),
        ("WaitSyncTask a,both;", "set both; ENDPROC PROC set(PERS tasks t{*})"),
        // The program may have other parts.
        ("WaitSyncTask a,both;", "Load \\Dynamic,\"HOME:/more.mod\";"),
    ] {
        assert_eq!(found_in(own, other), [], "{own} {other}");
    }
    // A task without a program, and one whose list has other tasks.
    assert_eq!(found(&[&program("WaitSyncTask a,both;"), ""]), []);
    let others = program("").replace("T_ROB1", "T_ROB3");
    assert_eq!(found(&[&program("WaitSyncTask a,both;"), &others]), []);
}

#[test]
fn a_point_that_a_task_never_meets_is_found() {
    let [(severity, words)] = &found_in("WaitSyncTask a,both;", "WaitSyncTask b,both;")[..] else {
        panic!()
    };
    let wanted = "WaitSyncTask a,both: T_ROB2 of its list never waits there";
    assert_eq!((*severity, words.as_str()), (Severity::Error, wanted));
    let alone = found(&[&program("WaitSyncTask a,both;")]);
    assert!(alone[0].1.ends_with("T_ROB2 of its list is no task of the controller"));
    // What a run need not reach, or what is not known whole, is a warning.
    let branch = found_in("IF f THEN SyncMoveOn a,both; ENDIF", "");
    assert!(
        branch[0].0 == Severity::Warning
            && branch[0].1.contains("(with all files loaded, and a run that gets here)")
    );
    let part = found_whole(&[&program("WaitSyncTask a,both;"), &program("")], None);
    assert!(part[0].0 == Severity::Warning && part[0].1.contains("(with all files loaded, and"));
}

#[test]
fn tasks_that_wait_for_each_other_are_found() {
    let own = "WaitSyncTask a,both;\nWaitSyncTask b,both;";
    let other = "go; WaitSyncTask a,both; ENDPROC PROC go() WaitSyncTask b,both;";
    let [(severity, words)] = &found_in(own, other)[..] else { panic!() };
    let wanted = "WaitSyncTask a,both: T_ROB2 waits for others before, in line 2 of M";
    assert_eq!((*severity, words.as_str()), (Severity::Error, wanted));
    // Nothing is certain behind a jump or in a branch, or of points that are met twice.
    for other in [
        "GOTO on; on: WaitSyncTask b,both; WaitSyncTask a,both;",
        "IF f RETURN; WaitSyncTask b,both; WaitSyncTask a,both;",
        "IF f THEN WaitSyncTask b,both; ENDIF WaitSyncTask a,both;",
        "WaitSyncTask b,both; WaitSyncTask a,both; WaitSyncTask b,both;",
        "go; WaitSyncTask a,both; go; ENDPROC PROC go() WaitSyncTask b,both;",
        "WaitSyncTask b,both\\TimeOut:=1; WaitSyncTask a,both;",
        "%\"r\"+text%; WaitSyncTask b,both; WaitSyncTask a,both;",
    ] {
        assert_eq!(found_in(own, other), [], "{other}");
    }
}

#[test]
fn three_tasks_that_wait_in_a_circle_are_found_in_each() {
    let lists = "PERS tasks l12{2}:=[[\"T_ROB1\"],[\"T_ROB2\"]]; PERS tasks l23{2}:=[[\"T_ROB2\"],
        [\"T_ROB3\"]]; PERS tasks l31{2}:=[[\"T_ROB3\"],[\"T_ROB1\"]]; VAR syncident a;";
    let text = |body: &str| format!("MODULE M {lists} PROC main() {body} ENDPROC ENDMODULE");
    let one = text("WaitSyncTask a,l12; WaitSyncTask c,l31;");
    let two = text("WaitSyncTask b,l23; WaitSyncTask a,l12;");
    let three = text("WaitSyncTask c,l31; WaitSyncTask b,l23;");
    let all = found(&[&one, &two, &three]);
    assert!(all.len() == 1 && all[0].1.contains("T_ROB2 waits for others before"), "{all:?}");
    // In another order they meet.
    let two = text("WaitSyncTask a,l12; WaitSyncTask b,l23;");
    let three = text("WaitSyncTask b,l23; WaitSyncTask c,l31;");
    assert_eq!(found(&[&one, &two, &three]), []);
}

#[test]
fn many_points_and_routines_are_compared_in_time() {
    let many = |from: usize, step: &str| -> String {
        let waits = (0..400).map(|it| format!("{step} s{},both;\n", (it + from) % 400));
        waits.collect::<Vec<_>>().concat()
    };
    let (one, two) = (program(&many(0, "WaitSyncTask")), program(&many(1, "WaitSyncTask")));
    let begin = Instant::now();
    assert_eq!(found(&[&one, &two]).len(), 1);
    let routines: Vec<_> =
        (0..1500).map(|it| format!("ENDPROC PROC r{it}() r{}; ", it + 1)).collect();
    let deep = program(&format!("WaitSyncTask a,both; r0; {}", routines.concat()));
    assert_eq!(found(&[&deep, &deep]), []);
    assert!(begin.elapsed() < Duration::from_secs(20), "{:?}", begin.elapsed());
}
