//! Tests of pages: a page contains its data and refers to no other file or address.

use super::pack::tests::unpacked;
use crate::page;
use mbs::record::*;
use mbs_core::outputs::Component;

fn component(label: &str, unit: &str) -> Component {
    Component { label: label.into(), unit: unit.into() }
}

fn record() -> RunRecord {
    let times: Vec<f64> = (0..20_000).map(|i| f64::from(i) * 1.0e-3).collect();
    let mut wave: Vec<f64> = times.iter().map(|t| t.sin()).collect();
    wave[12_345] = 9.876_54;
    let channel = Channel {
        name: "tip".into(),
        components: vec![component("x", "m"), component("y", "m")],
        ..Channel::default()
    };
    let pose = |t: &f64| [t.cos(), t.sin(), 0.0, (t / 2.0).cos(), 0.0, 0.0, (t / 2.0).sin()];
    let poses = times.iter().flat_map(pose).collect();
    RunRecord {
        scene: "a </script><b>{{data}}".into(),
        channels: vec![ChannelSeries {
            channel,
            times: times.clone(),
            values: vec![wave.clone(), vec![f64::NAN; times.len()]],
            ..ChannelSeries::default()
        }],
        motion: Some(RecordedMotion {
            dimension: 2,
            length: 1.0,
            times,
            poses,
            bodies: vec![DrawnBody { name: "rod".into(), mass: 1.0 }],
            ..Default::default()
        }),
        ..Default::default()
    }
}

/// Returns the text of a script element.
fn script<'a>(html: &'a str, id: &str) -> &'a str {
    let mark = format!("id=\"{id}\">");
    let start = html.find(&mark).unwrap() + mark.len();
    &html[start..start + html[start..].find("</script>").unwrap()]
}

/// Columns of whole numbers, by group.
pub(crate) type Groups = Vec<Vec<Vec<i64>>>;

/// Returns the header of a page's pack, and its columns.
pub(crate) fn data(html: &str) -> (serde_json::Value, Groups) {
    unpacked(script(html, "pack"))
}

/// Returns the values of a column that a header refers to.
fn numbers(column: &serde_json::Value, groups: &Groups) -> Vec<f64> {
    let index = |key: &str| usize::try_from(column[key].as_u64().unwrap()).unwrap();
    let [low, step] = ["low", "step"].map(|key| column[key].as_f64().unwrap());
    let whole = &groups[index("group")][index("column")];
    #[allow(clippy::cast_precision_loss, reason = "far below 2^53")]
    whole.iter().map(|x| low + step * *x as f64).collect()
}

#[test]
fn the_page_is_self_contained() {
    let html = page(&record());
    let links = html.replace("http://www.w3.org/2000/svg", "");
    for word in ["http:", "https:", "src=", "href=", "@import", "url("] {
        assert!(!links.contains(word), "{word}");
    }
    assert!(html.contains("<title>a &lt;/script&gt;&lt;b&gt;{{data}}</title>"));
    assert_eq!(html.matches("</script>").count(), 3);
}

#[test]
fn the_licence_of_the_library_stands_in_the_page_that_contains_it() {
    let html = page(&record());
    assert!(script(&html, "three").len() > 100_000 && html.contains("three.js authors"));
    let without = page(&RunRecord::default());
    assert!(script(&without, "three").is_empty() && !without.contains("three.js authors"));
}

#[test]
fn peaks_survive_and_gaps_are_gaps() {
    let (header, groups) = data(&page(&record()));
    let lines = header["panels"][0]["lines"].as_array().unwrap();
    let y = numbers(&lines[0]["y"], &groups);
    // the peak is the largest value, so it is the end of the column's range, which is packed exactly
    let peak = y.iter().copied().fold(0.0, f64::max);
    assert!(y.len() <= 1500 && (peak - 9.876_54).abs() < 1e-9, "{} points, {peak}", y.len());
    let gaps = &header["panels"][1]["lines"][0]["y"];
    let group = usize::try_from(gaps["group"].as_u64().unwrap()).unwrap();
    assert!(groups[group][0].iter().all(|whole| *whole == 65_535));
    let times = numbers(&header["motion"]["times"], &groups);
    assert_eq!(times.len(), 600);
}

