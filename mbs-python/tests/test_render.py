"""A motion that is stepped from Python has a page, and pictures."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import multibody as mbs
import numpy as np
import pytest
from conftest import needs, needs_browser, scene


def test_a_recording_has_the_motion_and_its_page(tmp_path: Path) -> None:
    m = mbs.Mechanism(scene("double-pendulum"))
    sim = m.simulate(step=1e-2)
    recording = sim.record()
    sim.steps(None, 20)
    sim.run_until(0.5)
    sim.step()
    assert len(recording) == 52 and np.allclose(recording.times, np.arange(52) * 0.01)
    assert recording["tip.x"][-1] == sim.output("tip")[0]
    assert recording.outputs.shape == (52, len(m.outputs))
    page = recording.page()
    assert page.startswith("<!doctype html>") and "double pendulum" in page
    recording.save(tmp_path / "motion.html")
    assert (tmp_path / "motion.html").read_text() == page
    # it begins anew where time goes back
    sim.reset()
    sim.step()
    assert len(recording) == 1
    with pytest.raises(mbs.UsageError, match="no output `tip.w`"):
        recording["tip.w"]


def test_a_long_recording_keeps_every_second_instant() -> None:
    sim = mbs.Mechanism(scene("double-pendulum")).simulate(step=1e-3, formulation="recursive", integrator="rk4")
    recording = sim.record()
    sim.steps(None, 6000)
    assert 1200 <= len(recording) < 2400
    assert len(set(np.round(np.diff(recording.times), 9))) == 1


def test_a_motion_without_a_recording_that_is_kept_costs_nothing() -> None:
    sim = mbs.Mechanism(scene("double-pendulum")).simulate(step=1e-3)
    sim.record()
    sim.steps(None, 10)
    assert sim.time == 0.01


def test_a_picture_shows_where_the_mechanism_is() -> None:
    from multibody.render import Renderer

    needs_browser()
    m = mbs.Mechanism(scene("double-pendulum"))
    sim = m.simulate()
    with Renderer(m, 320, 240) as renderer:
        first, again = renderer.picture(sim), renderer.picture(sim)
        assert first.shape == (240, 320, 3) and first.dtype == np.uint8
        assert np.array_equal(first, again)
        sim.steps(None, 300)
        assert not np.array_equal(renderer.picture(sim), first)
        # the drawing fills the picture: its corners are the background
        corners = first[[0, 0, -1, -1], [0, -1, 0, -1]]
        assert np.array_equal(corners, np.repeat(corners[:1], 4, axis=0)) and corners.min() > 0
        # bodies are drawn: not all of it is the background
        assert len(np.unique(first.reshape(-1, 3), axis=0)) > 10


def test_an_environment_draws_and_gymnasium_makes_a_video(tmp_path: Path) -> None:
    gymnasium, checker = needs("gymnasium"), needs("gymnasium.utils.env_checker")
    needs("moviepy")
    needs_browser()
    from multibody.gym import MechanismEnv
    from test_gym import cart_pole, settings

    env = MechanismEnv(cart_pole(), **settings(max_steps=5, terminated=None), render_mode="rgb_array", size=(160, 120))
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        checker.check_env(env, skip_close_check=True)
        videos: Any = gymnasium.wrappers.RecordVideo(env, str(tmp_path))
        videos.reset(seed=1)
        while not any(videos.step(videos.action_space.sample())[2:4]):
            pass
        videos.close()
    assert len(list(tmp_path.glob("*.mp4"))) == 1
    assert env.metadata["render_fps"] == 50


def test_without_a_browser_an_environment_says_what_installs_one(monkeypatch: pytest.MonkeyPatch) -> None:
    needs("gymnasium")
    from multibody.gym import MechanismEnv
    from test_gym import cart_pole, settings

    monkeypatch.setenv("MULTIBODY_BROWSER", "no-such-browser")
    with pytest.raises(mbs.UsageError) as refused:
        MechanismEnv(cart_pole(), **settings(), render_mode="rgb_array")
    assert refused.value.code == "no-browser" and "apt install chromium" in str(refused.value.hint)
    with pytest.raises(mbs.UsageError, match="`human`"):
        MechanismEnv(cart_pole(), **settings(), render_mode="human")
