"""A simulation steps, takes inputs, and is saved, copied and pickled with its bits."""

import copy
import pickle
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import multibody as mbs
import numpy as np
import pytest
from conftest import scene

ON_THE_MANIFOLD = 1e-9
"""A state of a run is projected onto the constraints again within the tolerance of the projection [rad, m]."""
SAME = ["servo-arm", "spinning-top", "guided-four-bar", "spatial-four-bar", "rolling-disc", "iltis-bump-5"]


def moved(name: str, steps: int = 20) -> mbs.Simulation:
    simulation = mbs.Mechanism(scene(name)).simulate()
    simulation.steps(1e-3, steps)
    return simulation


def bits(simulation: mbs.Simulation) -> bytes:
    simulation.steps(1e-3, 10)
    return b"".join(part.tobytes() for part in (simulation.q, simulation.v, simulation.a, simulation.outputs()))


TWINS: dict[str, Callable[[mbs.Simulation], mbs.Simulation]] = {
    "copy": lambda simulation: simulation.copy(),
    "copy.copy": copy.copy,
    "copy.deepcopy": copy.deepcopy,
    "pickle": lambda simulation: pickle.loads(pickle.dumps(simulation)),
}


@pytest.mark.parametrize("name", SAME)
@pytest.mark.parametrize("how", TWINS)
def test_a_copy_goes_on_with_the_same_bits(name: str, how: str) -> None:
    simulation = moved(name)
    twin = TWINS[how](simulation)
    assert twin.time == simulation.time
    assert bits(twin) == bits(simulation)


@pytest.mark.parametrize("name", SAME)
def test_a_saved_state_comes_back_with_its_bits(name: str) -> None:
    simulation = moved(name)
    data = simulation.save()
    after = bits(simulation)
    simulation.restore(data)
    assert bits(simulation) == after
    other = mbs.Mechanism(scene(name)).simulate()
    other.restore(data)
    assert bits(other) == after


def test_a_saved_state_that_changed_on_its_way_is_refused() -> None:
    data = bytearray(moved("double-pendulum").save())
    data[-20] ^= 1
    with pytest.raises(mbs.UsageError) as caught:
        moved("double-pendulum").restore(bytes(data))
    assert caught.value.code == "checkpoint-refused"


def test_a_state_of_another_mechanism_is_refused() -> None:
    with pytest.raises(mbs.UsageError):
        moved("spinning-top").restore(moved("servo-arm").save())


@pytest.mark.parametrize("name", ["double-pendulum", "servo-arm", "spinning-top", "four-bar", "spatial-four-bar", "rssr"])
def test_a_state_that_is_set_is_there(name: str) -> None:
    simulation = moved(name)
    q, v = simulation.q, simulation.v
    simulation.reset()
    assert simulation.time == 0.0
    assert simulation.set_state(q, v) < ON_THE_MANIFOLD
    assert np.abs(simulation.q - q).max() < ON_THE_MANIFOLD
    assert np.abs(simulation.v - v).max() < ON_THE_MANIFOLD


def test_an_open_loop_is_closed_by_set_state() -> None:
    mechanism = mbs.Mechanism(scene("four-bar"))
    simulation = mechanism.simulate()
    q, v = mechanism.initial()
    place, _ = mechanism.coordinates("pivot-1")
    q[place] += 0.1
    assert simulation.set_state(q, v) > 0.0
    assert np.abs(simulation.point("crank-1", [1.0, 1.0])[0] - simulation.point("coupler-0", [1.0, 1.0])[0]).max() < ON_THE_MANIFOLD


def test_inputs_act_from_the_next_step() -> None:
    simulation = mbs.Mechanism(scene("servo-arm")).simulate()
    simulation.u = np.zeros(6)
    simulation.set_input("target-turn", 0.2)
    simulation.set_input(1, 0.1)
    assert simulation.u.tolist() == [0.2, 0.1, 0.0, 0.0, 0.0, 0.0]
    simulation.step(1e-3)
    assert simulation.rates("turn")[0] > 0.0


def test_inputs_of_a_row_for_each_step_are_steps_with_u() -> None:
    mechanism = mbs.Mechanism(scene("servo-arm"))
    one, two, three = (mechanism.simulate() for _ in range(3))
    rows = np.random.default_rng(2).uniform(-0.5, 0.5, (15, 6))
    one.steps(1e-3, 15, rows)
    for row in rows:
        two.step(1e-3, row)
        three.u = row
        three.step(1e-3)
    assert bits(one) == bits(two) == bits(three)


def test_an_input_acts_whole_in_its_first_step() -> None:
    builder = mbs.Mechanism.build("cart", dimension=2)
    builder.duration(1.0)
    cart = builder.body("cart", mass=2.0, center=[0, 0], inertia=1.0)
    rail = builder.joint("rail", "prismatic", [builder.ground, cart], at=[0, 0], axis=[1, 0])
    push = builder.input("push", unit="N")
    builder.effect("motor", "torque", joint=rail, coordinate="slide", signal=push)
    simulation = builder.done().simulate(step=1e-2)
    for k in range(1, 4):
        simulation.step(1e-2, [4.0])
        assert simulation.rates(rail)[0] == pytest.approx(2.0 * 1e-2 * k, rel=1e-9)