#[test]
fn places_and_turns_are_those_of_the_run_to_the_steps_that_they_are_packed_by() {
    let (header, groups) = data(&page(&record()));
    let motion = &header["motion"];
    let times = numbers(&motion["times"], &groups);
    let x = numbers(&motion["places"][0], &groups);
    let z = numbers(&motion["turns"][3], &groups);
    for ((t, x), z) in times.iter().zip(x).zip(z) {
        // half of the steps: 1e-5 of a metre, 2^-14, and 1e-6 of twenty seconds
        assert!((x - t.cos()).abs() < 2e-5, "{t}");
        assert!((z - (t / 2.0).sin()).abs() < 5e-5, "{t}");
    }
}

fn number(name: &str, unit: &str, values: [f64; 2]) -> ChannelSeries {
    ChannelSeries {
        channel: Channel {
            name: name.into(),
            components: vec![Component { label: String::new(), unit: unit.into() }],
            ..Channel::default()
        },
        times: vec![0.0, 1.0],
        values: vec![values.to_vec()],
        ..ChannelSeries::default()
    }
}

#[test]
fn the_page_has_the_peaks_of_each_component_and_when_they_came() {
    let mut record = record();
    record.channels[0].stats = vec![ComponentStatistics {
        label: "x".into(),
        unit: "m".into(),
        of: Statistics {
            min: -1.0,
            at_min: 4.5,
            max: 9.87654,
            at_max: 12.345,
            rms: 0.7,
            end: 0.25,
        },
        ..ComponentStatistics::default()
    }];
    let row = ["tip.x", "m", "-1", "4.5", "9.87654", "12.345", "0.7", "0.25"];
    let row: String = row.iter().map(|cell| format!("<td>{cell}</td>")).collect();
    let html = page(&record).replace("<th scope=\"row\">tip.x</th>", "<td>tip.x</td>");
    let html = html.replace("<td class=\"number\">", "<td>");
    assert!(html.contains(&row), "{}", &html[html.find("Statistics").unwrap_or(0)..][..600]);
}

#[test]
fn numbers_of_one_unit_share_a_panel_unless_their_ranges_are_far_apart() {
    let mut record = record();
    record.channels = vec![
        number("a", "rad", [0.0, 1.0]),
        number("b", "m", [0.0, 1.0]),
        number("c", "rad", [5.0, 5.1]),
        number("d", "rad", [0.0, 50.0]),
    ];
    let html = page(&record);
    let (json, _) = data(&html);
    let titles: Vec<_> =
        json["panels"].as_array().unwrap().iter().map(|p| p["title"].as_str().unwrap()).collect();
    assert_eq!(titles, ["a, c", "b", "d"]);
    assert!(html.contains("Outputs a, c over time [rad]."));
}

#[test]
fn forces_are_drawn_from_the_lines_of_their_channel() {
    let mut record = record();
    let times = record.channels[0].times.clone();
    let wave = |phase: f64| times.iter().map(|t| 300.0 * (t + phase).sin()).collect();
    record.channels.push(ChannelSeries {
        channel: Channel {
            name: "pin".into(),
            components: ["Fx", "Fy", "Mz"].map(|label| component(label, "N")).into(),
            ..Channel::default()
        },
        values: vec![wave(0.0), wave(1.0), wave(2.0)],
        times: times.clone(),
        ..ChannelSeries::default()
    });
    let of = |name: &str| {
        let point = DrawnPoint { name: name.into(), ..DrawnPoint::default() };
        DrawnForce { point, axes: None }
    };
    // `tip` is not a force, and no channel has the name `none`
    record.motion.as_mut().unwrap().forces = vec![of("pin"), of("tip"), of("none")];
    let (header, groups) = data(&page(&record));
    let forces = header["motion"]["forces"].as_array().unwrap();
    assert_eq!(forces.len(), 1);
    let place = |i: usize| usize::try_from(forces[0]["parts"][1][i].as_u64().unwrap()).unwrap();
    let line = &header["panels"][place(0)]["lines"][place(1)];
    assert_eq!(line["name"], "pin.Fy");
    let times = numbers(&line["t"], &groups);
    assert!(times.len() > 100);
    for (t, force) in times.iter().zip(numbers(&line["y"], &groups)) {
        // a step is 1/65534 of the range of 600 N; rows are 1 ms apart
        assert!((force - 300.0 * (t + 1.0).sin()).abs() < 0.01, "{t}");
    }
}

