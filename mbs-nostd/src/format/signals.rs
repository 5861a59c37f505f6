//! Format of the laws of signals, of the operations on signals, and of the curves to which the operations refer.

use super::Record;
use super::macros::{record_enum, record_struct};
use crate::inputs::{Rise, SignalLaw};
use mbs_core::Real;
use mbs_core::feedback::{FeedbackOperation, FeedbackStep};
use mbs_recursive::link::curves::CurveTable;

record_enum!([T: Real + Record] SignalLaw<T> = SignalLaw {
    0 Input { 0 value },
    1 Constant { 0 value },
    2 Travel { 0 speed },
    3 Table { 0 part },
    4 Spline { 0 part },
    5 Step { 0 rise },
});

record_struct!([T: Real + Record] Rise<T> = Rise { from, to, at, rise });

record_struct!([T: Real + Record] FeedbackStep<T> = FeedbackStep { to, operation });

record_enum!([T: Real + Record] FeedbackOperation<T> = FeedbackOperation {
    0 Value { number number },
    1 Rate { number number },
    2 Constant { 0 value },
    3 Add { from from, factor factor },
    4 Multiply { from from },
    5 Curve { from from, curve curve },
    6 Clamp { from from, limits limits },
    7 Lag { from from, state state, time time },
    8 Integral { from from, state state, limits limits },
    9 Pid { from from, state state, gains gains, limit limit },
    10 Component { from from, component component },
    11 Force { from from, on on },
    12 LimitRatio { from from, limits limits },
});

record_enum!([T: Real + Record] CurveTable<T> = CurveTable {
    0 Spline { knots knots, first first, period period },
    1 Polynomial { coefficients coefficients },
});
