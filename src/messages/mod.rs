//! docs/errors.md: every message of the library, with what triggers it and what to do.
//!
//! Each table is made of values of one type, printed. The patterns beside the values are those of a
//! match without a wildcard: a new variant does not compile without a row. With IRBKIN_WRITE=1
//! (`make errors`) the page is written.

mod kinematics;
mod motion;
mod plan;
mod rapid;
mod urdf;

use std::fmt::Write as _;
use std::path::Path;
use std::string::String;
use std::vec::Vec;

/// A message, what triggers it, and what to do.
struct Row {
    message: String,
    trigger: &'static str,
    remedy: &'static str,
}

/// A section of the page.
struct Table {
    /// Name of the marker in the page.
    name: &'static str,
    rows: Vec<Row>,
}

/// Rows of values of a type. Every variant has a pattern, and each value matches its own.
macro_rules! rows {
    ($type:ty; $($pattern:pat => $example:expr, $trigger:literal, $remedy:literal;)+) => {{
        #[allow(unreachable_patterns, reason = "a variant may have several messages")]
        fn has_every_variant(value: &$type) {
            match value {
                $($pattern => {})+
            }
        }
        std::vec![$({
            let example: $type = $example;
            has_every_variant(&example);
            assert!(matches!(&example, $pattern), "{example}");
            $crate::messages::Row {
                message: std::string::ToString::to_string(&example),
                trigger: $trigger,
                remedy: $remedy,
            }
        }),+]
    }};
}
use rows;

fn printed(rows: &[Row]) -> String {
    let mut table = String::from("| message | comes from | what to do |\n|---|---|---|\n");
    // What has no remedy is that of another table, which the trigger names.
    for Row { message, trigger, remedy } in rows.iter().filter(|row| !row.remedy.is_empty()) {
        let message = message.replace('|', "\\|").replace('\n', " ");
        let _ = writeln!(table, "| `{message}` | {trigger} | {remedy} |");
    }
    table
}

#[test]
fn the_page_of_messages_has_every_message_as_it_is_printed() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/errors.md");
    let page = std::fs::read_to_string(&path).unwrap();
    let mut made = page.clone();
    for Table { name, rows } in kinematics::tables()
        .into_iter()
        .chain(motion::tables())
        .chain(plan::tables())
        .chain(urdf::tables())
        .chain(rapid::tables())
    {
        let start = std::format!("<!-- {name}: written by make errors -->\n");
        let (before, rest) = made.split_once(&start).unwrap();
        let (_, after) = rest.split_once("<!-- end -->").unwrap();
        made =
            std::format!("{before}{start}\n{table}\n<!-- end -->{after}", table = printed(&rows));
    }
    if std::env::var("IRBKIN_WRITE").is_ok_and(|write| write == "1") {
        std::fs::write(&path, made).unwrap();
    } else {
        assert!(page == made, "docs/errors.md is not what is printed: make errors writes it");
    }
}