def test_arrays_do_not_follow_the_simulation() -> None:
    simulation = moved("servo-arm")
    q, kept = simulation.q, simulation.q.copy()
    simulation.steps(1e-3, 5)
    assert np.array_equal(q, kept)
    assert q.flags.owndata or q.base is None or q.base.__class__.__name__ != "Simulation"


def test_outputs_are_written_into_an_array() -> None:
    simulation = moved("servo-arm")
    out = np.empty(len(simulation.mechanism.outputs))
    assert simulation.outputs(out) is out
    assert np.array_equal(out, simulation.outputs())
    assert simulation.output("hand").tolist() == [out[simulation.mechanism.outputs.index(f"hand.{axis}")] for axis in "xyz"]


def test_steps_are_a_run() -> None:
    mechanism = mbs.Mechanism(scene("double-pendulum"))
    result = mechanism.run(0.1, step=1e-3)
    simulation = mechanism.simulate(step=1e-3)
    for row in range(1, 101):
        simulation.step()
        assert simulation.outputs().tobytes() == np.ascontiguousarray(result.array[row]).tobytes()


def test_run_until_ends_at_its_time() -> None:
    simulation = mbs.Mechanism(scene("double-pendulum")).simulate(step=1e-3)
    simulation.run_until(0.0123)
    assert simulation.time == pytest.approx(0.0123, abs=1e-15)


def test_contacts_are_events() -> None:
    ball = {"name": "ball", "mass": 1.0, "center": [0.0, 0.0], "inertia": 0.01}
    rail = {"name": "rail", "kind": "prismatic", "bodies": ["ground", "ball"], "at": [0, 0], "axis": [0, 1]}
    stop = {"name": "stop", "kind": "limit", "joint": "rail", "lower": -0.05, "upper": 1.0, "stiffness": 1e4}
    scene_ = {"scene": {"dimension": 2, "duration": 1.0, "gravity": [0, -9.81]}, "body": [ball], "joint": [rail], "effect": [stop]}
    simulation = mbs.Mechanism(scene_).simulate(step=1e-3)
    simulation.watch_events()
    simulation.run_until(0.2)
    first = simulation.events[0]
    assert (first.effect, first.is_made) == ("stop", True)
    assert first.time == pytest.approx((2 * 0.05 / 9.81) ** 0.5, abs=2e-3)  # two steps
    assert not simulation.events[1].is_made


def test_a_second_thread_is_refused() -> None:
    simulation = mbs.Mechanism(scene("iltis-bump-5")).simulate()
    began = threading.Event()

    def work() -> None:
        began.set()
        simulation.steps(1e-3, 1000)

    thread = threading.Thread(target=work)
    thread.start()
    began.wait()
    refused = 0
    while thread.is_alive():
        try:
            assert simulation.time >= 0.0
        except mbs.BusyError:
            refused += 1
    thread.join()
    assert refused > 0
    assert simulation.time == pytest.approx(1.0)


def test_eight_threads_share_a_mechanism() -> None:
    mechanism = mbs.Mechanism(scene("spatial-four-bar"))
    q, v = mechanism.initial()

    def work(_: int) -> bytes:
        simulation = mechanism.simulate()
        simulation.steps(1e-3, 50)
        return simulation.q.tobytes() + mechanism.mass_matrix(q).tobytes() + mechanism.run(0.05).array.tobytes()

    with ThreadPoolExecutor(8) as pool:
        assert len(set(pool.map(work, range(32)))) == 1


def test_a_mechanism_is_pickled_copied_and_hashed() -> None:
    mechanism = mbs.Mechanism(scene("six-joint-arm")).replace({"body.hand.mass": 3.0})
    for twin in (pickle.loads(pickle.dumps(mechanism)), copy.copy(mechanism), copy.deepcopy(mechanism)):
        assert twin == mechanism
        assert hash(twin) == hash(mechanism)
        assert twin.get("body.hand.mass") == 3.0
    assert mechanism != mbs.Mechanism(scene("six-joint-arm"))
    assert mbs.Mechanism(mechanism.to_dict()).run(0.01).array.tobytes() == mechanism.run(0.01).array.tobytes()
    assert mbs.Mechanism(mechanism.text).run(0.01).array.tobytes() == mechanism.run(0.01).array.tobytes()


def test_a_result_is_pickled() -> None:
    result = mbs.Mechanism(scene("double-pendulum")).run(0.05)
    twin = pickle.loads(pickle.dumps(result))
    assert twin.array.tobytes() == result.array.tobytes()
    assert twin.summary == result.summary
    assert list(twin) == list(result)
