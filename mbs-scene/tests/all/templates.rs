//! Templates: each can be read, and has outputs.

use mbs_scene::SceneFile;
use mbs_scene::templates::TEMPLATES;

#[test]
fn every_template_reads_says_what_it_is_and_has_outputs() {
    for template in TEMPLATES {
        let file = SceneFile::parse(template.text, template.name).expect("TOML");
        let scene = file.scene::<f64>().unwrap_or_else(|e| panic!("{}", e.render()));
        assert!(!scene.outputs.is_empty(), "{}", template.name);
        assert!(template.meaning().len() > 10, "{}", template.name);
        // A template has at most three screens of text, and a list of hard points may fill one of them.
        assert!(template.text.lines().count() <= 160, "{}", template.name);
    }
}
