//! Packed columns of whole numbers: long series in the form in which a page contains them and its script reads them.
//!
//! ```text
//! group     rows of several columns; the first row as it is, then the differences d to the row before
//! zigzag    (d << 1) ^ (d >> 63): small numbers of both signs are small without a sign
//! planes    the low bytes of all numbers, column by column, then the next bytes, as many as the largest number needs
//! pack      length of the header (u32, low byte first), header (JSON), then the planes of all groups; deflated, in base64
//! ```

use miniz_oxide::deflate::compress_to_vec;

/// Compression level of deflate [-]. It is the default. The highest level takes three times as long for one percent less data.
const LEVEL: u8 = 6;
/// Number of steps in the range of a drawn column [-]. It is more than a screen resolves.
const STEPS: f64 = 65_534.0;
/// Whole number that stands for a value that is not finite [-].
const GAP: i64 = 65_535;

/// Columns to be packed, group by group.
#[derive(Debug, Default)]
pub(crate) struct Pack {
    bytes: Vec<u8>,
    /// Numbers of rows, columns and planes of each group.
    groups: Vec<[usize; 3]>,
}

/// Position of a column in a pack, and its scale: `low + step * whole`. The whole number 65535 is a gap in columns that have gaps.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub(crate) struct Column {
    /// Index of the column's group.
    group: usize,
    /// Index of the column in the group.
    column: usize,
    low: f64,
    step: f64,
}

impl Pack {
    /// Packs columns of equal length as one group. Returns the index of the group.
    pub(crate) fn add(&mut self, columns: &[Vec<i64>]) -> usize {
        let rows = columns.first().map_or(0, Vec::len);
        debug_assert!(columns.iter().all(|column| column.len() == rows));
        let mut numbers = Vec::with_capacity(rows * columns.len());
        for column in columns {
            let before = core::iter::once(0).chain(column.iter().copied());
            numbers.extend(
                column.iter().zip(before).map(|(x, before)| zigzag(x.wrapping_sub(before))),
            );
        }
        let largest = numbers.iter().copied().max().unwrap_or(0);
        let planes = (1..8).find(|n| largest >> (8 * n) == 0).unwrap_or(8);
        for plane in 0..planes {
            self.bytes.extend(numbers.iter().map(|x| x.to_le_bytes()[plane]));
        }
        self.groups.push([rows, columns.len(), planes]);
        self.groups.len() - 1
    }

    /// Packs numbers as multiples of a step, column by column. Values that are not finite become zero.
    pub(crate) fn fixed(&mut self, columns: &[Vec<f64>], step: f64) -> Vec<Column> {
        let whole: Vec<Vec<i64>> =
            columns.iter().map(|c| c.iter().map(|x| nearest(x / step)).collect()).collect();
        let group = self.add(&whole);
        (0..columns.len()).map(|column| Column { group, column, low: 0.0, step }).collect()
    }

    /// Packs numbers with a step of 1/65534 of the range of their column. Values that are not finite become gaps.
    pub(crate) fn ranged(&mut self, columns: &[Vec<f64>]) -> Vec<Column> {
        let scales: Vec<(f64, f64)> = columns.iter().map(|column| scale(column)).collect();
        let whole = |(column, (low, step)): (&Vec<f64>, &(f64, f64))| -> Vec<i64> {
            let of = |x: &f64| if x.is_finite() { nearest((x - low) / step) } else { GAP };
            column.iter().map(of).collect()
        };
        let whole: Vec<Vec<i64>> = columns.iter().zip(&scales).map(whole).collect();
        let group = self.add(&whole);
        let column = |(column, (low, step))| Column { group, column, low, step };
        scales.into_iter().enumerate().map(column).collect()
    }

    /// Returns the pack as text. Its header is the given one, with a list of the groups under `groups`.
    pub(crate) fn text(&self, mut header: serde_json::Value) -> String {
        header["groups"] = serde_json::json!(self.groups);
        let header = header.to_string();
        let length = u32::try_from(header.len()).unwrap_or(u32::MAX);
        let whole = [&length.to_le_bytes(), header.as_bytes(), &self.bytes].concat();
        base64(&compress_to_vec(&whole, LEVEL))
    }
}

fn zigzag(d: i64) -> u64 {
    ((d << 1) ^ (d >> 63)).cast_unsigned()
}

#[allow(clippy::cast_possible_truncation, reason = "the cast saturates")]
fn nearest(x: f64) -> i64 {
    x.round() as i64
}

/// Returns the smallest and the largest of the finite values.
pub(super) fn ends(values: &[f64]) -> Option<[f64; 2]> {
    let mut finite = values.iter().copied().filter(|x| x.is_finite());
    let first = finite.next()?;
    Some(finite.fold([first, first], |[low, high], x| [low.min(x), high.max(x)]))
}

