//! The links of a URDF and the joints between them.

use alloc::borrow::Cow;
use alloc::collections::BTreeMap;

use roxmltree::{Document, Node};

use super::attributes::{Version, version_of};
use super::joint::{Joint, is_own};
use super::shape::{check_shape, mended};
use crate::prelude::*;
use crate::urdf::fault::UrdfFault;
use irbkin::internal::Names;

/// Links and joints by index, each link with the joint above it and those below.
pub(super) struct Tree<'a> {
    pub(super) name: &'a str,
    pub(super) version: Version,
    /// Lines before the text that was parsed.
    skipped: usize,
    pub(super) links: Vec<&'a str>,
    pub(super) joints: Vec<Joint<'a>>,
    /// The joint whose child a link is.
    pub(super) above: Vec<Option<usize>>,
    /// The joints whose parent a link is.
    pub(super) below: Vec<Vec<usize>>,
    index: BTreeMap<&'a str, usize>,
    joint_index: BTreeMap<&'a str, usize>,
}

/// Mends of a text, at most: each is one more reading.
const MOST_MENDS: usize = 16;

/// What is read from a text as XML, with the number of lines before it: an XML declaration is valid
/// only at the very beginning. Entities are not read.
#[doc(hidden)]
pub fn read_document<T, E: From<UrdfFault>>(
    text: &str,
    read: impl FnOnce(&Document<'_>, usize) -> Result<T, E>,
) -> Result<T, E> {
    let body = text.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{feff}');
    let skipped = text[..text.len() - body.len()].matches('\n').count();
    check_shape(text)?;
    let mut text = Cow::Borrowed(body);
    let mut mends = 0;
    loop {
        let error = match Document::parse(&text) {
            Ok(document) => return read(&document, skipped),
            Err(error) => error,
        };
        mends += 1;
        let better = mended(&text, &error).filter(|_| mends <= MOST_MENDS);
        text = better.ok_or_else(|| not_xml(&error, skipped, &text))?.into();
    }
}

/// The parser's message, with the line in the whole text.
fn not_xml(error: &roxmltree::Error, skipped: usize, body: &str) -> UrdfFault {
    let position = error.pos();
    let (mut line, mut column) = (position.row as usize, position.col as usize);
    let what = match error {
        roxmltree::Error::UnknownNamespace(prefix, _) if prefix == "xacro" => {
            return UrdfFault::Xacro { line: line + skipped, element: "xacro:...".to_owned() };
        }
        roxmltree::Error::UnclosedRootNode
        | roxmltree::Error::UnexpectedEndOfStream
        | roxmltree::Error::NoRootNode => {
            line = body.lines().count().max(1);
            column = body.lines().next_back().unwrap_or_default().chars().count() + 1;
            "the text ends before the robot does".to_owned()
        }
        roxmltree::Error::DtdDetected => "it has a document type, which is not read".to_owned(),
        _ => error.to_string().replace(&format!(" at {position}"), ""),
    };
    UrdfFault::NotXml { line: line + skipped, column, what }
}

impl<'a> Tree<'a> {
    /// Read names and connections; the numbers of a joint are read if it is between base and tip.
    pub(super) fn new(document: &'a Document<'a>, skipped: usize) -> Result<Self, UrdfFault> {
        let robot = document.root_element();
        let elements = |name| robot.children().filter(move |node| is_own(*node, name));
        let mut tree = Self {
            skipped,
            name: robot.attribute("name").unwrap_or_default(),
            version: 0,
            links: Vec::new(),
            joints: Vec::new(),
            above: Vec::new(),
            below: Vec::new(),
            index: BTreeMap::new(),
            joint_index: BTreeMap::new(),
        };
        tree.refuse_xacro(robot)?;
        if robot.tag_name().name() != "robot" {
            return Err(UrdfFault::NotRobot { found: robot.tag_name().name().to_owned() });
        }
        tree.version = version_of(robot)?;
        for node in elements("link") {
            let name = node.attribute("name").ok_or_else(|| tree.missing(node, "link", "name"))?;
            if tree.index.insert(name, tree.links.len()).is_some() {
                return Err(UrdfFault::SameName { element: "link", name: name.to_owned() });
            }
            tree.links.push(name);
            tree.above.push(None);
            tree.below.push(Vec::new());
        }
        let is_xacro = |uri: &str| uri.contains("xacro");
        if tree.links.is_empty() && robot.namespaces().any(|space| is_xacro(space.uri())) {
            let (line, element) = (tree.line(robot), "robot xmlns:xacro".to_owned());
            return Err(UrdfFault::Xacro { line, element });
        }
        for node in elements("joint") {
            let missing = |missing| tree.missing(node, "joint", missing);
            let joint = Joint::new(node, missing, |name| tree.link(name))?;
            if tree.joint_index.insert(joint.name, tree.joints.len()).is_some() {
                return Err(UrdfFault::SameName { element: "joint", name: joint.name.to_owned() });
            }
            if let Some(other) = tree.above[joint.child] {
                let joints = [tree.joints[other].name, joint.name].map(str::to_owned);
                let link = tree.links[joint.child].to_owned();
                return Err(UrdfFault::TwoParents { link, joints });
            }
            tree.above[joint.child] = Some(tree.joints.len());
            tree.below[joint.parent].push(tree.joints.len());
            tree.joints.push(joint);
        }
        tree.refuse_loops()?;
        Ok(tree)
    }

    pub(super) fn link(&self, name: &str) -> Option<usize> {
        self.index.get(name).copied()
    }

    pub(super) fn joint(&self, name: &str) -> Option<&Joint<'a>> {
        self.joint_index.get(name).map(|&joint| &self.joints[joint])
    }

    pub(super) fn roots(&self) -> impl Iterator<Item = usize> {
        (0..self.links.len()).filter(|&link| self.above[link].is_none())
    }

    /// Every link below those given, a parent before its children; no link has two parents, and
    /// none appears twice.
    pub(super) fn hanging_on(&self, links: impl Iterator<Item = usize>) -> Vec<usize> {
        let mut found: Vec<usize> = links.collect();
        let mut next = 0;
        while let Some(&link) = found.get(next) {
            found.extend(self.below[link].iter().map(|&joint| self.joints[joint].child));
            next += 1;
        }
        found
    }

    fn missing(
        &self,
        node: Node<'_, '_>,
        element: &'static str,
        missing: &'static str,
    ) -> UrdfFault {
        UrdfFault::Missing { line: self.line(node), element, missing }
    }

    /// The line on which an element begins, from 1.
    fn line(&self, node: Node<'_, '_>) -> usize {
        node.document().text_pos_at(node.range().start).row as usize + self.skipped
    }

    fn refuse_xacro(&self, robot: Node<'_, '_>) -> Result<(), UrdfFault> {
        let is_xacro = |node: &Node<'_, '_>| {
            node.tag_name().namespace().is_some_and(|uri| uri.contains("xacro"))
        };
        match robot.descendants().find(is_xacro) {
            Some(node) => Err(UrdfFault::Xacro {
                line: self.line(node),
                element: format!("xacro:{}", node.tag_name().name()),
            }),
            None => Ok(()),
        }
    }

    fn refuse_loops(&self) -> Result<(), UrdfFault> {
        let mut on_a_root = vec![false; self.links.len()];
        for link in self.hanging_on(self.roots()) {
            on_a_root[link] = true;
        }
        let Some(mut link) = on_a_root.iter().position(|on| !on) else { return Ok(()) };
        // Upwards there is no end: after as many steps as there are links, the loop is found.
        let parent = |link: usize| self.above[link].map_or(link, |joint| self.joints[joint].parent);
        for _ in 0..self.links.len() {
            link = parent(link);
        }
        let mut members = vec![link];
        let mut next = parent(link);
        while next != link {
            members.push(next);
            next = parent(next);
        }
        Err(UrdfFault::Loop { links: self.quoted(members.into_iter().rev()) })
    }

    /// The names of links for a message.
    pub(super) fn quoted(&self, links: impl Iterator<Item = usize>) -> Names {
        links.map(|link| quoted(self.links[link])).collect()
    }
}

pub(super) fn quoted(name: &str) -> String {
    format!("{name:?}")
}