#[test]
fn what_stands_still_is_listed_and_not_drawn() {
    let mut record = record();
    record.channels = vec![
        number("moves", "m", [0.0, 1.0]),
        number("rests", "m", [2.5, 2.5]),
        number("still", "rad", [0.0, 1e-14]),
    ];
    let html = page(&record);
    let (json, _) = data(&html);
    assert_eq!(json["panels"].as_array().unwrap().len(), 1);
    assert!(html.contains("<td>rests</td><td>2.5 m</td>"));
}

#[test]
fn lists_of_uneven_length_do_not_panic() {
    let mut record = record();
    record.channels[0].values[0].truncate(3);
    record.energy = Some(EnergySeries { times: vec![0.0; 4], ..Default::default() });
    record.violation = Some(ViolationSeries::default());
    record.iterations = Some(IterationSeries { times: vec![0.0], counts: vec![] });
    record.motion.as_mut().unwrap().poses.truncate(30);
    assert!(page(&record).len() > 1000);
}

#[test]
fn a_page_of_noise_stays_below_four_megabytes_and_says_what_it_left_out() {
    let times: Vec<f64> = (0..1500).map(f64::from).collect();
    // random values: each needs the two bytes of a step, so the pack cannot become smaller
    let noise = |seed: u32| -> Vec<f64> {
        let mut x = seed;
        let next = |_| {
            x = x.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(x)
        };
        (0..1500).map(next).collect()
    };
    let channel = |i: u32| ChannelSeries {
        times: times.clone(),
        values: vec![noise(i)],
        ..number(&format!("channel {i}"), &format!("unit {i}"), [0.0, 1.0])
    };
    let record = RunRecord { channels: (0..1600).map(channel).collect(), ..Default::default() };
    let html = page(&record);
    assert!(html.len() < 4_000_000, "{}", html.len());
    assert!(html.contains("run.csv has all rows"));
}

/// Returns the gaps between the rear wheels and the drawn road at a time [m], and the time of the picture [s]. A gap is negative where the
/// tire is compressed.
fn rear_gaps(motion: &serde_json::Value, groups: &Groups, t: f64) -> ([f64; 2], f64) {
    let times = numbers(&motion["times"], groups);
    let apart = |i: &usize| (times[*i] - t).abs();
    let k = (0..times.len()).min_by(|i, j| apart(i).total_cmp(&apart(j))).unwrap();
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let of = |key: &str, i: usize| numbers(&motion[key][i], groups)[k];
    let centre = |wheel: &serde_json::Value| {
        let body = usize::try_from(wheel["body"].as_u64().unwrap()).unwrap();
        let [w, x, y, z] = [0, 1, 2, 3].map(|i| of("turns", 4 * body + i));
        let p = [0, 1, 2].map(|i| number(&wheel["at"][i]));
        let a = y * p[2] - z * p[1] + w * p[0];
        let b = z * p[0] - x * p[2] + w * p[1];
        let c = x * p[1] - y * p[0] + w * p[2];
        let at = [0, 2].map(|i| of("places", 3 * body + i));
        let x_place = at[0] + p[0] + 2.0 * (y * c - z * b);
        (x_place, at[1] + p[2] + 2.0 * (x * b - y * a), number(&wheel["radius"]))
    };
    let shapes = motion["shapes"].as_array().unwrap();
    let wheels = shapes.iter().filter(|s| s["form"] == "wheel");
    let mut centres: Vec<(f64, f64, f64)> = wheels.map(centre).collect();
    assert_eq!(centres.len(), 4);
    centres.sort_by(|a, b| a.0.total_cmp(&b.0));
    let road = &motion["road"];
    let [start, spacing] = ["start", "spacing"].map(|key| number(&road[key]));
    let heights = numbers(&road["heights"][0], groups);
    let gap = |&(x, z, radius): &(f64, f64, f64)| {
        let mut from = start;
        let apart = heights.windows(2).map(|pair| {
            let (dx, dz) = (spacing, pair[1] - pair[0]);
            let along = ((x - from) * dx + (z - pair[0]) * dz) / (dx * dx + dz * dz);
            let s = along.clamp(0.0, 1.0);
            let far = (x - from - s * dx).hypot(z - pair[0] - s * dz);
            from += spacing;
            far
        });
        apart.fold(f64::INFINITY, f64::min) - radius
    };
    ([gap(&centres[0]), gap(&centres[1])], times[k])
}

