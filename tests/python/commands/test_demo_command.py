"""demo: the built-in pair, compared and drawn."""

from __future__ import annotations

from command_runs import MEASURES, PNG, numbers

import curvewise


def test_demo_prints_five_measures_and_writes_a_picture(output, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    out = output("demo")
    assert "241 points" in out
    assert "151 points" in out
    expected = curvewise.compare(*curvewise.datasets.hysteresis_pair())
    assert str(expected) in out
    assert list(numbers(out)) == MEASURES
    assert out.endswith("\npicture: curvewise_demo.png\n")
    assert (tmp_path / "curvewise_demo.png").read_bytes().startswith(PNG)


def test_demo_writes_where_it_is_told(run, tmp_path):
    output = tmp_path / "here.svg"
    status, out, _ = run("demo", "--output", str(output))
    assert status == 0
    assert str(output) in out
    assert output.read_bytes().startswith(b"<?xml")
