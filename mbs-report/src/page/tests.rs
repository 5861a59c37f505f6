//! The page holds what it was given and refers to nothing outside.

use crate::page;
use mbs::record::*;
use mbs_core::outputs::Component;

fn record() -> RunRecord {
    let times: Vec<f64> = (0..20_000).map(|i| f64::from(i) * 1.0e-3).collect();
    let mut wave: Vec<f64> = times.iter().map(|t| t.sin()).collect();
    wave[12_345] = 9.876_54;
    let component = |label: &str| Component { label: label.into(), unit: "m".into() };
    let channel = Channel { name: "tip".into(), components: vec![component("x"), component("y")] };
    let frames = times.iter().map(|t| vec![0.0, 0.0, t.cos(), t.sin()]).collect();
    RunRecord {
        scene: "a </script><b>{{data}}".into(),
        channels: vec![ChannelSeries {
            channel,
            times: times.clone(),
            values: vec![wave.clone(), vec![f64::NAN; times.len()]],
        }],
        animation: Some(Animation {
            dimension: 2,
            times,
            frames,
            bodies: vec![Polyline { name: "rod".into(), chains: vec![vec![0, 1]] }],
            ..Default::default()
        }),
        ..Default::default()
    }
}

fn data(html: &str) -> serde_json::Value {
    let start = html.find("id=\"data\">").unwrap() + "id=\"data\">".len();
    let end = start + html[start..].find("</script>").unwrap();
    serde_json::from_str(&html[start..end]).unwrap()
}

#[test]
fn the_page_is_self_contained() {
    let html = page(&record());
    let links = html.replace("http://www.w3.org/2000/svg", "");
    for word in ["http:", "https:", "src=", "href=", "@import", "url("] {
        assert!(!links.contains(word), "{word}");
    }
    assert!(html.contains("<title>a &lt;/script&gt;&lt;b&gt;{{data}}</title>"));
    assert_eq!(html.matches("</script>").count(), 2);
}

#[test]
fn peaks_survive_and_gaps_are_null() {
    let json = data(&page(&record()));
    assert_eq!(json["scene"], "a </script><b>{{data}}");
    let lines = json["panels"][0]["lines"].as_array().unwrap();
    let y = lines[0]["y"].as_array().unwrap();
    assert!(y.len() <= 1500 && y.iter().any(|y| y == 9.876_54));
    assert!(lines[1]["y"].as_array().unwrap().iter().all(serde_json::Value::is_null));
    assert_eq!(json["motion"]["frames"].as_array().unwrap().len(), 1500);
}

#[test]
fn numbers_of_one_unit_share_a_panel_and_vectors_have_their_own() {
    let number = |name: &str, unit: &str| ChannelSeries {
        channel: Channel {
            name: name.into(),
            components: vec![Component { label: String::new(), unit: unit.into() }],
        },
        times: vec![0.0],
        values: vec![vec![1.0]],
    };
    let mut record = record();
    record.channels.extend([number("a", "rad"), number("b", "m"), number("c", "rad")]);
    let json = data(&page(&record));
    let titles: Vec<_> =
        json["panels"].as_array().unwrap().iter().map(|p| p["title"].as_str().unwrap()).collect();
    assert_eq!(titles, ["tip", "a, c", "b"]);
    assert_eq!(json["panels"][1]["caption"], "Outputs a, c over time [rad].");
}

#[test]
fn lists_of_uneven_length_do_not_panic() {
    let mut record = record();
    record.channels[0].values[0].truncate(3);
    record.energy = Some(EnergySeries { times: vec![0.0; 4], ..Default::default() });
    record.violation = Some(ViolationSeries::default());
    record.iterations = Some(IterationSeries { times: vec![0.0], counts: vec![] });
    assert!(page(&record).len() > 1000);
}