#[test]
fn the_rear_wheels_stand_on_the_drawn_road_at_the_start_and_at_the_landing_behind_the_stairs() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/iltis-stairs.toml");
    let text = std::fs::read_to_string(path).expect("a scene");
    let document = mbs_scene::SceneFile::parse(&text, path).expect("a scene file");
    let scene = document.scene::<f64>().expect("a scene");
    let asked = mbs::Method { duration: Some(6.5), ..mbs::Method::default() };
    let settings = mbs::ResolvedMethod::new(&scene, &asked).expect("settings");
    let outcome = mbs::typed::run::<f64, 3>(&scene, &settings, &mut ());
    let (header, groups) = data(&page(&outcome.record(Provenance::default())));
    // each tire carries 3593 N at rest and has a stiffness of 460000 N/m, which gives a compression of 7.8 mm
    let (still, _) = rear_gaps(&header["motion"], &groups, 0.0);
    assert!(still.iter().all(|gap| (gap + 0.0078).abs() < 1e-3), "{still:?}");
    // at the landing each tire carries three times this force
    let (landing, t) = rear_gaps(&header["motion"], &groups, 6.4);
    assert!(landing.iter().all(|gap| (-0.03..0.0).contains(gap)), "{landing:?} at t = {t} s");
}

fn page_of(file: &mbs_scene::SceneFile) -> String {
    let mechanism = mbs::Mechanism::of_file(file.clone()).expect("a scene");
    let result = mbs::run(&mechanism, &mbs::Run::new()).expect("a run");
    page(&result.outcome().record(Provenance::default()))
}

#[test]
fn a_shape_of_the_scene_stands_for_the_inertia_of_its_body() {
    let text = "\
[scene]
dimension = 3
duration = 0.01

[[body]]
name = \"plate\"
mass = 1.0
center = [1.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]

[[shape]]
body = \"plate\"
box = { center = [1.0, 0.0, 2.0], size = [2.0, 4.0, 6.0], axes = [[0, 2, 0], [0, 1, 1]] }
colour = \"#ff8000\"
opacity = 0.5
";
    let file = mbs_scene::SceneFile::parse(text, "plate.toml").expect("TOML");
    let html = page_of(&file);
    let (header, _) = data(&html);
    let boxes: Vec<_> = header["motion"]["shapes"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|shape| shape["body"] == 0 && shape["form"] != "stroke")
        .collect();
    let [shape] = boxes[..] else { panic!("{boxes:?}") };
    // positions are relative to the centre of mass; the second axis is the part of the given axis orthogonal to the first
    assert_eq!(shape["form"], "box");
    assert_eq!(shape["at"], serde_json::json!([0.0, 0.0, 2.0]));
    assert_eq!(shape["half"], serde_json::json!([1.0, 2.0, 3.0]));
    assert_eq!(
        shape["axes"],
        serde_json::json!([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])
    );
    assert_eq!((&shape["colour"], &shape["opacity"]), (&"#ff8000".into(), &0.5.into()));
}

