//! Messages of RAPID.

use std::vec;
use std::vec::Vec;

use super::{Row, Table, rows};
use crate::error::{FrameFault, Missing, PoseFault, RapidFault, RapidFaultKind, RoutineFault};
use crate::kinematics::{BreakReason, SingularityKind};
use crate::rapid::{
    AssignedBy, CirPathMode, Finding, FindingKind, NotRead, Problem, Reason, Unresolved,
};
use crate::report::{Configuration, Explanation, Reach};

pub(super) fn tables() -> Vec<Table> {
    vec![
        Table { name: "rapid", rows: faults() },
        Table { name: "rapid frames", rows: frames() },
        Table { name: "rapid problems", rows: problems() },
        Table { name: "rapid findings", rows: findings() },
        Table { name: "rapid reasons", rows: reasons() },
        Table { name: "rapid skipped", rows: skipped() },
    ]
}

fn broken_text() -> Vec<Row> {
    use RapidFaultKind as Kind;
    rows! { RapidFault;
        RapidFault { .. } => RapidFault {
            line: 1,
            column: 12,
            kind: Kind::Unexpected { found: "the end of the text".into(), wanted: "a semicolon" },
        },
            "`parse(\"hello world\")`: text that is not RAPID",
            "mend the place; `load` takes a path";
    }
}

