//! Polynomials in pieces [lower, upper, c0, c1, ...]. Beyond the first and the last piece the polynomial continues along its tangent.

/// Value and slope of a piece.
fn of_piece(piece: &[f64], x: f64) -> [f64; 2] {
    let (mut sum, mut slope) = (0.0, 0.0);
    for c in piece[2..].iter().rev() {
        slope = slope * x + sum;
        sum = sum * x + c;
    }
    [sum, slope]
}

/// The value of the piece that contains x, or of a tangent outside all pieces.
pub(crate) fn value(pieces: &[Vec<f64>], x: f64) -> f64 {
    let (Some(first), Some(last)) = (pieces.first(), pieces.last()) else { return 0.0 };
    let tangent = |piece: &[f64], at: f64| {
        let [sum, slope] = of_piece(piece, at);
        sum + slope * (x - at)
    };
    if x < first[0] {
        return tangent(first, first[0]);
    }
    pieces.iter().find(|p| x < p[1]).map_or_else(|| tangent(last, last[1]), |p| of_piece(p, x)[0])
}

/// The integral from the lower end of the first piece.
pub(crate) fn integral(pieces: &[Vec<f64>], x: f64) -> f64 {
    let (Some(first), Some(last)) = (pieces.first(), pieces.last()) else { return 0.0 };
    let tangent = |piece: &[f64], at: f64| {
        let [sum, slope] = of_piece(piece, at);
        (sum + 0.5 * slope * (x - at)) * (x - at)
    };
    if x < first[0] {
        return tangent(first, first[0]);
    }
    let within = |piece: &[f64], x: f64| {
        let terms = piece[2..].iter().rev().zip((1..piece.len() - 1).rev());
        terms.fold(0.0, |sum, (c, power)| (sum + c / power as f64) * x)
    };
    let parts = pieces.iter().take_while(|p| p[0] < x);
    let sum: f64 = parts.map(|p| within(p, x.min(p[1])) - within(p, p[0])).sum();
    if x > last[1] { sum + tangent(last, last[1]) } else { sum }
}
