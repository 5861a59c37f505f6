"""Free motion by DOP853 on the accelerations that another program gives."""

import time

import numpy as np
from scipy.integrate import solve_ivp

import rotation

# Seconds of computing that a part of one motion may take: what is stiff is left without a reference.
PATIENCE = 40.0


class TooStiff(Exception):
    pass


def end_state(model, acceleration, y, rates, duration, tolerance):
    """State after `duration`; values of turns are not wrapped, quaternions have length one."""
    values, start = len(y), time.process_time()

    def slope(_, x):
        if time.process_time() - start > PATIENCE:
            raise TooStiff
        r = x[values:]
        change = acceleration(x[:values], r)
        return np.concatenate([rotation.drift(model.kinds, x[:values], r, model.parents()), change])

    run = solve_ivp(slope, (0, duration), np.concatenate([y, rates]), "DOP853", rtol=tolerance, atol=tolerance)
    if not run.success:
        raise TooStiff
    end, i = run.y[:, -1], 0
    for kind in model.kinds:
        i += rotation.SIZE[kind]
        if kind in ("ball", "free"):
            end[i - 4:i] /= np.linalg.norm(end[i - 4:i])
    return end[:values], end[values:]


def motion(model, acceleration, y, rates, times, tolerances=(1e-13, 1e-12)):
    """The states at `times` at the finer tolerance, with what each is good for: its distance from that at the rougher one.

    Many robots that fall without damping are chaotic: a difference grows a millionfold in a second.
    """
    ends, fine, rough, now = [], (y, rates), (y, rates), 0.0
    for until in times:
        try:
            with np.errstate(all="ignore"):
                fine = end_state(model, acceleration, *fine, until - now, tolerances[0])
                rough = end_state(model, acceleration, *rough, until - now, tolerances[1])
        except (TooStiff, np.linalg.LinAlgError, ValueError) as fault:
            return ends, type(fault).__name__
        x, other = np.concatenate(fine), np.concatenate(rough)
        spread = np.max(np.abs(x - other), initial=0) / max(1.0, np.max(np.abs(x), initial=0))
        ends, now = ends + [(until, *fine, float(spread))], until
    return ends, None