fn faults() -> Vec<Row> {
    use RapidFaultKind as Kind;
    let [thing, part] = ["robtarget p10", "robconf"].map(std::string::String::from);
    let mut all = broken_text();
    all.extend(rows! { RapidFaultKind;
        Kind::UnterminatedString => Kind::UnterminatedString,
            "a string over two lines", "close it on its line";
        Kind::BadNumber { .. } => Kind::BadNumber { text: "1.2.3".into() },
            "a word that begins as a number", "mend it";
        Kind::NotFinite { .. } => Kind::NotFinite { text: "1e999".into() },
            "a number beyond 1.8e308", "write a smaller one";
        Kind::UnexpectedCharacter { .. } => Kind::UnexpectedCharacter { character: '#' },
            "a character that RAPID does not have", "remove it";
        Kind::Unclosed { .. } => Kind::Unclosed { bracket: '[' },
            "a bracket without its partner", "close it";
        Kind::Unexpected { .. } =>
            Kind::Unexpected { found: "ENDMODULE".into(), wanted: "ENDPROC" },
            "a text that is cut off, or not RAPID", "mend the place";
        Kind::UnexpectedEnd { .. } =>
            Kind::UnexpectedEnd { inside: "PROC main".into(), missing: "ENDPROC" },
            "a text that is cut off", "add what is missing";
        Kind::ComponentCount { .. } => Kind::ComponentCount {
            thing: thing.clone(), part: part.clone(), found: 3, wanted: 4,
        },
            "a record with another number of components", "add or remove components";
        Kind::ComponentType { .. } => Kind::ComponentType {
            thing: thing.clone(), part: part.clone(), found: "TRUE".into(), wanted: "a number",
        },
            "a value of another type", "write one of the type";
        Kind::NotWhole { .. } =>
            Kind::NotWhole { thing: thing.clone(), part, value: 0.5 },
            "confdata", "write whole numbers";
        Kind::NoSuchComponent { .. } => Kind::NoSuchComponent {
            text: "p10.tran".into(), of: "robtarget", component: "tran".into(),
        },
            "a misspelt component", "write `trans`, `rot`, ...";
        Kind::ArraySize { .. } =>
            Kind::ArraySize { thing: thing.clone(), dimension: 1, found: 2, wanted: 3 },
            "an array whose value has another size", "make both agree";
        Kind::ArrayDimension { .. } =>
            Kind::ArrayDimension { thing: thing.clone(), dimension: 1, value: 0.0 },
            "the size of an array", "give a whole number from 1 on";
        Kind::Dimensions { .. } =>
            Kind::Dimensions { thing: thing.clone(), found: 4, bound: 3 },
            "an array of more than three dimensions", "use fewer";
        Kind::Index { .. } => Kind::Index { text: "p{5}".into(), value: 5.0, size: 3 },
            "an index outside its array", "indices count from 1";
        Kind::IndexCount { wanted: 0, .. } =>
            Kind::IndexCount { text: "a{1}".into(), found: 1, wanted: 0 },
            "an index of something else", "remove it";
        Kind::IndexCount { .. } =>
            Kind::IndexCount { text: "p{1}".into(), found: 1, wanted: 2 },
            "another number of indices than dimensions", "give as many";
        Kind::SameName { routine: None, .. } =>
            Kind::SameName { name: "p10".into(), routine: None },
            "a name declared twice", "rename one";
        Kind::SameName { .. } =>
            Kind::SameName { name: "p10".into(), routine: Some("main".into()) },
            "the same in a routine", "rename one";
        Kind::Circular { .. } =>
            Kind::Circular { names: ["a", "b", "a"].into_iter().collect() },
            "values that refer to each other", "give one of them a value";
        Kind::TooLong { .. } => Kind::TooLong { what: "name", found: 99_999, bound: 4096 },
            "a text made to take long", "shorten it";
        Kind::TooDeep { .. } => Kind::TooDeep { bound: 64 },
            "brackets or blocks in one another", "nest fewer";
        Kind::SecondModule => Kind::SecondModule, "two modules in one text", "split the text";
        Kind::ArgumentCount { .. } =>
            Kind::ArgumentCount { instruction: "MoveL", found: 3, wanted: 4 },
            "a move with missing arguments", "add them";
        Kind::NotAName { .. } => Kind::NotAName { name: "p 10".into() },
            "`dump` of a name", "write another name";
        Kind::NoRecord { .. } => Kind::NoRecord { text: "[1,2,3]".into() },
            "a record by itself", "write a whole one";
        Kind::OtherText { .. } => Kind::OtherText { found: 100, wanted: 120 },
            "`rewrite` with another text", "pass the text that was read";
        Kind::TwoValues { .. } => Kind::TwoValues { thing: thing.clone() },
            "`rewrite` with two values for one place", "give one";
        Kind::Routine(_) => Kind::Routine(RoutineFault::NoMoves { routine: "main".into() }),
            "`motion` of a routine that does not move", "give another one";
        Kind::NoSuchValue { missing: Missing::Datum { .. } } =>
            Kind::NoSuchValue { missing: Missing::Datum { index: 7, count: 3 } },
            "`rewrite` of a datum that the module does not have", "take one of the module's";
        Kind::NoSuchValue { missing: Missing::Element { .. } } =>
            Kind::NoSuchValue { missing: Missing::Element { thing: thing.clone(), element: 9 } },
            "the same of an element", "take one of the array's";
        Kind::NoSuchValue { missing: Missing::Single { .. } } =>
            Kind::NoSuchValue { missing: Missing::Single { thing } },
            "one value for a whole array", "give an element";
        Kind::NoSuchValue { missing: Missing::Module { .. } } =>
            Kind::NoSuchValue { missing: Missing::Module { what: "num a".into() } },
            "data that RAPID cannot write", "leave the datum out";
    });
    all.extend(routines());
    all
}

fn routines() -> Vec<Row> {
    rows! { RoutineFault;
        RoutineFault::Unknown { .. } => RoutineFault::Unknown {
            name: "mian".into(), known: ["main"].into_iter().collect(),
        },
            "`motion` of another name", "give one of the module's";
        RoutineFault::Which { .. } =>
            RoutineFault::Which { moving: ["pick", "place"].into_iter().collect() },
            "`motion` of a module without main", "give `routine`";
        RoutineFault::NoMoves { .. } => RoutineFault::NoMoves { routine: "main".into() }, "-", "";
        RoutineFault::Branch { .. } => RoutineFault::Branch { word: "WHILE".into() },
            "`motion` of a routine with branches", "put the moves into a routine of their own";
        RoutineFault::NoMotion { .. } => RoutineFault::NoMotion {
            finding: "line 5: MoveL *: * is taught on the controller".into(),
        },
            "`motion` of targets that are all unknown or out of reach", "see its findings";
    }
}