/// Returns the smallest finite value, and the step, which is 1/65534 of the range.
fn scale(column: &[f64]) -> (f64, f64) {
    let Some([low, high]) = ends(column) else { return (0.0, 1.0) };
    let step = high / STEPS - low / STEPS;
    (low, if step.is_finite() && step > 0.0 { step } else { 1.0 })
}

/// Encodes bytes in base64, with padding.
pub(crate) fn base64(bytes: &[u8]) -> String {
    /// Letters for the values 0 to 63, by RFC 4648.
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let byte = |i: usize| u32::from(three.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for i in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * i) & 63) as usize];
            text.push(if i <= three.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use miniz_oxide::inflate::decompress_to_vec;

    fn bytes_of(text: &str) -> Vec<u8> {
        let value = |c: u8| match c {
            b'A'..=b'Z' => c - b'A',
            b'a'..=b'z' => c - b'a' + 26,
            b'0'..=b'9' => c - b'0' + 52,
            b'+' => 62,
            _ => 63,
        };
        let mut bytes = Vec::new();
        for four in text.as_bytes().chunks(4) {
            let n = four.iter().filter(|c| **c != b'=').count();
            let bits = four.iter().fold(0_u32, |bits, c| {
                bits << 6 | if *c == b'=' { 0 } else { u32::from(value(*c)) }
            });
            bytes.extend(&bits.to_be_bytes()[1..n]);
        }
        bytes
    }

    /// Reads a pack as the script of a page does. Returns its header, and the whole numbers of all groups.
    pub(crate) fn unpacked(text: &str) -> (serde_json::Value, Vec<Vec<Vec<i64>>>) {
        let bytes = decompress_to_vec(&bytes_of(text)).expect("it is deflated");
        let n = u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) as usize;
        let header: serde_json::Value = serde_json::from_slice(&bytes[4..4 + n]).expect("JSON");
        let mut at = 4 + n;
        let mut groups = Vec::new();
        for group in header["groups"].as_array().expect("groups") {
            let size =
                |i: usize| usize::try_from(group[i].as_u64().expect("a size")).expect("small");
            let (rows, columns, planes) = (size(0), size(1), size(2));
            let number = |i: usize| {
                let byte = |plane: usize| u64::from(bytes[at + plane * rows * columns + i]);
                (0..planes).fold(0, |x, plane| x | byte(plane) << (8 * plane))
            };
            let signed = |x: u64| (x >> 1).cast_signed() ^ -((x & 1).cast_signed());
            let column = |c: usize| {
                let differences = (0..rows).map(|r| signed(number(c * rows + r)));
                let sums = differences.scan(0_i64, |sum, d| {
                    *sum = sum.wrapping_add(d);
                    Some(*sum)
                });
                sums.collect()
            };
            groups.push((0..columns).map(column).collect());
            at += rows * columns * planes;
        }
        assert_eq!(at, bytes.len(), "nothing else is there");
        (header, groups)
    }

    #[test]
    fn whole_numbers_come_back_from_a_pack_to_the_last_one() {
        let mut pack = Pack::default();
        let columns = [vec![0, -1, 5, i64::MAX, i64::MIN], vec![7, 7, 7, 7, 8]];
        pack.add(&columns);
        pack.add(&[vec![-300, 300, 70_000]]);
        pack.add(&[Vec::new()]);
        let (header, groups) = unpacked(&pack.text(serde_json::json!({ "name": "ünit" })));
        assert_eq!(header["name"], "ünit");
        assert_eq!(header["groups"], serde_json::json!([[5, 2, 8], [3, 1, 3], [0, 1, 1]]));
        assert_eq!(groups, [columns.to_vec(), vec![vec![-300, 300, 70_000]], vec![vec![]]]);
    }

    #[test]
    fn columns_are_met_to_a_part_of_their_range_and_gaps_are_gaps() {
        let mut pack = Pack::default();
        let column: Vec<f64> = (0..1000).map(|i| 3.0 + (f64::from(i) * 0.01).sin()).collect();
        let with_gap = vec![f64::NAN; 1000];
        let placed = pack.ranged(&[column.clone(), with_gap]);
        let (_, groups) = unpacked(&pack.text(serde_json::json!({})));
        let Column { low, step, .. } = placed[0];
        for (x, whole) in column.iter().zip(&groups[0][0]) {
            #[allow(clippy::cast_precision_loss, reason = "below 65536")]
            let found = low + step * *whole as f64;
            // half a step plus rounding errors
            assert!((found - x).abs() <= 0.5001 * step && step < 2.0 / 65_000.0);
        }
        assert!(groups[0][1].iter().all(|whole| *whole == GAP));
    }

    #[test]
    fn base64_is_that_of_its_standard() {
        // test vectors of RFC 4648, section 10
        for (plain, text) in
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg==")]
        {
            assert_eq!(base64(plain.as_bytes()), text);
        }
    }
}
