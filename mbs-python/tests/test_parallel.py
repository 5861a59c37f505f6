"""Sweeps and batches over Dask and Ray give the table of threads, also where workers die."""

from __future__ import annotations

import os
import random
import signal
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import multibody as mbs
import numpy as np
import pytest
from conftest import needs, scene
from multibody import parallel

SWEEPS = 10
MEMBERS = 40
KILL_WITHIN = 0.4
"""A worker is killed in this time after the start of a sweep [s], which takes about half a second."""
DURATION = 10.0
"""Simulated time of a member [s], 20 ms of work."""
SPEC = {"vary": [{"path": "body.upper.mass", "from": 1.0, "to": 2.0, "count": MEMBERS}]}


class Cluster:
    """An engine with two workers."""

    def __init__(self, client: Any, pids: Callable[[], list[int]]) -> None:
        self.client = client
        self.pids = pids


@pytest.fixture(scope="module")
def dask_cluster() -> Iterator[Cluster]:
    dask, distributed = needs("dask"), needs("distributed")
    # LocalCluster gives up a worker that is down just so long after one of its deaths.
    with dask.config.set({"distributed.deploy.lost-worker-timeout": "1h"}):
        options = {"n_workers": 2, "threads_per_worker": 1, "processes": True, "dashboard_address": None, "host": "127.0.0.1"}
        with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:
            yield Cluster(client, lambda: list(client.run(os.getpid).values()))


@pytest.fixture(scope="module")
def ray_cluster() -> Iterator[Cluster]:
    os.environ["RAY_USAGE_STATS_ENABLED"] = "0"
    ray = needs("ray")
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)

    def pid() -> int:
        time.sleep(0.1)  # so that each worker takes one
        return os.getpid()

    yield Cluster("ray", lambda: ray.get([ray.remote(pid).remote() for _ in range(2)]))
    ray.shutdown()


@pytest.fixture(params=["dask", "ray"])
def cluster(request: pytest.FixtureRequest) -> Cluster:
    return request.getfixturevalue(f"{request.param}_cluster")  # type: ignore[no-any-return]


def pendulum() -> mbs.Mechanism:
    return mbs.Mechanism(scene("double-pendulum"))


def without_times(text: str) -> str:
    """A table without `cpu_seconds`, its last column."""
    head, *rows = text.splitlines()
    assert head.endswith(",cpu_seconds")
    return "\n".join(row.rpartition(",")[0] for row in [head, *rows])


@pytest.fixture(scope="module")
def by_threads() -> str:
    return without_times(pendulum().sweep(SPEC, threads=2, duration=DURATION).to_csv())


class Killer:
    """Kills a worker at random while its body runs."""

    def __init__(self, pids: list[int], seed: int) -> None:
        chance = random.Random(seed)
        self.timer = threading.Timer(chance.uniform(0.0, KILL_WITHIN), self.kill, [chance.choice(pids)])

    def kill(self, pid: int) -> None:
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass  # the engine has ended it before

    def __enter__(self) -> None:
        self.timer.start()

    def __exit__(self, *_: object) -> None:
        self.timer.join()


def test_a_killed_worker_loses_nothing(cluster: Cluster, by_threads: str) -> None:
    mechanism = pendulum()
    for seed in range(SWEEPS):
        with Killer(cluster.pids(), seed):
            table = mechanism.sweep(SPEC, client=cluster.client, duration=DURATION)
        assert without_times(table.to_csv()) == by_threads


def test_the_journal_is_that_of_threads(cluster: Cluster, by_threads: str, tmp_path: Path) -> None:
    counts: list[tuple[int, int]] = []
    pendulum().sweep(SPEC, client=cluster.client, duration=DURATION, journal=tmp_path, progress=lambda *count: counts.append(count))
    assert counts[-1] == (MEMBERS, MEMBERS)
    assert without_times((tmp_path / "table.csv").read_text()) == by_threads
    again: list[tuple[int, int]] = []
    pendulum().sweep(SPEC, client=cluster.client, duration=DURATION, journal=tmp_path, progress=lambda *count: again.append(count))
    assert again == [(MEMBERS, MEMBERS)]


def test_a_killed_caller_resumes(cluster: Cluster, by_threads: str, tmp_path: Path) -> None:
    class Killed(Exception):
        pass

    def fail(done: int, members: int) -> None:
        if done > 1:
            raise Killed

    with pytest.raises(Killed):
        pendulum().sweep(SPEC, client=cluster.client, duration=DURATION, journal=tmp_path, progress=fail)
    counts: list[int] = []
    table = pendulum().sweep(SPEC, client=cluster.client, duration=DURATION, journal=tmp_path, progress=lambda n, _: counts.append(n))
    assert counts[0] > 1
    assert without_times(table.to_csv()) == by_threads


