//! Reading a URDF takes time in proportion to its text, whatever its shape: what would take longer
//! is refused before it is parsed.
#![allow(clippy::format_collect)]

use std::fmt::Write as _;
use std::time::Instant;

use irbkin_motion::Arm;

/// Pieces by their numbers, until they are `size` bytes.
fn filled(size: usize, piece: &dyn Fn(usize) -> String) -> String {
    let mut text = String::new();
    for i in 0.. {
        if text.len() >= size {
            break;
        }
        text += &piece(i);
    }
    text
}

fn robot(inside: &str) -> String {
    format!("<robot name=\"r\">{inside}</robot>")
}

/// Elements in elements.
fn nested(size: usize, open: &dyn Fn(usize) -> String) -> String {
    let inside = filled(size, open);
    let depth = inside.matches('<').count();
    robot(&(inside + &"</a>".repeat(depth)))
}

fn attributes(size: usize, piece: &dyn Fn(usize) -> String) -> String {
    format!("<robot name=\"r\"{}/>", filled(size, piece))
}

type Shape = (&'static str, String);

/// Texts of about `size` bytes that grow in one way each.
fn hostile(size: usize) -> Vec<Shape> {
    [namespaces(size), markup(size), chains(size)].concat()
}

fn namespaces(size: usize) -> Vec<Shape> {
    vec![
        ("namespaces, nested", nested(size, &|i| format!("<a xmlns:n{i}=\"{i}\">"))),
        ("one namespace, nested", nested(size, &|i| format!("<a xmlns=\"{i}\">"))),
        (
            "namespaces, nested and used",
            nested(size, &|i| format!("<a xmlns:n{i}=\"{i}\" n0:b=\"\">")),
        ),
        ("namespaces of one element", attributes(size, &|i| format!(" xmlns:n{i}=\"{i}\""))),
        (
            "namespaces of one element and of each below",
            format!(
                "<robot {}>{}</robot>",
                (0..250).fold(String::new(), |mut all, i| {
                    let _ = write!(all, "xmlns:n{i}=\"{i}\" ");
                    all
                }),
                filled(size, &|i| format!("<n249:a n24{}:b=\"\"/>", i % 10)),
            ),
        ),
        ("namespaces, side by side", robot(&filled(size, &|i| format!("<a xmlns:n{i}=\"{i}\"/>")))),
        ("attributes of one element", attributes(size, &|i| format!(" a{i}=\"\""))),
        (
            "attributes of a joint",
            robot(&format!("<joint{}/>", filled(size, &|i| format!(" a{i}=\"\"")))),
        ),
        (
            "attributes of many elements",
            robot(&filled(size, &|_| {
                format!("<a{}/>", (0..250).map(|i| format!(" a{i}=\"\"")).collect::<String>())
            })),
        ),
    ]
}

fn markup(size: usize) -> Vec<Shape> {
    let doctype = |inside: String| format!("<!DOCTYPE r [{inside}]><robot name=\"&e9;\"/>");
    vec![
        ("elements, nested", nested(size, &|_| "<a>".to_owned())),
        ("elements, never closed", filled(size, &|_| "<a>".to_owned())),
        ("tags, never closed", filled(size, &|_| "<a ".to_owned())),
        ("quotes, never closed", robot(&filled(size, &|i| format!("<a b{i}=\"'")))),
        ("closing tags", robot(&filled(size, &|_| "</a>".to_owned()))),
        ("comments", robot(&filled(size, &|_| "<!---->".to_owned()))),
        ("a comment, never closed", filled(size, &|_| "<!-- -".to_owned())),
        ("character data", robot(&filled(size, &|_| "<![CDATA[x]]>&lt;".to_owned()))),
        ("processing instructions", robot(&filled(size, &|_| "<?a b?>".to_owned()))),
        ("references", robot(&filled(size, &|_| "&amp;".to_owned()))),
        (
            "references in an attribute",
            attributes(size, &|i| {
                if i == 0 { " a=\"".to_owned() } else { "&amp;".to_owned() }
            }),
        ),
        ("entities", doctype(filled(size, &|i| format!("<!ENTITY e{} \"&e{i};&e{i};\">", i + 1)))),
        ("lines", "\n".repeat(size) + "<robot/>"),
        (
            "blanks and equals signs",
            format!("<robot{}{}/>", " ".repeat(size / 2), "=".repeat(size / 2)),
        ),
        ("openings", filled(size, &|_| "<".to_owned())),
        ("instructions, never closed", filled(size, &|_| "<?a ".to_owned())),
    ]
}

fn chains(size: usize) -> Vec<Shape> {
    let links = |extra: &str| {
        let chain = |i: usize| {
            let j = i + 1;
            format!(
                "<link name=\"l{j}\"/><joint name=\"j{i}\" type=\"{extra}\"><parent link=\"l{i}\"/>\
                 <child link=\"l{j}\"/><limit lower=\"-1\" upper=\"1\"/></joint>"
            )
        };
        robot(&("<link name=\"l0\"/>".to_owned() + &filled(size, &chain)))
    };
    let star = |i: usize| {
        format!(
            "<link name=\"k{i}\"/><joint name=\"j{i}\" type=\"fixed\"><parent link=\"l0\"/>\
             <child link=\"k{i}\"/></joint>"
        )
    };
    vec![
        ("a chain of links that turn", links("revolute")),
        ("a chain of fixed links", links("fixed")),
        ("a chain of links of another kind", links("floating")),
        ("a star of links", robot(&("<link name=\"l0\"/>".to_owned() + &filled(size, &star)))),
        ("links of one name", robot(&filled(size, &|_| "<link name=\"l\"/>".to_owned()))),
        ("links without joints", robot(&filled(size, &|i| format!("<link name=\"l{i}\"/>")))),
        ("a long name", robot(&format!("<link name=\"{}\"/>", "l".repeat(size)))),
        (
            "joints of one link",
            robot(
                &("<link name=\"l\"/>".to_owned()
                    + &filled(size, &|i| {
                        format!(
                            "<joint name=\"j{i}\" type=\"fixed\"><parent link=\"l\"/><child \
                             link=\"l\"/></joint>"
                        )
                    })),
            ),
        ),
        (
            "elements of one joint",
            robot(&format!(
                "<link name=\"l\"/><joint name=\"j\" type=\"fixed\">{}</joint>",
                filled(size, &|_| "<origin/>".to_owned())
            )),
        ),
    ]
}

/// The time of reading a text, the least of three [s].
fn time(text: &str) -> f64 {
    let once = || {
        let start = Instant::now();
        let read = Arm::<6>::from_urdf(std::hint::black_box(text), None, None);
        assert!(!read.unwrap_err().to_string().is_empty());
        start.elapsed().as_secs_f64()
    };
    (0..3).map(|_| once()).fold(f64::INFINITY, f64::min)
}

#[test]
fn sixteen_times_the_text_takes_sixteen_times_as_long() {
    let [small, large] = [1 << 16, 1 << 20].map(hostile);
    for ((kind, small), (_, large)) in small.iter().zip(&large) {
        let (first, sixteenth) = (time(large), time(small));
        let ratio = first / sixteenth.max(5e-4);
        println!("{kind}: {:.2} ms, {:.2} ms, {ratio:.1}", 1e3 * sixteenth, 1e3 * first);
        // A quadratic reader's is 256, a cubic one's 4096. Below a second a busy machine and its
        // memory decide.
        assert!(first < 1.0 || ratio < 64.0, "{kind}: {first:.1} s, {ratio:.1}");
    }
}

fn refusal(text: &str) -> String {
    Arm::<6>::from_urdf(text, None, None).unwrap_err().to_string()
}

#[test]
fn text_that_would_take_long_is_refused_with_the_bound() {
    let text = |count: usize| {
        let open: String = (0..count).map(|i| format!("\n<a xmlns:n{i}=\"{i}\">")).collect();
        format!("<robot>{open}{}</robot>", "</a>".repeat(count))
    };
    assert_eq!(refusal(&text(256)), "URDF: the robot has no links");
    assert_eq!(
        refusal(&text(257)),
        "URDF: line 258 declares one namespace (xmlns) too many: at most 256 are read"
    );
    let text = |count: usize| {
        let attributes: String = (0..count).map(|i| format!(" a{i} = '{i}'")).collect();
        format!("\n<robot>\n<link{attributes}/></robot>")
    };
    assert_eq!(refusal(&text(256)), "URDF: line 3: <link> has no name");
    assert_eq!(
        refusal(&text(257)),
        "URDF: line 3: <link> has too many attributes: at most 256 are read"
    );
}

/// What looks like a declaration or an attribute, but is text, is counted as neither.
#[test]
fn text_is_not_counted() {
    let many = " xmlns:a=\"b\"".repeat(1000);
    for text in [
        format!("<robot><!-- {many} --></robot>"),
        format!("<robot><![CDATA[<a {many}>]]></robot>"),
        format!("<?a <b {many}> ?><robot/>"),
        format!("<robot>{many}</robot>"),
        format!("<robot a='{many} > '/>"),
        format!("<robot a=\"{}\"/>", " xmlns:a='b' /&gt; >".repeat(1000)),
    ] {
        assert_eq!(refusal(&text), "URDF: the robot has no links", "{text:.60}");
    }
}

#[test]
fn links_beside_an_arm_take_as_long_as_their_text() {
    let arm = include_str!("data/irb2600.urdf");
    let beside = |size: usize, is_chain: bool| {
        let link = |i: usize| {
            let parent = if is_chain && i > 0 { format!("f{}", i - 1) } else { "tool0".to_owned() };
            format!(
                "<link name=\"f{i}\"><collision><geometry><sphere radius=\"1\"/></geometry>\
                 </collision></link><joint name=\"g{i}\" type=\"revolute\"><parent \
                 link=\"{parent}\"/><child link=\"f{i}\"/><limit upper=\"1\"/><mimic \
                 joint=\"g{}\"/></joint>",
                i / 2
            )
        };
        arm.replace("</robot>", &(filled(size, &link) + "</robot>"))
    };
    let taken = |text: String| {
        let start = Instant::now();
        assert!(
            Arm::<6>::from_urdf(&text, None, Some("tool0")).is_ok_and(|it| it.body().is_none())
        );
        start.elapsed().as_secs_f64()
    };
    for is_chain in [true, false] {
        let [small, large] = [1 << 19, 1 << 22].map(|size| taken(beside(size, is_chain)));
        println!("{is_chain}: {:.2} ms, {:.2} ms", 1e3 * small, 1e3 * large);
        assert!(large < 1.0 || large < 32.0 * small.max(5e-4), "{is_chain}: {small}, {large}");
    }
}
