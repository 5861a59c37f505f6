//! Double-double numbers, compared with arithmetic of at least 400 bits.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "tests; infinities and zeros are compared"
)]

use dashu_float::{FBig, round::mode::HalfEven};
use mbs_math::Real;
use mbs_math::real::DoubleDouble;
use proptest::prelude::*;

type Big = FBig<HalfEven, 2>;

/// Precision of the reference arithmetic [bits]. Its errors of 2⁻⁴⁰⁰ are negligible compared with 2⁻¹⁰⁶.
const BITS: usize = 400;

fn big(x: f64) -> Big {
    Big::try_from(x).unwrap().with_precision(BITS).value()
}

fn exact(x: DoubleDouble) -> Big {
    // Parts of very different size need all bits between them.
    let wide = |x: f64| big(x).with_precision(2400).value();
    wide(x.hi()) + wide(x.lo())
}

/// The error |got − wanted| in units of u², relative to `size`.
fn error_in_u2(got: DoubleDouble, wanted: &Big, size: &Big) -> f64 {
    let off = exact(got) - wanted;
    let off = if off < Big::ZERO { -off } else { off };
    if off == Big::ZERO {
        return 0.0;
    }
    let size = if *size < Big::ZERO { -size.clone() } else { size.clone() };
    let share = (off / size).with_precision(60).value();
    share.to_f64().value() * 2f64.powi(106)
}

fn relative(got: DoubleDouble, wanted: &Big) -> f64 {
    error_in_u2(got, wanted, wanted)
}

