"""Sweeps and batches over the workers of Dask or Ray.

Members need nothing of each other, so a chunk of them is a task. A chunk lasts about a second, by a pilot of one member. Finished rows go
into the journal of the caller as they come. The death of a worker counts against every task on it. So the members of a chunk that comes back
without rows run once more, each alone, before one is blamed.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from importlib import import_module
from itertools import islice
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from .errors import MbsError, UsageError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from . import Mechanism, Rollout

Chunk = list[int]
"""Members, or starts of a batch, from 0."""

SHORTEST_CHUNK = 0.2
"""Least time of a chunk [s]: an engine needs some milliseconds for each."""
LONGEST_CHUNK = 1.0
"""Time of a chunk [s] where there is work for all. Members that cost twice the pilot stay below 2 s."""
CHUNKS_PER_WORKER = 4
"""Chunks for each worker in shorter jobs, so that all workers end at about the same time."""
PENDING_PER_WORKER = 8
"""Chunks that wait at an engine for each worker: schedulers slow down under millions."""
MAX_DEATHS = 3
"""Workers that a member may kill before it is given up."""
PERIOD = 0.1
"""Least time between two reports of progress [s]."""


class Collection(Protocol):
    """Rows on the side of the caller."""

    def missing(self) -> Chunk: ...
    def take(self, row: list[str]) -> None: ...
    def finish(self) -> list[list[str]]: ...


class Sweep(Protocol):
    """What a worker needs to run members."""

    n_members: int

    def run(self, members: Chunk) -> list[list[str]]: ...
    def lost(self, member: int) -> list[str]: ...
    def collect(self, journal: str | None) -> Collection: ...


Work = Callable[[Any, Any], Sequence[Any]]
"""Of what all tasks share and what a chunk has of its own, the rows of the chunk."""
Pack = Callable[[Chunk], Any]
"""What a chunk has of its own."""


class Outcome(NamedTuple):
    """What became of a chunk."""

    chunk: Chunk
    rows: Sequence[Any] | None
    """None: its workers died."""
    seconds: float = 0.0
    deaths: int = 0
    """Workers that died while they had this chunk."""


class Engine(Protocol):
    """Dask or Ray."""

    workers: int

    def submit(self, chunk: Chunk, packed: Any) -> None: ...
    def next(self) -> Outcome: ...
    def cancel(self) -> None: ...


def sweep(job: Sweep, client: object, journal: str | None, progress: Callable[[int, int], object] | None) -> list[list[str]]:
    """Runs the members that the journal lacks. Returns all rows, in order."""
    collection = job.collect(journal)
    missing = collection.missing()
    done = job.n_members - len(missing)
    report = _throttled(progress, job.n_members)
    report(done)
    for member, row in _rows(_engine(client, job, _run_members), missing, list):
        collection.take(job.lost(member) if row is None else row)
        done += 1
        report(done)
    return collection.finish()


def rollout(
    mechanism: Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    u: ArrayLike | None,
    dt: float,
    *,
    client: object,
    steps: int | None = None,
    integrator: str = "rk4",
) -> Rollout:
    """`Mechanism.rollout` over the workers: q (k, nq), v (k, nv), and u (k, steps, nu), or (steps, nu) for all."""
    import numpy as np

    from . import Rollout

    places, n = np.asarray(q, dtype=np.float64), steps
    if places.ndim != 2:
        raise UsageError("q has no axis of starts", code="wrong-shape", argument="q", hint="give q the shape (k, nq)")
    k, nq, nv = len(places), mechanism.nq, mechanism.nv
    starts = [places, _for_each(v, "v", (k, nv))]
    if u is not None:
        n = np.atleast_2d(u).shape[-2]
        starts.append(_for_each(u, "u", (k, n, mechanism.nu)))
    if n is None:
        raise TypeError("give u, or steps")
    qs, vs = np.full((k, n + 1, nq), np.nan), np.full((k, n + 1, nv), np.nan)
    ok, errors = np.zeros(k, dtype=np.bool_), dict[int, MbsError]()

    def pack(chunk: Chunk) -> Any:
        return [array[chunk] for array in starts]

    shared = mechanism, {"dt": dt, "steps": steps, "threads": 1, "integrator": integrator}
    for start, row in _rows(_engine(client, shared, _run_starts), list(range(k)), pack):
        if row is None:
            errors[start] = MbsError("workers died while they ran this start", code="worker-lost")
            continue
        qs[start], vs[start], ok[start], error = row
        if error is not None:
            errors[start] = error
    return Rollout(qs, vs, ok, dict(sorted(errors.items())))


def _run_members(job: Sweep, members: Chunk) -> list[list[str]]:
    return job.run(members)


def _run_starts(shared: tuple[Any, dict[str, Any]], starts: list[Any]) -> list[tuple[Any, ...]]:
    mechanism, settings = shared
    q, v, ok, errors = mechanism.rollout(*starts, **settings)
    return [(*each, errors.get(i)) for i, each in enumerate(zip(q, v, ok))]


def _for_each(value: ArrayLike, name: str, shape: tuple[int, ...]) -> Any:
    """An argument with an axis of starts."""
    import numpy as np

    array = np.asarray(value, dtype=np.float64)
    if array.shape not in (shape, shape[1:]):
        message = f"{name} has the shape {array.shape}, and {shape[1:]} or {shape} is expected"
        raise UsageError(message, code="wrong-shape", argument=name, hint="the first axis is that of the starts")
    return np.broadcast_to(array, shape)


def _timed(work: Work, shared: Any, packed: Any) -> tuple[Sequence[Any], float]:
    began = time.perf_counter()
    rows = work(shared, packed)
    return rows, time.perf_counter() - began


def _identity(data: Any) -> Any:
    return data


def _rows(engine: Engine, members: Chunk, pack: Pack) -> Iterator[tuple[int, Any]]:
    """Each member with its row, in the order in which they are done; None for one that kills its workers."""
    rest, seconds = deque(members), None
    try:
        while rest and seconds is None:
            pilot = rest.popleft()
            outcome = _alone(engine, pilot, pack)
            seconds = outcome.rows and outcome.seconds
            yield pilot, outcome.rows and outcome.rows[0]
        chunks = _cut(list(rest), _chunk_size(seconds or 0.0, len(rest), engine.workers))
        suspects: Chunk = []
        for outcome in _outcomes(engine, chunks, pack):
            if outcome.rows is None:
                suspects += outcome.chunk
            else:
                yield from zip(outcome.chunk, outcome.rows, strict=True)
        for member in suspects:
            outcome = _alone(engine, member, pack)
            yield member, outcome.rows and outcome.rows[0]
    finally:
        engine.cancel()


def _outcomes(engine: Engine, chunks: Iterator[Chunk], pack: Pack) -> Iterator[Outcome]:
    """What becomes of chunks. The engine has a limited number of them at a time."""
    pending = 0
    for chunk in islice(chunks, PENDING_PER_WORKER * engine.workers):
        engine.submit(chunk, pack(chunk))
        pending += 1
    while pending:
        yield engine.next()
        pending -= 1
        for chunk in islice(chunks, 1):
            engine.submit(chunk, pack(chunk))
            pending += 1


def _alone(engine: Engine, member: int, pack: Pack) -> Outcome:
    """Runs a member while nothing else runs: workers that die then die by it."""
    deaths = 0
    while True:
        engine.submit([member], pack([member]))
        outcome = engine.next()
        deaths += outcome.deaths
        if outcome.rows is not None or deaths >= MAX_DEATHS:
            return outcome


def _cut(members: Chunk, size: int) -> Iterator[Chunk]:
    return (members[i : i + size] for i in range(0, len(members), size))


def _chunk_size(seconds: float, n: int, workers: int) -> int:
    """Members of a chunk, where one takes so many seconds."""
    seconds = max(seconds, 1e-6)
    balanced = n / (CHUNKS_PER_WORKER * workers)
    return max(1, round(min(LONGEST_CHUNK / seconds, max(SHORTEST_CHUNK / seconds, balanced))))


def _throttled(progress: Callable[[int, int], object] | None, total: int) -> Callable[[int], None]:
    last = float("-inf")

    def report(done: int) -> None:
        nonlocal last
        now = time.monotonic()
        if progress is not None and (done == total or now - last >= PERIOD):
            last = now
            progress(done, total)

    return report


def _engine(client: Any, shared: object, work: Work) -> Engine:
    if isinstance(client, str) and client == "ray":
        return _Ray(shared, work)
    if hasattr(client, "submit") and hasattr(client, "scatter"):
        return _Dask(client, shared, work)
    hint = 'give a distributed.Client, or "ray" after ray.init()'
    raise UsageError(f"`client` is {client!r}", code="wrong-kind", argument="client", hint=hint)


class _Dask:
    """A distributed.Client. Its scheduler runs a task again whose worker died, until too many died.

    The shared data are the result of a task: a worker fetches them once, and they are made again where all workers died that had them.
    """

    def __init__(self, client: Any, shared: object, work: Work) -> None:
        self._distributed: Any = import_module("distributed")
        self._client, self._data, self._work = client, shared, work
        self._shared = self._share()
        self._pending: dict[str, tuple[Any, Chunk]] = {}
        self._done = self._distributed.as_completed()
        self.workers = max(1, sum(client.nthreads().values()))

    def submit(self, chunk: Chunk, packed: Any) -> None:
        future = self._client.submit(_timed, self._work, self._shared, packed, pure=False)
        self._pending[future.key] = future, chunk
        self._done.add(future)

    def next(self) -> Outcome:
        future, chunk = self._pending.pop(next(self._done).key)
        try:
            rows, seconds = future.result()
        except self._distributed.KilledWorker as error:
            if error.task != future.key:
                self._shared = self._share()
            return Outcome(chunk, None, deaths=error.allowed_failures + 1)
        return Outcome(chunk, rows, seconds)

    def _share(self) -> Any:
        return self._client.submit(_identity, self._data, pure=False)

    def cancel(self) -> None:
        if self._pending:
            self._client.cancel([future for future, _ in self._pending.values()])


class _Ray:
    """Ray, initialised. A worker process runs one task at a time."""

    RETRIES = 3

    def __init__(self, shared: object, work: Work) -> None:
        try:
            self._ray: Any = import_module("ray")
        except ImportError as error:
            raise UsageError("Ray is not installed", argument="client", hint="pip install multibody[ray]") from error
        if not self._ray.is_initialized():
            raise UsageError("Ray is not initialised", argument="client", hint="call ray.init() before")
        exceptions = self._ray.exceptions
        self._lost = exceptions.WorkerCrashedError, exceptions.OutOfMemoryError, exceptions.NodeDiedError
        self._task = self._ray.remote(max_retries=self.RETRIES)(_timed)
        self._shared, self._work = self._ray.put(shared), work
        self._pending: dict[Any, Chunk] = {}
        self.workers = max(1, int(self._ray.cluster_resources().get("CPU", 1)))

    def submit(self, chunk: Chunk, packed: Any) -> None:
        self._pending[self._task.remote(self._work, self._shared, packed)] = chunk

    def next(self) -> Outcome:
        (done,), _ = self._ray.wait(list(self._pending), num_returns=1)
        chunk = self._pending.pop(done)
        try:
            rows, seconds = self._ray.get(done)
        except self._lost:
            return Outcome(chunk, None, deaths=self.RETRIES + 1)
        return Outcome(chunk, rows, seconds)

    def cancel(self) -> None:
        for task in self._pending:
            self._ray.cancel(task)