class Deadly:
    """A sweep of squares; some members kill their worker."""

    columns = ["member", "square"]

    def __init__(self, n_members: int, killers: set[int]) -> None:
        self.n_members = n_members
        self.killers = killers

    def run(self, members: list[int]) -> list[list[str]]:
        for member in members:
            time.sleep(0.02)
            if member in self.killers:
                os._exit(1)
        return [[str(member), str(member**2)] for member in members]

    def lost(self, member: int) -> list[str]:
        return [str(member), "worker-lost"]

    def collect(self, journal: str | None) -> Rows:
        return Rows(self.n_members)


class Rows:
    """Rows of a sweep, in memory."""

    def __init__(self, n: int) -> None:
        self.rows: list[list[str] | None] = [None] * n

    def missing(self) -> list[int]:
        return [i for i, row in enumerate(self.rows) if row is None]

    def take(self, row: list[str]) -> None:
        assert self.rows[int(row[0])] is None
        self.rows[int(row[0])] = row

    def finish(self) -> list[list[str]]:
        assert not self.missing()
        return [row for row in self.rows if row is not None]


@pytest.mark.parametrize("killer", [0, 17])
def test_a_member_that_kills_its_workers_is_a_failed_row(cluster: Cluster, killer: int, monkeypatch: pytest.MonkeyPatch) -> None:
    job = Deadly(30, {killer})
    by_value(monkeypatch)
    rows = parallel.sweep(job, cluster.client, None, None)
    assert rows == [[str(i), "worker-lost" if i == killer else str(i**2)] for i in range(30)]


def by_value(monkeypatch: pytest.MonkeyPatch) -> None:
    """Sends the classes of this file whole: workers cannot import it."""
    import sys

    cloudpickle = needs("cloudpickle")
    module = sys.modules[__name__]
    cloudpickle.register_pickle_by_value(module)
    if "ray.cloudpickle" in sys.modules:
        sys.modules["ray.cloudpickle"].register_pickle_by_value(module)


def test_a_rollout_over_workers_has_its_bits(cluster: Cluster) -> None:
    mechanism = mbs.Mechanism(scene("servo-arm"))
    random_ = np.random.default_rng(5)
    q, v = random_.uniform(-0.5, 0.5, (2, 50, 6))
    v[7] = 1e200  # its square is no number
    u = random_.uniform(-0.5, 0.5, (50, 30, 6))
    here = mechanism.rollout(q, v, u, 1e-3)
    there = parallel.rollout(mechanism, q, v, u, 1e-3, client=cluster.client)
    assert here.q.tobytes() == there.q.tobytes()
    assert here.v.tobytes() == there.v.tobytes()
    assert here.ok.tolist() == there.ok.tolist()
    for_all = parallel.rollout(mechanism, q, v[0], u[0], 1e-3, client=cluster.client)
    assert for_all.q.tobytes() == mechanism.rollout(q, np.tile(v[0], (50, 1)), u[0], 1e-3).q.tobytes()
    with pytest.raises(mbs.UsageError, match="u has the shape"):
        parallel.rollout(mechanism, q, v, u[:, :, :2], 1e-3, client=cluster.client)
    assert {i: str(error) for i, error in here.errors.items()} == {i: str(error) for i, error in there.errors.items()}


def test_an_interrupt_cancels(cluster: Cluster) -> None:
    before = signal.signal(signal.SIGALRM, lambda *_: signal.raise_signal(signal.SIGINT))
    signal.setitimer(signal.ITIMER_REAL, 1.0)
    began = time.monotonic()
    try:
        with pytest.raises(KeyboardInterrupt):
            pendulum().sweep({"vary": [{**SPEC["vary"][0], "count": 10**5}]}, client=cluster.client)
    finally:
        signal.signal(signal.SIGALRM, before)
    assert time.monotonic() - began < 20.0  # on a busy machine: 1 s to the signal, and the engine's answer to the cancellation


def test_other_clients_are_refused() -> None:
    with pytest.raises(mbs.UsageError, match="client"):
        pendulum().sweep(SPEC, client="slurm")


def test_ray_that_is_not_initialised_is_refused() -> None:
    ray = needs("ray")
    if ray.is_initialized():
        ray.shutdown()
    with pytest.raises(mbs.UsageError, match="Ray") as caught:
        pendulum().sweep(SPEC, client="ray")
    assert "ray.init()" in (caught.value.hint or "")
