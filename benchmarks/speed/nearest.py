"""The nearest of many curves: how fast an exact index is beside all distances, ours and others'.

    python benchmarks/speed/nearest.py [datasets loops tracks subsequence memory interrupts stress]

Sections, of a few seconds to a minute each, print a line for each measurement and, with --output,
write them to a JSON file. Every answer of an index is compared with that of a stable sort of all
distances, where these are computed at all. What a peer does not finish within seconds it does for
some of the queries; its time is that of a query, times the queries. `stress` compares --queries
small random queries, with many equal distances, on one to three threads.
"""

from __future__ import annotations

import timing  # before numpy: it sets the number of threads
from stored import read_json, write_json

# isort: split
import argparse
import importlib
import importlib.util
import os
import pickle
import resource
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import curvewise
from curvewise.datasets import kinematic_hardening

sys.path.insert(0, str(Path(__file__).parents[2] / "tests" / "python" / "many"))

Curve = np.ndarray[Any, np.dtype[np.float64]]
Curves = list[Curve]
results: list[dict[str, Any]] = []


def report(section: str, what: str, **numbers: Any) -> None:
    results.append({"section": section, "what": what, **numbers})
    shown = ", ".join(
        f"{name} {value:.4g}" if isinstance(value, float) else f"{name} {value}"
        for name, value in numbers.items()
    )
    print(f"{section:12s} {what:42s} {shown}", flush=True)


def timed(call: Callable[[], Any]) -> tuple[float, Any]:
    start = time.perf_counter()
    result = call()
    return time.perf_counter() - start, result


def loops(count: int, seed: int, points: int = 200) -> tuple[Curves, np.ndarray[Any, Any]]:
    """Make hysteresis loops of ten steels: constants scatter by 2 %, and stress by 3 MPa."""
    random, steels = np.random.default_rng(seed), np.random.default_rng(99)
    constants = steels.uniform((200, 2e4, 100, 0.01), (500, 1.2e5, 600, 0.03), (10, 4))
    steel = np.arange(count) % 10
    curves = []
    for stress0, modulus, gamma, amplitude in constants[steel] * random.normal(1, 0.02, (count, 4)):
        strain = amplitude * np.sin(np.linspace(0, 2.5 * np.pi, points))
        stress = kinematic_hardening(strain, yield_stress=stress0, backstresses=[(modulus, gamma)])
        noise = random.normal(0, 3, points)
        curves.append(np.column_stack([strain / 0.02, (stress + noise) / 500]))
    return curves, steel


def tracks(count: int, seed: int, points: int = 250) -> Curves:
    """Make tracks in metres between two of sixty places within 20 km, on ways that bend."""
    random = np.random.default_rng(seed)
    places = np.random.default_rng(5).uniform(0, 20e3, (60, 2))
    t = np.linspace(0, 1, points)[:, np.newaxis]
    bends = np.sin(np.pi * t * np.arange(1, 5))
    made = []
    for _ in range(count):
        a, b = places[random.choice(60, 2, replace=False)] + random.normal(0, 100, (2, 2))
        way = a + (b - a) * t + bends @ random.normal(0, 300, (4, 2))
        made.append(way + random.normal(0, 5, (points, 2)))
    return made


def packaged() -> dict[str, tuple[Curves, Any, Curves, Any]]:
    """Return what tslearn and aeon ship: known curves and classes, new curves and classes."""
    sets = {}
    loader = importlib.import_module("tslearn.datasets").CachedDatasets()
    known, y, new, z = loader.load_dataset("Trace")
    sets["Trace (tslearn)"] = (list(known), y, list(new), z)
    load = importlib.import_module("aeon.datasets").load_classification
    for name in ("ArrowHead", "GunPoint", "ItalyPowerDemand", "OSULeaf", "BasicMotions"):
        (known, y), (new, z) = (load(name, split=part) for part in ("train", "test"))
        known, new = ([np.ascontiguousarray(case.T) for case in part] for part in (known, new))
        sets[f"{name} (aeon)"] = (known, y, new, z)
    return sets


