//! Tests of the numbers in generated scenes.

use mbs_scene::inside::number;

#[test]
fn multiples_of_decimal_numbers_stay_short() {
    let texts = [0.2 * 3.0, 0.97 - 8.0, -0.0, 1e-7].map(|x| number(x).text());
    assert_eq!(texts, ["0.6", "-7.03", "0.0", "1e-7"]);
}
