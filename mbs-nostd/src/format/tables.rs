//! Format of links, loops, rows, the plan of elimination, and loads.

use super::macros::{record_enum, record_struct};
use super::{Axes, Record};
use crate::inputs::Motion;
use mbs_core::Real;
use mbs_core::laws::Part;
use mbs_recursive::link::plan::{End, LoopCoupling, Pair, Pass, Span, Station, Update};
use mbs_recursive::link::{Link, LinkKind, LinkRotor};
use mbs_recursive::loads::{BodyLoad, Load, Measure, SumLoad};
use mbs_recursive::rows::Row;
use mbs_recursive::rows::closed_loop::ClosedLoop;
use mbs_recursive::rows::coupled::{CoupledRow, LinePoint, LinkStart, SumMeasure, SumTerm};

record_enum!([] LinkKind = LinkKind {
    0 Revolute {}, 1 Prismatic {}, 2 Ball {}, 3 Free {}, 4 GuidedRevolute {}, 5 GuidedPrismatic {},
});

record_struct!([T: Real + Record, S: Axes<T>] Link<T, S> = Link {
    parent, kind, z, v, axis, direction, offset, mass, center, tensor,
});

record_struct!([T: Real + Record, S: Axes<T>] ClosedLoop<T, S> = ClosedLoop {
    links, points, first, n, ancestor, block, joint,
});

record_enum!([T: Real + Record, S: Axes<T>] Row<T, S> = Row {
    0 Coincidence { axis axis },
    1 Gap { direction direction, constant constant },
    2 Dot { x x, y y, constant constant },
    3 Length { length length },
    4 Coupled { 0 row },
    5 Height { radius radius, axis axis, normal normal },
    6 NoSlip { direction direction },
    7 Blade { direction direction, normal normal },
});

record_struct!([T: Real + Record] CoupledRow<T> = CoupledRow {
    terms, starts, guide, value, inverse, is_angle,
});
record_struct!([T: Real + Record] SumTerm<T> = SumTerm { factor, curve, of });
record_enum!([T: Real + Record] SumMeasure<T> = SumMeasure {
    0 Joint { link link, side side },
    1 Line { points points, reference reference },
});
record_struct!([T: Real + Record, S: Axes<T>] LinePoint<T, S> = LinePoint { start, point });
record_struct!([] LinkStart = LinkStart { link, side });

record_struct!([T: Real + Record] LinkRotor<T> = LinkRotor { link, inertia });

record_struct!([] Span = Span { first, end });
record_struct!([] Station = Station { passes, pairs, ends });
record_struct!([] Pass = Pass { lap, side, gain });
record_struct!([] Pair = Pair { row, column, block });
record_struct!([] End = End { lap, couplings, updates });
record_struct!([] LoopCoupling = LoopCoupling { lap, side, block });
record_struct!([] Update = Update { row, column, block });
record_struct!([] Part = Part { first, n });

record_enum!([T: Real + Record, S: Axes<T>] Load<T, S> = Load {
    0 Between { links links, gauge gauge, law law },
    1 Angle { link link, law law },
    2 Constant { link link, point point, force force },
    3 Force { link link, point point, course course, turns turns },
    4 Torque { link link, course course },
    5 BodyLoad { 0 load },
    6 Sum { 0 load },
});

record_enum!([T: Real + Record, S: Axes<T>] Measure<T, S> = Measure {
    0 Length { points points },
    1 Along { points points, direction direction, offset offset },
    2 Rotation { number number },
    3 Turn {},
});

record_struct!([T: Real + Record, S: Axes<T>] BodyLoad<T, S> = BodyLoad { link, point, axis, law });

record_struct!([T: Real + Record] SumLoad<T> = SumLoad { terms, starts, law });

record_enum!([T: Real + Record] Motion<T> = Motion {
    0 Input { 0 motion },
    1 Sine { amplitude amplitude, frequency frequency, phase phase },
    2 Ramp { rate rate },
    3 Table { 0 part },
    4 Step { 0 rise },
});