def peers(known: Curves, new: Curves) -> dict[str, tuple[int, Callable[[int], Any]]]:
    """Return, by package, how many queries to time, and all distances of so many."""
    stack = np.stack(known)
    queries = np.stack(new)
    calls: dict[str, Callable[[int], Any]] = {}
    tslearn = importlib.import_module("tslearn.metrics").cdist_dtw
    calls["tslearn"] = lambda k: tslearn(queries[:k], stack) ** 2
    aeon = importlib.import_module("aeon.distances").dtw_pairwise_distance
    cases, asked = stack.swapaxes(1, 2).copy(), queries.swapaxes(1, 2).copy()
    calls["aeon"] = lambda k: aeon(asked[:k], cases)
    dtai = importlib.import_module("dtaidistance.dtw_ndim").distance_fast
    calls["dtaidistance"] = lambda k: np.array([[dtai(P, Q) ** 2 for Q in known] for P in new[:k]])
    neighbors = importlib.import_module("sklearn.neighbors").NearestNeighbors
    shape = known[0].shape

    def measure(p: Curve, q: Curve) -> float:
        return curvewise.dtw(p.reshape(shape), q.reshape(shape), metric="sqeuclidean")

    model = neighbors(n_neighbors=1, algorithm="brute", metric=measure)
    model.fit(stack.reshape(len(stack), -1))
    calls["sklearn with curvewise.dtw"] = lambda k: model.kneighbors(queries[:k].reshape(k, -1))[0]
    some = max(1, min(len(new), int(4e8 / (len(known) * shape[0] ** 2))))
    return {name: (some, call) for name, call in calls.items()}