#[test]
fn a_mesh_is_drawn_and_one_that_cannot_be_read_is_a_note_with_the_inertia_in_its_place() {
    let folder = std::env::temp_dir().join(format!("mbs-mesh-page-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    // a square with more triangles than a page may have
    let n = 130;
    let corner = |i: usize| format!("v {} {} 0\n", i % n, i / n);
    let face = |i: usize| {
        let first = i / (n - 1) * n + i % (n - 1) + 1;
        format!("f {first} {} {} {}\n", first + 1, first + n + 1, first + n)
    };
    let square: String = (0..n * n).map(corner).chain((0..(n - 1) * (n - 1)).map(face)).collect();
    std::fs::write(folder.join("square.obj"), square).expect("a file");
    std::fs::write(folder.join("empty.stl"), "solid\nendsolid\n").expect("a file");
    std::fs::write(folder.join("broken.stl"), "solid\nvertex 1 x 2\n").expect("a file");
    let body = |name: &str, mesh: &str| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = 1.0\ncenter = [0.0, 0.0, 0.0]\ninertia = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]\n\
             [[shape]]\nbody = \"{name}\"\nmesh = {{ file = \"{mesh}\", at = [1, 2, 3], scale = 2 }}\n"
        )
    };
    let text = "[scene]\ndimension = 3\nduration = 0.1\n".to_owned()
        + &body("square", "square.obj")
        + &body("broken", "broken.stl")
        + &body("missing", "none.stl")
        + &body("empty", "empty.stl");
    let file = mbs_scene::SceneFile::parse_in(&text, "meshes.toml", &folder).expect("TOML");
    let html = page_of(&file);
    let (header, groups) = data(&html);
    let shapes = header["motion"]["shapes"].as_array().expect("shapes");
    let forms = |body: usize| -> Vec<_> {
        let own = shapes.iter().filter(|shape| shape["body"] == body);
        own.map(|shape| shape["form"].as_str().expect("a word")).collect()
    };
    assert_eq!(forms(0), ["mesh"]);
    assert!(forms(1).contains(&"box") && forms(2).contains(&"box"), "{shapes:?}");
    assert!(!html.contains(r#""file":"#), "a page has no paths");
    let square = &header["motion"]["meshes"][0];
    let group =
        usize::try_from(square["triangles"][0]["group"].as_u64().expect("a group")).unwrap();
    let drawn = groups[group][0].len();
    assert!((12_000..=20_000).contains(&drawn), "{drawn}");
    for note in [
        "3 mesh files",
        "broken.stl (a vertex without three numbers)",
        "Of 33282 triangles of meshes",
    ] {
        assert!(html.contains(note), "{note}");
    }
    // the cells for a large ground are so wide that all triangles of a small part vanish: its inertia is drawn instead
    std::fs::write(folder.join("small.obj"), "v 0 0 0\nv 0.01 0 0\nv 0 0.01 0\nf 1 2 3\n")
        .expect("a file");
    let text = "[scene]\ndimension = 3\nduration = 0.1\n".to_owned()
        + &body("square", "square.obj")
        + &body("small", "small.obj");
    let file = mbs_scene::SceneFile::parse_in(&text, "meshes.toml", &folder).expect("TOML");
    let html = page_of(&file);
    let shapes = data(&html).0["motion"]["shapes"].clone();
    let of_small = |shape: &&serde_json::Value| shape["body"] == 1;
    let shapes = shapes.as_array().expect("shapes");
    assert!(shapes.iter().filter(of_small).any(|shape| shape["form"] == "box"), "{shapes:?}");
    assert!(!html.contains(&folder.display().to_string()), "a page has no folders");
    std::fs::remove_dir_all(&folder).expect("it is there");
}
