//! Roads: every feature is read to the intended data, in all notations. Faults have the place of their feature.

use super::effects::{CAR, CART};
use super::{read, refused, spoil};
use mbs_core::scene::*;

/// The car of the effects' tests on another road.
fn road(text: &str) -> String {
    let (head, _) = CAR.split_once("[road]").expect("a road");
    format!("{head}[road]\n{text}\n")
}

fn rise(start: f64, length: f64, height: f64, rounding: f64) -> RoadFeature<f64> {
    RoadFeature::Rise { start, length, height, rounding }
}

#[test]
fn features_add_up_under_all_wheels() {
    let expected = vec![
        RoadFeature::Flat { height: -0.1 },
        rise(10.0, 5.0, 1.0, 0.5),
        RoadFeature::Stairs { start: 30.0, tread: 1.5, riser: 0.5, height: -0.125, count: 3 },
        RoadFeature::Bump { start: 50.0, length: 1.0, amplitude: 0.05 },
        RoadFeature::Bump { start: 60.0, length: 5.0, amplitude: -0.1 },
        RoadFeature::Table(vec![[70.0, 0.0], [75.0, 0.1], [80.0, 0.0]]),
    ];
    let Road { left, right, speed } = read(CAR).unwrap().road;
    assert_eq!((&left, speed), (&expected, 5.0));
    assert_eq!(right, expected);
}

#[test]
fn one_feature_may_stand_in_the_road_and_tracks_may_differ() {
    let one = read(&road("kind = \"flat\"\nheight = 0.2\nspeed = 3")).unwrap().road;
    let flat = vec![RoadFeature::Flat { height: 0.2 }];
    assert_eq!(one, Road { left: flat.clone(), right: flat, speed: 3.0 });
    let level = read(&road("speed = 3")).unwrap().road;
    assert_eq!(level, Road { left: vec![], right: vec![], speed: 3.0 });
    let bump = "{ kind = \"bump\", start = 1, length = 5, amplitude = 0.1, shape = \"1-cos\" }";
    let two = read(&road(&format!("left = {bump}\nright = []"))).unwrap().road;
    let bump = vec![RoadFeature::Bump { start: 1.0, length: 5.0, amplitude: 0.1 }];
    assert_eq!(two, Road { left: bump, right: vec![], speed: 0.0 });
    let tables = "[[road.left]]\nkind = \"flat\"\n[[road.right]]\nkind = \"flat\"";
    let two = read(&road(tables)).unwrap().road;
    assert_eq!(two.right, vec![RoadFeature::Flat { height: 0.0 }]);
}

#[test]
fn wrong_keys_of_roads_are_refused_with_the_right_ones() {
    let e = spoil(CAR, "kind = \"ramp\"", "kind = \"slope\"");
    refused(&e, "68:12", "unknown kind `slope`", "choices: flat, ramp, stairs, bump, table");
    let e = spoil(CAR, "kind = \"flat\", height", "kind = \"flat\", hight");
    refused(&e, "67:20", "unknown key `hight`", "did you mean `height`?");
    let e = spoil(CAR, "kind = \"flat\", height", "kind = \"flat\", length");
    refused(&e, "67:20", "`length` has no meaning here", "keys: kind, height");
    let e = read(&road("sped = 5")).unwrap_err();
    refused(&e, "66:1", "unknown key `sped`", "did you mean `speed`?");
    let e = read(&road("height = 5")).unwrap_err();
    refused(&e, "66:1", "`height` has no meaning here", "keys: features, left, right, speed");
}

#[test]
fn wrong_numbers_of_roads_are_refused_at_their_feature() {
    let e = spoil(CAR, "length = 5, height = 1 }", "length = 5, height = 1, rounding = 3 }");
    let message = "`rounding` is 3, which is more than half the length, 2.5";
    refused(&e, "68:67", message, "at most half");
    let e = spoil(CAR, "count = 3", "count = 2.5");
    refused(&e, "69:85", "`2.5` does not count anything", "whole number from 1 to 10000");
    let e = spoil(CAR, "riser = 0.5", "riser = 0");
    refused(&e, "69:55", "`riser` must be larger than zero, but is 0", "larger than zero");
    let e = spoil(CAR, "tread = 1.5", "tread = -1.5");
    refused(&e, "69:42", "`tread` must not be negative, but is -1.5", "zero or more");
    let e = spoil(CAR, "amplitude = 0.05", "amplitude = 0.05, height = 0.1");
    refused(&e, "70:71", "both `amplitude` and `height` are given", "keep one");
    let e = spoil(CAR, "shape = \"cosine\"", "shape = \"sine\"");
    refused(&e, "71:67", "unknown shape `sine`", "did you mean `cosine`?");
    let e = spoil(CAR, "[75, 0.1]", "[70, 0.1]");
    refused(&e, "72:40", "`points` has x that does not increase at point 2", "sort the points");
    let e = spoil(CAR, "[75, 0.1]", "[75, 0.1, 0]");
    refused(&e, "72:40", "expected 2 entries, found 3", "write 2");
}

#[test]
fn hollows_too_tight_for_a_wheel_are_refused_at_their_feature() {
    // The largest wheel has 0.364325 m; curvature of the riser: h'' = 4 |height| / riser^2.
    let e = spoil(CAR, "riser = 0.5", "riser = 0.25");
    let message =
        "`height` makes a hollow of radius 0.1250 m, too tight for a wheel of radius 0.364325 m";
    refused(&e, "69:70", message, "round the hollow");
    let e = spoil(CAR, "length = 1,", "length = 0.8,");
    let message =
        "`length` makes a hollow of radius 0.3242 m, too tight for a wheel of radius 0.364325 m";
    refused(&e, "70:41", message, "round the hollow");
    let tracks = "left = []\nright = [\n  { kind = \"flat\" },\n  { kind = \"bump\", start = 0, \
                  length = -1, amplitude = 0 },\n]";
    let e = read(&road(tracks)).unwrap_err();
    refused(&e, "69:40", "`length` must be larger than zero, but is -1", "larger than zero");
}

#[test]
fn both_tracks_are_needed_in_space_and_one_in_the_plane() {
    let e = read(&road("left = []")).unwrap_err();
    refused(&e, "65:1", "`right` is missing", "`right = []` is level ground");
    let e = read(&road("features = []\nleft = []")).unwrap_err();
    refused(&e, "67:8", "both `features` and `left` are given", "keep one");
    let e = read(&road("kind = \"flat\"\nfeatures = []")).unwrap_err();
    refused(&e, "67:12", "both `kind` and `features` are given", "keep one");
    let flat = "[road]\nleft = []\nright = { kind = \"flat\", height = 1 }\n";
    let e = read(&format!("{CART}{flat}")).unwrap_err();
    refused(&e, "54:9", "`right` needs a spatial scene", "dimension = 3");
}