fn frames() -> Vec<Row> {
    rows! { FrameFault;
        FrameFault::Held { both: true } => FrameFault::Held { both: true },
            "a stationary tool with a stationary work object the wrong way round",
            "set robhold of one of them to FALSE";
        FrameFault::Held { both: false } => FrameFault::Held { both: false },
            "the same", "set robhold of one of them to TRUE";
        FrameFault::Moved { .. } => FrameFault::Moved { unit: "STN1".into() },
            "a positioner", "give a work object with ufprog TRUE";
        FrameFault::Pose { .. } => FrameFault::Pose {
            field: "tframe", fault: PoseFault::QuaternionNorm { norm: 2.0, bound: 2e-3, order: "w, x, y, z" },
        },
            "a frame in the data", "mend its quaternion";
    }
}

fn problems() -> Vec<Row> {
    let unknown = || Reason::Taught;
    let reach =
        || crate::Error::Unreachable(Explanation::OutOfReach(Reach::TooFar { shortfall: 0.012 }));
    rows! { Problem;
        Problem::Target(_) => Problem::Target(unknown()),
            "a target without a value in the text", "see the reasons below";
        Problem::Tool { .. } => Problem::Tool { text: "tGrip".into(), reason: unknown() },
            "a tool without a value", "pass its module as `context`";
        Problem::WorkObject { .. } =>
            Problem::WorkObject { text: "wTable".into(), reason: unknown() },
            "a work object without a value", "pass its module as `context`";
        Problem::Displaced { .. } => Problem::Displaced { line: 12 },
            "PDispSet, PDispOn, EOffsSet", "displace the targets yourself";
        Problem::AbsentAxis { .. } => Problem::AbsentAxis { axis: 6, degrees: 9e9 },
            "9E9 as a joint angle", "write the angle";
        Problem::Ambiguous { .. } => Problem::Ambiguous { count: 2 },
            "a robtarget of a GoFa, whose confdata may name two solutions",
            "give joint angles, by `MoveAbsJ` or a seed";
        Problem::OutsideLimits { .. } => Problem::OutsideLimits { joint: 5, excess: 0.05 },
            "a jointtarget outside the limits", "move it inside";
        Problem::OutsideLinkageLimits { .. } => Problem::OutsideLinkageLimits { excess: 0.05 },
            "the same of the parallelogram linkage", "move it inside";
        Problem::NotSolved(_) => Problem::NotSolved(reach()),
            "a robtarget without a solution", "see [answers](#answers)";
        Problem::Nearest(_) => Problem::Nearest(reach()),
            "`fallback=\"nearest\"`", "correct its confdata";
    }
}

