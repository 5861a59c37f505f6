//! Tables with the treatment of the elements and attributes of a format.

/// Treatment of an element or an attribute.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Treatment {
    /// The scene has an exact counterpart of the element or attribute.
    Mapped,
    /// The scene has a counterpart that acts nearly the same; the reader adds a finding.
    Approximated,
    /// The scene has no counterpart. A finding reports it, with the reason.
    Ignored(&'static str),
    /// The element or attribute is for pictures only.
    Appearance,
    /// The element or attribute does not affect the motion, or another finding reports it.
    Silent,
    /// The element or attribute makes the model invalid for the import.
    Refused,
}

/// A row: an element and some of its attributes, with their common treatment. The element's name may follow its parent's name, as in
/// `mimic/joint`. A name may end with `*` for any ending. A row without attributes is for the element itself. The first matching row applies;
/// rows with a parent come before rows without one.
pub(crate) struct Row {
    pub(crate) element: &'static str,
    /// Names of attributes, separated by blanks; `*` stands for all others.
    pub(crate) attributes: &'static str,
    pub(crate) treatment: Treatment,
}

/// Makes a row of a treatment table.
pub(crate) const fn row(
    element: &'static str,
    attributes: &'static str,
    treatment: Treatment,
) -> Row {
    Row { element, attributes, treatment }
}

/// Treatment of an attribute, or of an element when `attribute` is empty; `None` when the table does not have it.
pub(crate) fn treatment(
    table: &[Row],
    parent: &str,
    element: &str,
    attribute: &str,
) -> Option<Treatment> {
    let is_like = |pattern: &str, name: &str| match pattern.strip_suffix('*') {
        Some(begin) => name.starts_with(begin),
        None => pattern == name,
    };
    let is_named = |row: &&Row| match row.element.split_once('/') {
        Some((outer, inner)) => outer == parent && is_like(inner, element),
        None => is_like(row.element, element),
    };
    let is_meant = |row: &&Row| {
        let mut words = row.attributes.split(' ');
        words.any(|word| word == attribute || (word == "*" && !attribute.is_empty()))
    };
    let find = |is_whole: bool| {
        let mut rows = table.iter().filter(|row| row.element.contains('/') == is_whole);
        rows.find(|row| is_named(row) && is_meant(row)).map(|row| row.treatment)
    };
    find(true).or_else(|| find(false))
}

#[cfg(test)]
mod tests {
    use super::Treatment::{Appearance, Ignored, Refused, Silent};
    use super::*;
    use crate::{mjcf, sdf, urdf};

    /// Lines `parent/element attribute` of a stored list that a table does not have. The parts of an element that is ignored or refused as a
    /// whole are left out.
    fn unknown(list: &str, table: &[Row]) -> Vec<String> {
        let lines = list.lines().filter(|line| !line.starts_with('#')).map(|line| {
            let (path, attribute) = line.split_once(' ').expect("two words");
            let (parent, element) = path.rsplit_once('/').expect("an element in another");
            let attribute = if attribute == "-" { "" } else { attribute };
            (line, parent, element, attribute, treatment(table, parent, element, attribute))
        });
        let lines: Vec<_> = lines.collect();
        let is_whole = |outer: &str| {
            lines.iter().any(|(_, _, element, attribute, treated)| {
                let is_it = *element == outer && attribute.is_empty();
                is_it && matches!(treated, Some(Ignored(_) | Appearance | Silent | Refused))
            })
        };
        let unknown =
            lines.iter().filter(|(_, parent, .., treated)| treated.is_none() && !is_whole(parent));
        unknown.map(|(line, ..)| (*line).to_owned()).collect()
    }

    #[test]
    fn every_element_and_attribute_of_the_formats_stands_in_a_table() {
        for (list, table) in [
            (include_str!("../elements/urdf.txt"), urdf::TABLE),
            (include_str!("../elements/sdf.txt"), sdf::TABLE),
            (include_str!("../elements/mjcf.txt"), mjcf::TABLE),
        ] {
            let unknown = unknown(list, table);
            assert!(unknown.is_empty(), "{} lines:\n{}", unknown.len(), unknown.join("\n"));
        }
    }
}
