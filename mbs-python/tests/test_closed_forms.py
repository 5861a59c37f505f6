"""Motions with a closed form."""

import math
from typing import Any

import multibody as mbs
import numpy as np
from conftest import needs, scene

FINE: dict[str, Any] = {"formulation": "recursive", "integrator": "rk853", "tolerance": 1e-13}
"""A Runge-Kutta method of order 8, so that what is left is the rounding of some thousand operations."""
EXACT = 1e-10
"""Error of rk853 at a tolerance of 1e-13 over ten seconds: below a thousand steps of it."""
ROUNDING = 1e-12
"""Where the rule is exact: rounding of a thousand steps."""
SECOND_ORDER = 1e-4
"""The trapezoidal rule at 1 ms over ten seconds of the pendulum: (h w)^2 / 12 of its phase w t, w = 3.1 1/s, with a factor 4."""


def test_a_pendulum_follows_the_elliptic_function() -> None:
    special = needs("scipy.special")
    result = mbs.Mechanism(scene("simple-pendulum")).run(**FINE).check()
    half = 0.5  # k^2 of a release from the horizontal
    _, cn, dn, _ = special.ellipj(math.sqrt(9.81) * result.t, half)
    s = -math.sqrt(half) * cn / dn
    assert np.abs(result["mass.x"] - 2 * s * np.sqrt(1 - s**2)).max() < EXACT
    assert np.abs(result["mass.y"] - (2 * s**2 - 1)).max() < EXACT


def test_a_pendulum_has_the_published_digits() -> None:
    result = mbs.Mechanism(scene("simple-pendulum")).run().check()
    assert abs(result["mass.x"][-1] + 0.275087462576) < SECOND_ORDER
    fine = mbs.Mechanism(scene("simple-pendulum")).run(**FINE).check()
    assert abs(fine["mass.x"][-1] + 0.275087462576) < EXACT
    assert abs(fine["mass.y"][-1] + 0.961419205099) < EXACT


def test_a_pendulum_has_its_period() -> None:
    period = 2.36784194757623745
    simulation = mbs.Mechanism(scene("simple-pendulum")).simulate(**FINE)
    simulation.run_until(period)
    assert abs(simulation.value("pivot")) < EXACT
    assert abs(simulation.rates("pivot")[0]) < EXACT


def test_a_stone_falls_by_half_g_t_squared() -> None:
    builder = mbs.Mechanism.build("stone", dimension=2)
    builder.gravity([0.0, -9.81])
    builder.duration(1.0)
    stone = builder.body("stone", mass=2.0, point=[0.0, 0.0])
    builder.output("stone", body=stone)
    result = builder.done().run().check()
    assert np.abs(result["stone.y"] + 0.5 * 9.81 * result.t**2).max() < ROUNDING
    assert not result["stone.x"].any()


def test_a_top_precesses_steadily_at_the_slow_root() -> None:
    tilt, spin, mass, length, across, along = 0.5236, 100.0, 0.5, 0.1, 0.0062, 0.002
    moment = mass * 9.81 * length
    root = math.sqrt((along * spin) ** 2 - 4 * across * math.cos(tilt) * moment)
    precession = (along * spin - root) / (2 * across * math.cos(tilt))
    axis = np.array([math.sin(tilt), 0.0, math.cos(tilt)])
    rate = (spin - precession * math.cos(tilt)) * axis + [0.0, 0.0, precession]
    top = mbs.Mechanism(scene("spinning-top")).replace({f"initial.point.rate[{i}]": float(rate[i]) for i in (0, 2)})
    result = top.run(**FINE).check()
    angle = precession * result.t
    steady = length * np.array([math.sin(tilt) * np.cos(angle), math.sin(tilt) * np.sin(angle), np.full_like(angle, math.cos(tilt))])
    seen = np.array([result[f"center.{axis}"] for axis in "xyz"])
    assert np.abs(seen - steady).max() < EXACT


def test_a_double_pendulum_keeps_its_energy_and_reaches_the_published_place() -> None:
    result = mbs.Mechanism(scene("double-pendulum")).run(3.0, **FINE).check()
    assert result.energy["max_error"] < EXACT
    tip = {1.0: (-1.66211513581612758, -1.04146663719322474), 3.0: (1.33043682514404911, -1.39864486051920382)}
    for time, place in tip.items():
        row = int(np.argmin(np.abs(result.t - time)))
        assert abs(result["tip.x"][row] - place[0]) < EXACT
        assert abs(result["tip.y"][row] - place[1]) < EXACT