def compare_index(
    section: str, name: str, known: Curves, new: Curves, measure: str, **options: Any
) -> np.ndarray[Any, Any]:
    """Time an index against all distances, which its answers must equal; return the indices."""
    making, index = timed(lambda: curvewise.Index(known, measure, **options))
    counted = index._index.kneighbors(new, 1, 1, None, 0)[2]
    one, (distances, indices) = timed(lambda: index.kneighbors(new, 1))
    two, again = timed(lambda: index.kneighbors(new, 1, workers=2))
    some = new[: max(1, len(new) // 5)] if len(known) > 1000 else new
    all_seconds, table = timed(lambda: curvewise.cdist(some, known, measure, **options))
    order = np.argsort(table, axis=1, kind="stable")[:, :1]
    assert np.array_equal(indices[: len(some)], order)
    assert np.array_equal(distances[: len(some)], np.take_along_axis(table, order, axis=1))
    assert np.array_equal(again[1], indices)
    full = all_seconds * len(new) / len(some)
    report(
        section,
        f"{name}: {measure} {options or ''}",
        cdist_s=full,
        index_s=one,
        two_threads_s=two,
        making_s=making,
        faster=full / one,
        computed=f"{100 * counted[2] / counted[0]:.2f} %",
    )
    return indices[:, 0]


def run_datasets() -> None:
    for name, (known, y, new, z) in packaged().items():
        window = len(known[0]) // 10
        nearest = compare_index("datasets", name, known, new, "dtw", metric="sqeuclidean")
        compare_index("datasets", name, known, new, "dtw", metric="sqeuclidean", window=window)
        compare_index("datasets", name, known, new, "dtw")
        compare_index("datasets", name, known, new, "dtw", window=window)
        report(
            "datasets",
            name,
            known=len(known),
            new=len(new),
            points=len(known[0]),
            accuracy=float(np.mean(np.asarray(y)[nearest] == z)),
        )


def run_loops() -> None:
    (known, y), (new, z) = loops(5000, 0), loops(200, 1)
    for measure, options in (
        ("dtw", {}),
        ("dtw", {"metric": "sqeuclidean"}),
        ("dtw", {"window": 20}),
        ("frechet", {}),
    ):
        nearest = compare_index("loops", "5,000 loops", known, new, measure, **options)
        report("loops", "  the right steel", accuracy=float(np.mean(y[nearest] == z)))


def run_peers() -> None:
    (known, _), (new, _) = loops(5000, 0), loops(200, 1)
    table = curvewise.cdist(new[:1], known, metric="sqeuclidean")
    for name, (some, call) in peers(known, new).items():
        call(1)  # compiles
        seconds, found = timed(lambda call=call, some=some: call(some))
        np.testing.assert_allclose(np.min(found[0]), table.min(), rtol=1e-9)
        report("peers", f"5,000 loops: {name}", of_200_s=seconds * len(new) / some, queries=some)


def run_tracks() -> None:
    known, new = tracks(20_000, 0), tracks(500, 1)
    for measure in ("frechet", "frechet_continuous"):
        making, index = timed(lambda measure=measure: curvewise.Index(known, measure))
        for radius in (500.0, 1000.0, 1500.0):
            for decided in (False, True):
                seconds, found = timed(
                    lambda index=index, radius=radius, decided=decided: (
                        index._index.radius_neighbors(
                            new, radius, not decided, not decided, 1, None
                        )
                    )
                )
                pairs, refined, computed = found[3]
                report(
                    "tracks",
                    f"{measure} within {radius:g} m{', decided' if decided else ''}",
                    queries_per_s=len(new) / seconds,
                    found=len(found[1]) / len(new),
                    refined=f"{100 * refined / pairs:.3f} %",
                    computed=f"{100 * computed / pairs:.3f} %",
                )
        table = curvewise.cdist(new[:5], known, measure, cutoff=1000.0)
        near = index.radius_neighbors(new[:5], 1000.0)
        for i, row in enumerate(table):
            order = np.argsort(row, kind="stable")
            assert np.array_equal(near[1][i], order[row[order] <= 1000.0])
        report("tracks", f"{measure}: making the index", seconds=making)


def run_subsequence() -> None:
    random = np.random.default_rng(0)
    record = random.normal(size=(1_000_000, 2)).cumsum(axis=0)
    cycle = record[500_000:500_200] + random.normal(0, 0.01, (200, 2))
    for measure in ("dtw", "frechet"):
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for k in (1, 10):
            for workers in (1, 2):
                seconds, found = timed(
                    lambda k=k, workers=workers, measure=measure: curvewise.subsequence(
                        cycle, record, k=k, measure=measure, workers=workers
                    )
                )
                assert (found[0].start, found[0].stop) == (500_000, 500_199)
                report("subsequence", f"{measure}, k = {k}, {workers} threads", seconds=seconds)
        after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        report("subsequence", f"{measure}: more peak memory", megabytes=(after - before) / 1024)
    align = importlib.import_module("dtaidistance.subsequence.dtw").subsequence_alignment
    for size in (10_000, 100_000):
        part = record[-size:, :1].copy()
        ours, _ = timed(lambda part=part: curvewise.subsequence(cycle[:, :1], part))
        theirs, _ = timed(
            lambda part=part: align(cycle[:, 0].copy(), part[:, 0].copy(), use_c=True).best_match()
        )
        report("subsequence", f"1-D, 200 in {size}: dtaidistance", seconds=theirs, ours_s=ours)
    run_normalized(random)


def run_normalized(random: np.random.Generator) -> None:
    """Two copies of a walk, scaled and with noise, in another of a million points."""
    record, shape = random.normal(size=1_000_000).cumsum(), random.normal(size=128).cumsum()
    for at in (123_456, 700_001):
        record[at : at + 128] = 3 * shape + record[at] + 0.1 * random.normal(size=128)
    for window, k in ((0, 5), (6, 3)):
        seconds, found = timed(
            lambda window=window, k=k: curvewise.subsequence(
                shape, record, k=k, metric="sqeuclidean", window=window, normalize=True
            )
        )
        assert {run.start for run in found[:2]} == {123_456, 700_001}
        report("subsequence", f"normalize, 128 in 10^6, window = {window}", seconds=seconds)
    if importlib.util.find_spec("stumpy") is None:
        print("subsequence  install stumpy to time it, too")
        return
    match = importlib.import_module("stumpy").match
    match(shape, record[:1000])  # compiles
    seconds, _ = timed(lambda: match(shape, record, max_matches=5, max_distance=np.inf))
    report("subsequence", "normalize, 128 in 10^6: stumpy", seconds=seconds)


def run_memory() -> None:
    for measure in ("dtw", "area", "frechet_continuous"):
        code = (
            "import numpy as np, curvewise\n"
            "X = np.random.default_rng(0).normal(size=(100_000, 100, 2))\n"
            "used = lambda: int(open('/proc/self/statm').read().split()[1]) * 4096\n"
            "before = used()\n"
            f"index = curvewise.Index(X, {measure!r})\n"
            "print(used() - before)\n"
        )
        done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)
        report(
            "memory",
            f"100,000 curves of 100 points: {measure}",
            megabytes=int(done.stdout) / 1e6,
            of_points_mb=160,
        )


def run_interrupts() -> None:
    known, _ = loops(5000, 0)
    record = np.vstack(known)
    calls = {
        "kneighbors": lambda: curvewise.Index(known).kneighbors(n_neighbors=4000),
        "kneighbors, 2 threads": lambda: curvewise.Index(known).kneighbors(
            n_neighbors=4000, workers=2
        ),
        "kneighbors, pcm": lambda: curvewise.Index(known, "pcm").kneighbors(n_neighbors=1),
        "radius, continuous": lambda: curvewise.Index(known, "frechet_continuous").radius_neighbors(
            radius=10.0
        ),
        "subsequence": lambda: curvewise.subsequence(record[:10_000], record),
        "dtw_mean": lambda: curvewise.dtw_mean(known, initial=known[0], workers=2),
    }
    for name, call in calls.items():
        sent: list[float] = []

        def send(sent: list[float] = sent) -> None:
            sent.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)

        timer = threading.Timer(0.7, send)
        timer.start()
        try:
            call()
            report("interrupts", name, over_before="0.7 s")
        except KeyboardInterrupt:
            report("interrupts", name, latency_ms=1e3 * (time.perf_counter() - sent[0]))
        timer.join()
    times: list[tuple[float, float]] = []
    curvewise.Index(known).kneighbors(
        loops(300, 1)[0],
        5,
        progress=lambda done, total: times.append((time.perf_counter(), done / total)),
    )
    steps = np.diff([part for _, part in times])
    gaps = np.diff([when for when, _ in times])
    report(
        "interrupts",
        "progress of 300 queries",
        reports=len(times),
        longest_gap_ms=1e3 * float(gaps.max()),
        largest_step=float(steps.max()),
    )