/// Double-double numbers with all bits in use, of sizes 2^±range. Some have a second part that is much smaller, or none.
fn numbers(range: i32) -> impl Strategy<Value = DoubleDouble> {
    let parts = (any::<bool>(), 1.0..2.0_f64, -range..=range, -1.0..1.0_f64, 0..60_i32);
    parts.prop_map(|(is_negative, m, exponent, lo, gap)| {
        let hi = m * 2f64.powi(exponent);
        let lo = if gap > 50 { 0.0 } else { lo * hi * 2f64.powi(-53 - gap / 2) };
        let x = DoubleDouble::from_sum(hi, lo);
        if is_negative { -x } else { x }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// The bound of a sum is 3 u² + 13 u³, for terms of any signs.
    #[test]
    fn sums_are_within_three_u2(x in numbers(60), y in numbers(60)) {
        prop_assert!(relative(x + y, &(exact(x) + exact(y))) <= 3.0001);
        prop_assert!(relative(x - y, &(exact(x) - exact(y))) <= 3.0001);
    }

    /// The bound is relative to the sum, even when the terms nearly cancel.
    #[test]
    fn sums_that_cancel_are_within_three_u2(x in numbers(20), part in numbers(20), small in 0..110_i32) {
        let y = -(x + x * part * DoubleDouble::from_f64(2f64.powi(-small)));
        let wanted = exact(x) + exact(y);
        prop_assert!(wanted == Big::ZERO || relative(x + y, &wanted) <= 3.0001);
    }

    #[test]
    fn products_are_within_seven_u2(x in numbers(200), y in numbers(200)) {
        prop_assert!(relative(x * y, &(exact(x) * exact(y))) <= 7.0);
    }

    #[test]
    fn quotients_are_within_fifteen_u2(x in numbers(200), y in numbers(200)) {
        let wanted = exact(x) / exact(y);
        prop_assert!(relative(x / y, &wanted) <= 15.0001);
    }

    #[test]
    fn roots_are_within_25_eighths_u2(x in numbers(300)) {
        let x = x.abs();
        prop_assert!(relative(x.sqrt(), &exact(x).sqrt()) <= 3.126);
    }

    /// The documented bound 2⁻¹⁰² is 16 u².
    #[test]
    fn sine_and_cosine_are_within_16_u2(x in numbers(20)) {
        let (sine, cosine) = x.sin_cos();
        let (wanted_sine, wanted_cosine) = exact(x).sin_cos();
        prop_assert!(relative(sine, &wanted_sine) <= 16.0, "{x}: {}", relative(sine, &wanted_sine));
        prop_assert!(relative(cosine, &wanted_cosine) <= 16.0, "{x}: {}", relative(cosine, &wanted_cosine));
    }

    /// At quarter turns all digits of the leading terms cancel, and the later terms of π give the remainder.
    #[test]
    fn sine_and_cosine_are_within_16_u2_at_quarter_turns(k in -3000..3000_i32, ulps in -4.0..4.0_f64) {
        let at = DoubleDouble::PI * DoubleDouble::from_f64(f64::from(k) * 0.5);
        let x = at + DoubleDouble::from_f64(ulps * at.hi() * 2f64.powi(-105));
        let (sine, cosine) = x.sin_cos();
        let (wanted_sine, wanted_cosine) = exact(x).sin_cos();
        prop_assert!(wanted_sine == Big::ZERO || relative(sine, &wanted_sine) <= 16.0);
        prop_assert!(relative(cosine, &wanted_cosine) <= 16.0);
    }

    /// The documented bound 2⁻¹⁰⁰ is 64 u².
    #[test]
    fn angles_are_within_64_u2(y in numbers(60), x in numbers(60)) {
        let wanted = exact(y).atan2(&exact(x));
        prop_assert!(relative(y.atan2(x), &wanted) <= 64.0, "{}", relative(y.atan2(x), &wanted));
    }

    /// Text of 40 digits: the nearest double-double is within u²/2, and the rounding of the quotient adds much less.
    #[test]
    fn decimal_text_is_read_to_one_u2(
        first in 1..10_u64,
        digits in (0..10_000_000_000_000_000_000_u64, 0..10_000_000_000_000_000_000_u64),
        n in 1..38_usize,
        exponent in -250..250_i32,
        is_negative in any::<bool>(),
    ) {
        let whole = format!("{:019}{:019}", digits.0, digits.1);
        let (sign, fraction) = (if is_negative { "-" } else { "" }, &whole[..n]);
        let text = format!("{sign}{first}.{fraction}e{exponent}");
        let ten = |n: i32| Big::from(10).with_precision(3000).value().powi(n.into());
        let number = Big::from(format!("{first}{fraction}").parse::<u128>().unwrap());
        let size = number * ten(exponent - n as i32);
        let wanted = if is_negative { -size } else { size };
        let got = DoubleDouble::from_decimal(&text).unwrap();
        prop_assert!(relative(got, &wanted) <= 1.0, "{text}: {}", relative(got, &wanted));
    }

    /// Half a unit of the 32nd digit is at most 5e-32 of the number, which is 4.06 u².
    #[test]
    fn text_of_32_digits_leads_back_to_the_number(x in numbers(300)) {
        for text in [format!("{x}"), format!("{x:e}")] {
            let back = DoubleDouble::from_decimal(&text).unwrap();
            prop_assert!(relative(back, &exact(x)) <= 5.1, "{text}");
        }
        // With 40 digits the text gives the number back, except for the rounding error of reading.
        let back = DoubleDouble::from_decimal(&format!("{x:.40e}")).unwrap();
        prop_assert!(relative(back, &exact(x)) <= 1.0);
    }

    /// A double-double number of 53 bits has the text of the equal `f64`, when both are written with the same number of digits.
    #[test]
    fn plain_numbers_are_written_as_f64_writes_them(x in -1e6..1e6_f64, small in -300..300_i32, p in 0..17_usize) {
        let y = x * 2f64.powi(small);
        prop_assert_eq!(format!("{:.p$e}", DoubleDouble::from_f64(y)), format!("{y:.p$e}"));
        prop_assert_eq!(format!("{:.p$}", DoubleDouble::from_f64(x)), format!("{x:.p$}"));
        prop_assert_eq!(format!("{:+30.p$}", DoubleDouble::from_f64(x)), format!("{x:+30.p$}"));
        prop_assert_eq!(format!("{:<030.p$}", DoubleDouble::from_f64(x)), format!("{x:<030.p$}"));
        prop_assert_eq!(format!("{:_^40.p$}", DoubleDouble::from_f64(x)), format!("{x:_^40.p$}"));
    }

    #[test]
    fn order_is_the_order_of_the_numbers(x in numbers(3), y in numbers(3), bit in -1..=1_i32) {
        let near = x + DoubleDouble::from_f64(f64::from(bit) * x.hi() * 2f64.powi(-100));
        for other in [y, near] {
            prop_assert_eq!(x.partial_cmp(&other), exact(x).partial_cmp(&exact(other)));
        }
    }

    #[test]
    fn what_f64_reads_is_read_and_nothing_else(text in "[-+]?[0-9]{0,3}\\.?[0-9]{0,3}([eE][-+]?[0-9]{1,3})?") {
        let got = DoubleDouble::from_decimal(&text);
        prop_assert_eq!(got.map(DoubleDouble::hi), text.parse::<f64>().ok());
    }
}

#[test]
fn near_the_end_of_the_range_the_leading_part_stays_the_nearest() {
    for text in ["12e-308", "-12e-308", "1.2e-307", "3e-324", "7.3e-320"] {
        let read = DoubleDouble::from_decimal(text).map(DoubleDouble::hi);
        assert_eq!(read, text.parse::<f64>().ok(), "{text}");
    }
}

fn number(x: f64) -> DoubleDouble {
    DoubleDouble::from_f64(x)
}

/// The written digits of π are those of published tables.
#[test]
fn known_numbers_are_written_to_32_digits() {
    assert_eq!(DoubleDouble::PI.to_string(), "3.1415926535897932384626433832795");
    assert_eq!(number(2.0).sqrt().to_string(), "1.4142135623730950488016887242097");
    assert_eq!(format!("{:e}", number(1.0) / number(3.0)), "3.3333333333333333333333333333333e-1");
    for text in ["0.1", "9.81", "-0.00022", "4530", "0.028", "1234567890123456789012345678901.2"] {
        assert_eq!(DoubleDouble::from_decimal(text).unwrap().to_string(), text);
    }
    assert_eq!(number(0.0).to_string(), "0");
    assert_eq!(format!("{:e}", number(-0.0)), "-0e0");
    assert_eq!(format!("{:.3e}", number(0.0)), "0.000e0");
    assert_eq!(format!("{:.2}", number(0.0)), "0.00");
    assert_eq!(format!("{:.2}", number(0.005)), format!("{:.2}", 0.005));
    assert_eq!(format!("{:.0}", number(0.5)), "0");
    assert_eq!(format!("{:.0}", number(1.5)), "2");
    assert_eq!(format!("{:.1}", number(9.96)), "10.0");
    assert_eq!(format!("{:.2}", number(9e-5)), "0.00");
    assert_eq!(
        format!("{:e}", number(f64::MAX)),
        "1.7976931348623157081452742373170e308".replace("170e", "17e")
    );
    assert_eq!(format!("{:.16e}", number(5e-324)), format!("{:.16e}", 5e-324));
}

#[test]
fn infinities_zeros_and_nan_are_those_of_f64() {
    let values = [0.0, -0.0, 1.0, -2.5, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
    let same = |a: DoubleDouble, b: f64| a.hi() == b || (a.hi().is_nan() && b.is_nan());
    for x in values {
        for y in values {
            let (a, b) = (number(x), number(y));
            assert!(same(a + b, x + y), "{x} + {y}");
            assert!(same(a - b, x - y), "{x} - {y}");
            assert!(same(a / b, x / y), "{x} / {y}");
            assert!(same(a * b, x * y), "{x} * {y}");
            assert!(same(a.atan2(b), y_of(x, y)), "atan2({x}, {y})");
            assert_eq!(a.partial_cmp(&b), x.partial_cmp(&y));
        }
        assert!(same(number(x).sqrt(), x.sqrt()), "root of {x}");
        assert_eq!(Real::is_finite(number(x)), x.is_finite());
        assert_eq!(number(x).to_string(), x.to_string());
    }
    // A factor above 2^996 is not split; the product is then that of f64.
    assert!(same(number(f64::MAX) * number(0.3), f64::MAX * 0.3));
    assert!(same(number(f64::MAX) * number(1.3), f64::INFINITY));
    for x in [f64::INFINITY, f64::NAN, 1e300] {
        let (sine, cosine) = number(x).sin_cos();
        assert!(sine.hi().is_nan() && cosine.hi().is_nan());
    }
}

fn y_of(y: f64, x: f64) -> f64 {
    Real::atan2(y, x)
}

/// The error of a sum of a million tenths comes from its roundings alone: 10⁶ sums, each within 3 u² of up to 10⁵.
#[test]
fn a_long_sum_keeps_its_digits() {
    let tenth = DoubleDouble::from_decimal("0.1").unwrap();
    let mut sum = DoubleDouble::ZERO;
    (0..1_000_000).for_each(|_| sum += tenth);
    let off = (sum - number(1e5)).abs();
    assert!(off <= number(3e6 * 1e5) * number(2f64.powi(-106)), "{off:e}");
}
