//! Finds elements and attributes that no reader asked for.

use crate::element::Element;
use crate::findings::Findings;
use crate::source::Origin;
use crate::table::{Row, Treatment, treatment};

/// Adds a finding for every element and attribute that was not read.
pub(crate) fn unread(root: &Element, table: &[Row], findings: &mut Findings) {
    let mut walk = Walk { table, findings };
    if root.is_read() {
        walk.inside("", &root.label(), root);
    } else {
        walk.lost("", &root.label(), root);
    }
}

struct Walk<'a> {
    table: &'a [Row],
    findings: &'a mut Findings,
}

impl Walk<'_> {
    /// Adds findings for the unread attributes and children of an element that was read.
    fn inside(&mut self, parent: &str, path: &str, element: &Element) {
        for attribute in element.attributes.iter().filter(|attribute| !attribute.is_read()) {
            let treated = treatment(self.table, parent, &element.name, &attribute.name);
            self.add(treated, attribute.at, format!("{path}@{}", attribute.name), "attribute");
        }
        for child in &element.children {
            let path = format!("{path}/{}", child.label());
            if child.is_read() {
                self.inside(&element.name, &path, child);
            } else {
                self.lost(&element.name, &path, child);
            }
        }
    }

    /// Adds one finding for an unread element with all its parts.
    fn lost(&mut self, parent: &str, path: &str, element: &Element) {
        let treated = treatment(self.table, parent, &element.name, "");
        self.add(treated, element.at, path.to_owned(), "element");
    }

    fn add(&mut self, treated: Option<Treatment>, at: Origin, path: String, what: &str) {
        match treated {
            Some(Treatment::Appearance) => self.findings.appearance(at, path),
            Some(Treatment::Silent) => {}
            Some(Treatment::Ignored(why)) => self.findings.ignored(at, path, why),
            Some(_) => {
                self.findings.ignored(at, path, format!("this {what} is not read at this place"))
            }
            None => self.findings.ignored(at, path, format!("unknown {what}")),
        }
    }
}