fn findings() -> Vec<Row> {
    use FindingKind as Kind;
    let one = Kind::NotRead(NotRead::Motion { name: "TriggL".into() });
    let mut all = rows! { Finding;
        Finding { .. } =>
            Finding { move_index: 3, line: 12, column: 9, what: "TriggL p10,v100;".into(), kind: one },
            "every finding begins with its line and its instruction", "see below";
    };
    let singularity =
        |kind, distance| Kind::Singularity { kind, part: 0.4, distance, bound: 0.0175 };
    all.extend(rows! { FindingKind;
        Kind::Target(_) => Kind::Target(Problem::Target(Reason::Taught)),
            "`\"unknown\"`, `\"unreachable\"`, `\"limit\"`, `\"configuration\"`: the problems above",
            "see there";
        Kind::Speed { .. } => Kind::Speed { text: "vJob".into(), reason: Reason::Unfinished },
            "`\"unknown\"`: a speed without a value", "see the reasons below";
        Kind::Zone { .. } => Kind::Zone { text: "zJob".into(), reason: Reason::Unfinished },
            "`\"unknown\"`: a zone without a value", "see the reasons below";
        Kind::Time(_) => Kind::Time(Reason::OptionalArgument),
            "`\"unknown\"`: `\\T` of an optional argument", "write the duration";
        Kind::Number { .. } => Kind::Number { field: "v_tcp", value: 0.0 },
            "`\"setting\"`: a speed of zero, a negative zone", "write a positive one";
        Kind::WristMode(_) => Kind::WristMode(CirPathMode::Wrist45),
            "`\"setting\"`: a mode of CirPathMode that is not followed", "take one of the others";
        Kind::NotRead(_) => Kind::NotRead(NotRead::Motion { name: "TriggL".into() }),
            "`\"not_read\"`: a move of another name, ConfL without \\On or \\Off",
            "write MoveL, MoveJ, MoveC or MoveAbsJ";
        Kind::Call { .. } => Kind::Call { name: "rPick".into() },
            "`\"not_read\"`: a call of a routine that moves", "take the motion of that routine, too";
        Kind::Path(_) => Kind::Path(crate::error::MotionFault::HalfTurn {
            index: 1, angle: core::f64::consts::PI,
        }.into()),
            "`\"path\"`: a half turn, an arc through points of a line", "put a target between";
        Kind::Break { reason: BreakReason::Jump { .. }, .. } => Kind::Break {
            part: 0.4,
            reason: BreakReason::Jump { joint: 6, by: 6.2, kinds: SingularityKind::empty() },
        },
            "`\"flip\"`: a line that a joint cannot follow", "take another configuration, or MoveJ";
        Kind::Break { .. } => Kind::Break {
            part: 0.4,
            reason: BreakReason::Unreachable(Explanation::OutOfReach(Reach::TooFar {
                shortfall: 0.012,
            })),
        },
            "`\"unreachable\"`, `\"limit\"`: a line that leaves the reach or the limits",
            "move the targets, or take MoveJ";
        Kind::Singularity { .. } => singularity(SingularityKind::WRIST, 0.004),
            "`\"singularity\"`: a line or an arc near one", "SingArea\\Wrist, or other targets";
        Kind::Singularity { .. } => singularity(SingularityKind::SHOULDER, 0.0),
            "`\"singularity\"`: a line or an arc through one", "the same";
        Kind::Configuration { .. } => Kind::Configuration {
            found: Configuration { cf1: -1, cf4: 0, cf6: -1, cfx: 0 },
            wanted: Configuration::default(),
        },
            "`\"configuration\"`: confdata of a MoveL or MoveC under ConfL\\On",
            "correct it: `calc_rob_t` has it";
        Kind::JointSpeed { .. } => Kind::JointSpeed {
            joint: 4, value: 12.0, bound: 6.3, slowed: 0.525, speed: 0.2,
        },
            "`\"joint_speed\"`: a line or an arc at its programmed speed", "program a lower one";
        Kind::Duration { .. } => Kind::Duration { value: 1.4, bound: 1.0 },
            "`\"duration\"`: `\\T` that the limits do not allow", "program a longer one";
    });
    all
}

