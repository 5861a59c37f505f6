//! Random and mutated files: the reader returns a result for each, and never panics.

use super::effects::{CAR, CART};
use super::{PLANAR, SPATIAL, read};
use mbs_scene::SceneFile;
use proptest::prelude::*;

const SCENES: [&str; 4] = [PLANAR, SPATIAL, CART, CAR];

/// Pieces of scenes, so that random texts pass the first checks of the reader.
fn piece() -> impl Strategy<Value = String> {
    let lines: Vec<String> = SCENES.iter().flat_map(|s| s.lines()).map(str::to_owned).collect();
    prop_oneof![
        6 => proptest::sample::select(lines),
        1 => "[a-z\\[\\]{}=\",.0-9 #\\n-]{0,20}",
        1 => "\\PC{0,8}",
    ]
}

proptest! {
    #[test]
    fn arbitrary_bytes_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        if let Ok(document) = SceneFile::from_bytes(&bytes, "x") {
            let _ = document.scene::<f32>().map_err(|error| error.render());
        }
    }

    #[test]
    fn shuffled_pieces_never_panic(pieces in proptest::collection::vec(piece(), 0..40)) {
        if let Err(error) = read(&pieces.join("\n")) {
            prop_assert!(error.render().starts_with("test.toml:"));
        }
    }

    #[test]
    fn mutated_scenes_never_panic(
        scene in proptest::sample::select(SCENES.to_vec()),
        edits in proptest::collection::vec((any::<prop::sample::Index>(), piece(), 0..12_usize), 1..6),
    ) {
        let mut text: Vec<char> = scene.chars().collect();
        for (at, insert, removed) in edits {
            let at = at.index(text.len() + 1);
            let end = (at + removed).min(text.len());
            text.splice(at..end, insert.chars());
        }
        let text: String = text.into_iter().collect();
        if let Err(error) = read(&text) {
            let place = error.place();
            prop_assert!(place.column + place.width <= place.text.chars().count() + 2);
            prop_assert!(!error.render().is_empty() && !error.hint().is_empty());
        }
    }
}
