//! Sine and cosine of our own, the same on every target, without branches in their range: in single precision ([`single`]), where libm
//! computes in doubles, and in double precision ([`double`]), so that many stand side by side.

pub(super) mod double;
pub(super) mod single;
