//! A RAPID module: the joint angles of its moves, and the module written back with valid confdata.

use irbkin::Robot;
use irbkin_abb::Error;
use irbkin_abb::rapid::{
    self, Content, Fallback, NewValue, RobTarget, TableRow, ToolData, Value, WobjData,
};

const MODULE: &str = include_str!("pick_and_place.mod");

fn degrees(q: &[f64; 6]) -> String {
    // Adding zero turns -0.0 into 0.0.
    q.map(|angle| format!("{:8.2}", (100.0 * angle.to_degrees()).round() / 100.0 + 0.0)).join(" ")
}

fn show(rows: &[TableRow]) {
    for TableRow { kind, text, q, configuration, finding, .. } in rows {
        let joints = q.as_ref().map_or_else(|| " ".repeat(53), degrees);
        let code = finding.as_ref().map_or("", |finding| finding.code.name());
        println!("  {kind:8} {text:22.22} {joints}  {configuration}  {code}");
    }
}

fn tool_and_wobj(module: &rapid::Module) -> Option<(ToolData, WobjData)> {
    let (tool, wobj) = (module.find("tGripper")?, module.find("wTray")?);
    match (&tool.content, &wobj.content) {
        (Content::Single(Value::ToolData(tool)), Content::Single(Value::WobjData(wobj))) => {
            Some((*tool, wobj.clone()))
        }
        _ => None,
    }
}

/// Where confdata was not calculated, use the solution nearest to the joints before. The poses
/// stay as written.
fn corrected(robot: &Robot<6>, module: &rapid::Module) -> Result<Vec<NewValue>, Error> {
    let Some((tool, wobj)) = tool_and_wobj(module) else { return Ok(Vec::new()) };
    let home = [0.0, 0.0, 0.0, 0.0, 30.0, 0.0].map(f64::to_radians);
    let rows =
        rapid::calc_targets(robot, module, Some(&tool), Some(&wobj), Fallback::Nearest(home))?;
    let wrong = |row: &&TableRow| row.finding.is_some() && row.q.is_some();
    let new_value = |row: &TableRow| {
        let datum = module.data().iter().position(|datum| datum.name == row.text)?;
        let Content::Single(Value::RobTarget(target)) = module.data()[datum].content else {
            return None;
        };
        let value = Value::RobTarget(RobTarget { robconf: row.configuration, ..target });
        Some(NewValue { datum, element: None, value })
    };
    Ok(rows.iter().filter(wrong).filter_map(new_value).collect())
}

fn main() -> Result<(), Error> {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65")?;
    let module = rapid::parse(MODULE, &[])?;
    println!("pick_and_place.mod: {} data, {} moves", module.data().len(), module.moves().len());
    for part in module.skipped() {
        println!("  line {}: {}", part.line, part.what());
    }

    println!("\nas read: CalcJointT of every target");
    show(&rapid::calc_moves(&robot, &module, Fallback::None)?);

    let corrected = corrected(&robot, &module)?;
    let text = rapid::rewrite(MODULE, &module, &corrected)?;
    println!("\nwritten back with {} corrected configurations", corrected.len());
    for (_, after) in MODULE.lines().zip(text.lines()).filter(|(before, after)| before != after) {
        println!("  {:.96}", after.trim());
    }

    println!("\nread again");
    show(&rapid::calc_moves(&robot, &rapid::parse(&text, &[])?, Fallback::None)?);
    Ok(())
}
