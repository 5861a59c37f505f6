//! Tables that say what becomes of the elements and attributes of a format.

/// What becomes of an element or an attribute.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Treatment {
    /// It is in the scene.
    Mapped,
    /// Something in the scene acts nearly so; the reader says what.
    Approximated,
    /// It is not in the scene, and this is told, with the reason.
    Ignored(&'static str),
    /// It is for the eye alone.
    Appearance,
    /// The model is refused.
    Refused,
}

/// An element, or its name behind its parent's: `mimic/joint`. With attributes that are treated alike; none stands for the element itself.
pub(crate) struct Row {
    pub(crate) element: &'static str,
    /// Names with blanks between them; `*` for all others.
    pub(crate) attributes: &'static str,
    pub(crate) treatment: Treatment,
}

/// A row.
pub(crate) const fn row(
    element: &'static str,
    attributes: &'static str,
    treatment: Treatment,
) -> Row {
    Row { element, attributes, treatment }
}

/// What a table says of an element (`attribute` is empty), or of an attribute; `None` where it does not know it.
pub(crate) fn treatment(
    table: &[Row],
    parent: &str,
    element: &str,
    attribute: &str,
) -> Option<Treatment> {
    let is_named = |row: &&Row| match row.element.split_once('/') {
        Some((outer, inner)) => outer == parent && inner == element,
        None => row.element == element,
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