def run_stress(queries: int) -> None:
    tests = importlib.import_module("test_index")
    random = np.random.default_rng(int(time.time()))
    done = 0
    while done < queries:
        measure, options = tests.CASES[random.integers(len(tests.CASES))]
        count = int(random.integers(1, 40))
        curves = tests.random_curves(random, count + 4, measure)
        X, known = [*curves[-4:], curves[0]], curves[:-4]
        distances, indices = tests.brute_force(X, known, measure, options)
        index = pickle.loads(pickle.dumps(curvewise.Index(known, measure, **options)))
        for n_neighbors in {1, int(random.integers(1, count + 1)), count}:
            for workers in (1, 2, 3):
                found = index.kneighbors(X, n_neighbors, workers=workers)
                np.testing.assert_array_equal(found[0], distances[:, :n_neighbors])
                np.testing.assert_array_equal(found[1], indices[:, :n_neighbors])
                done += len(X)
    report("stress", "queries equal to brute force", queries=done)


SECTIONS: dict[str, Callable[[], None]] = {
    "datasets": run_datasets,
    "loops": run_loops,
    "peers": run_peers,
    "tracks": run_tracks,
    "subsequence": run_subsequence,
    "memory": run_memory,
    "interrupts": run_interrupts,
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("sections", nargs="*", choices=[*SECTIONS, "stress", []])
    parser.add_argument("--queries", type=int, default=100_000)
    parser.add_argument("--output", type=Path)
    given = parser.parse_args()
    for section in given.sections or SECTIONS:
        if section == "stress":
            run_stress(given.queries)
        else:
            SECTIONS[section]()
    if given.output:
        known = read_json(given.output).get("rows", [])
        kept = [row for row in known if row["section"] not in {r["section"] for r in results}]
        packages = ["curvewise", "numpy", "tslearn", "aeon", "dtaidistance", "scikit-learn"]
        content = {"machine": timing.machine(packages), "rows": kept + results}
        write_json(given.output, content)


if __name__ == "__main__":
    main()
