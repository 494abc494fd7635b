"""selfcheck finds what differs, also at a level that it does not compare with the reference."""

from __future__ import annotations

import io

import pytest

import curvewise
from curvewise.commands import kernel_check
from curvewise.measures.registry import MEASURES

CHECK = (MEASURES["frechet"], {"metric": "euclidean"})
NAME = "frechet euclidean"


@pytest.fixture
def one_check(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kernel_check, "_checks", lambda: iter([CHECK]))
    monkeypatch.setattr(kernel_check, "_TALL", ((33, 3), (3, 33)))


def break_one_bit(monkeypatch: pytest.MonkeyPatch) -> None:
    """Have the compiled library be wrong in the last bit of one distance in a hundred."""
    right, calls = kernel_check._results, iter(range(10**6))

    def wrong(*arguments):
        results = right(*arguments)
        return [results[0] * (1.0 + 2.0**-52), *results[1:]] if next(calls) == 7 else results

    monkeypatch.setattr(kernel_check, "_results", wrong)


def test_a_level_with_the_bits_of_one_that_was_confirmed_needs_no_reference(
    one_check: None, monkeypatch
) -> None:
    known = kernel_check._check_active_level(io.StringIO(), {})
    assert known[NAME]
    monkeypatch.setattr(kernel_check, "_agree", None)  # would fail if it were called
    assert kernel_check._check_active_level(io.StringIO(), known) == known


def test_every_check_is_of_options_that_the_measure_accepts() -> None:
    P, Q = [[0.0, 0.0], [1.0, 2.0], [3.0, 1.0]], [[0.0, 1.0], [2.0, 2.0], [3.0, 0.0]]
    for info, options in kernel_check._checks():
        info.function(P, Q, **kernel_check._arguments(options))


def test_a_wrong_bit_is_found(one_check: None, monkeypatch) -> None:
    known = kernel_check._check_active_level(io.StringIO(), {})
    break_one_bit(monkeypatch)
    said = io.StringIO()
    assert kernel_check._check_active_level(said, known) == {NAME: ""}
    assert "DIFFERS for 1 pairs" in said.getvalue()


@pytest.mark.parametrize(("equal", "expected"), [(True, 0), (False, 1)])
def test_selfcheck_reports_what_it_found(run, monkeypatch, equal, expected):
    def report(stream):
        print("dtw baseline", file=stream)
        return equal

    monkeypatch.setattr("curvewise.commands.kernel_check.run", report)
    assert run("selfcheck") == (expected, "dtw baseline\n", "")


@pytest.mark.nightly
def test_selfcheck_passes_on_this_machine(output):
    out = output("selfcheck")
    assert curvewise.installation.build_info()["active"] in out