fn reasons() -> Vec<Row> {
    let name = std::string::String::from("p10");
    let refers = |why| Reason::Reference { name: name.clone(), why };
    let of = Reason::Reference { name: name.clone(), why: Unresolved::NotDeclared };
    let mut all = rows! { Reason;
        Reason::Taught => Reason::Taught, "`*` as a target", "name the target";
        Reason::Unfinished => Reason::Unfinished, "`<EXP>` and other placeholders", "fill them in";
        Reason::OptionalArgument => Reason::OptionalArgument, "`Present`", "-";
        Reason::Operator => Reason::Operator, "DIV, MOD, ...", "write the value";
        Reason::Negation => Reason::Negation, "NOT", "write the value";
        Reason::Arithmetic { .. } => Reason::Arithmetic { type_name: "robtarget" },
            "`+` of records", "write the value";
        Reason::Function { .. } => Reason::Function { name: "CRobT".into() },
            "a function that asks the controller", "write the value";
        Reason::OwnFunction { .. } => Reason::OwnFunction { name: "fGrid".into() },
            "a function of the program", "write the value";
        Reason::FunctionArgument { .. } =>
            Reason::FunctionArgument { name: "Offs".into(), argument: "\\Tool".into() },
            "an argument that is not read", "write the value";
        Reason::CopiedArray { .. } => Reason::CopiedArray { name: "pGrid".into() },
            "an array copied as a whole", "write its elements";
        Reason::NoAggregate => Reason::NoAggregate,
            "an array from a function", "write its elements";
        Reason::Reference { .. } => of, "a name of another module", "pass it as `context`";
    };
    let by = AssignedBy::Line(12);
    all.extend(rows! { Unresolved;
        Unresolved::NotDeclared => Unresolved::NotDeclared, "-", "";
        Unresolved::LoopVariable => Unresolved::LoopVariable, "-", "";
        Unresolved::OtherType { .. } => Unresolved::OtherType { type_name: "bool".into() },
            "-", "";
        Unresolved::Unfinished => Unresolved::Unfinished, "-", "";
        Unresolved::Type => Unresolved::Type, "-", "";
        Unresolved::Routine => Unresolved::Routine, "-", "";
        Unresolved::Parameter { .. } => Unresolved::Parameter { routine: "main".into() }, "-", "";
        Unresolved::ValueNotKnown => Unresolved::ValueNotKnown, "-", "";
        Unresolved::NoValue => Unresolved::NoValue, "-", "";
        Unresolved::CanChange => Unresolved::CanChange, "-", "";
        Unresolved::WholeArray => Unresolved::WholeArray, "-", "";
        Unresolved::NoSuchElement => Unresolved::NoSuchElement, "-", "";
        Unresolved::Assigned { .. } => Unresolved::Assigned { through: None, by: by.clone() },
            "-", "";
    });
    for (why, trigger) in [
        (Unresolved::LoopVariable, "FOR"),
        (Unresolved::OtherType { type_name: "bool".into() }, "a type that is not read"),
        (Unresolved::Unfinished, "a placeholder"),
        (Unresolved::Type, "the name of a type"),
        (Unresolved::Routine, "the name of a routine"),
        (Unresolved::Parameter { routine: "main".into() }, "a parameter"),
        (Unresolved::ValueNotKnown, "a value from a function"),
        (Unresolved::NoValue, "a declaration without `:=`"),
        (Unresolved::CanChange, "a VAR or PERS where a constant is needed"),
        (Unresolved::WholeArray, "an array without an index"),
        (Unresolved::NoSuchElement, "an index outside the array"),
        (Unresolved::Assigned { through: None, by }, "an assignment in the program"),
        (
            Unresolved::Assigned {
                through: Some("a".into()),
                by: AssignedBy::Module(Some("Data".into())),
            },
            "an assignment to what it depends on",
        ),
        (
            Unresolved::Assigned { through: None, by: AssignedBy::Module(None) },
            "an assignment in another module",
        ),
    ] {
        all.push(Row {
            message: std::string::ToString::to_string(&refers(why)),
            trigger,
            remedy: "write the value where it is used",
        });
    }
    all
}

fn skipped() -> Vec<Row> {
    let name = || std::string::String::from("Reset");
    rows! { NotRead;
        NotRead::Unfinished { .. } => NotRead::Unfinished { statement: "MoveL".into() },
            "a placeholder", "fill it in";
        NotRead::Datum { .. } => NotRead::Datum { name: "p10".into(), reason: Reason::Taught },
            "a value that is not known", "see the reasons above";
        NotRead::DatumOfType { .. } =>
            NotRead::DatumOfType { name: "z1".into(), type_name: "bool".into() },
            "a type that is not read", "-";
        NotRead::Record { .. } => NotRead::Record { name: name() }, "RECORD", "-";
        NotRead::Alias { .. } => NotRead::Alias { name: name() }, "ALIAS", "-";
        NotRead::Flow { .. } => NotRead::Flow { word: "IF".into() },
            "branches and loops: all moves are read, in the order of the text", "-";
        NotRead::Label { .. } => NotRead::Label { name: name() }, "a label", "-";
        NotRead::Assignment { .. } => NotRead::Assignment { name: "p10".into() },
            "an assignment", "write the value in the declaration";
        NotRead::Motion { .. } => NotRead::Motion { name: "TriggL".into() },
            "a move of another name", "write MoveL, MoveJ, MoveC or MoveAbsJ";
        NotRead::Instruction { .. } => NotRead::Instruction { name: name() },
            "an instruction that does not move", "-";
    }
}
