"""Nine parameters of kinematic hardening from five loops: section 3.3, Tables 3 to 5.

The Yoshida–Uemori point takes the place of LS-DYNA; first it is compared with it, at the paper's
parameters. Then every measure identifies the parameters from the paper's test loops, where it must
do no worse, under itself, than the paper's own response, and from the loops with noise of the text
and of the tables. Written: what each stage of the search found, the parameters beside Table 3, all
measures of all optima beside Tables 4 and 5, and how far noise moves the responses.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from hardening import (
    CLEAN,
    DIGITS,
    DRAWS,
    NOISE,
    all_measures,
    data_sets,
    fits,
    model,
    noisy,
    number,
    paper_values,
    tests,
)
from problems import (
    LOOPS,
    MEASURES,
    TITLES,
    Array,
    hardening_bounds,
    paper_parameters,
    paper_responses,
    tables,
    test_loops,
)
from report import Run, table
from studies import Found

import curvewise

COLUMNS = [TITLES[m] for m in MEASURES]


def main() -> None:
    """Identify, print, write; fail where an optimum is worse than it must be."""
    run = Run(__doc__, workers=1)
    run.section("material_point", point_table())
    run.section("hardening_signal", signal_table())
    names = data_sets(1 if run.quick else DRAWS)
    found = fits(run, [CLEAN, *(name for several in names.values() for name in several)])
    run.section("hardening_stages", stage_table(found, names))
    run.section("hardening_table_3", parameter_table(found[CLEAN], noise=False))
    run.section("hardening_table_4", value_table(found[CLEAN]))
    for case, several in names.items():
        run.section(f"hardening_table_3_{case}", parameter_table(found[several[0]], noise=True))
        run.section(f"hardening_table_5_{case}", noisy_value_table([found[n] for n in several]))
    run.section("hardening_noise", noise_table(found, names))
    run.section("hardening_fit", fit_table(found, names))
    if not run.quick:
        check(found[CLEAN])


def check(found: Mapping[str, Found]) -> None:
    """Fail where the paper's response is better."""
    worse = [m for m in MEASURES if found[m].value > paper_values(m)[m]]
    if worse:
        raise SystemExit(f"worse than the paper's response: {', '.join(worse)}")


def point_table() -> str:
    """Return how far the point is from LS-DYNA, at the parameters of Table 3."""
    rows = []
    for measure in MEASURES:
        parameters = paper_parameters(measure)
        theirs, ours = paper_responses(measure), model()(parameters)
        errors = [q[:, 1] - p[:, 1] for p, q in zip(theirs, ours, strict=True)]
        peaks = [np.abs(p[:, 1]).max() for p in theirs]
        total = math.sqrt(np.mean(np.concatenate(errors) ** 2))
        share = total / math.sqrt(np.mean(np.square(peaks)))
        cells = [f"{value:.1f}" for value in (*map(rms, errors), total)]
        rows.append([TITLES[measure], f"{parameters['C']:.0f}", *cells, f"{100 * share:.1f} %"])
    header = ["row of Table 3", "C", *(f"loop {k}" for k in LOOPS), "RMS, MPa", "of the peak"]
    return table(header, rows)


def signal_table() -> str:
    """Return the signal-to-noise ratios: mean |stress| over the noise's standard deviation."""
    signals = [np.abs(loop[:, 1]).mean() for loop in test_loops()]
    rows = [["*paper, printed*", *(f"*{ratio}*" for ratio in (83.1, 105, 117, 127, 133))]]
    for label, deviation in (("√35 = 5.92", NOISE["5.9"]), ("35", NOISE["35"])):
        rows.append([f"{label} MPa", *(f"{signal / deviation:.1f}" for signal in signals)])
    return table(["standard deviation", *(f"loop {k}" for k in LOOPS)], rows)


def stage_table(
    found: Mapping[str, Mapping[str, Found]], names: Mapping[str, Sequence[str]]
) -> str:
    """Return value and evaluations of SDRM alone, and of the evolution from its optimum."""
    cases = {"none": [CLEAN], **{f"{NOISE[c]:.1f} MPa": names[c] for c in NOISE}}
    rows = []
    for case, several in cases.items():
        for measure in MEASURES:
            stages = [found[name][measure].stages for name in several]
            sdrm, full = (np.mean([s[k].value for s in stages]) for k in (0, 1))
            gains = [1.0 - s[1].value / s[0].value for s in stages]
            counts = [f"{np.mean([s[k].evaluations for s in stages]):.0f}" for k in (0, 1)]
            rows.append(
                [
                    case,
                    TITLES[measure],
                    *(f"{value:.4g}" for value in (sdrm, full)),
                    f"{100 * max(gains):.2f} %",
                    *counts,
                ]
            )
    header = ["noise", "measure", "SDRM", "then DE", "largest gain", "runs, SDRM", "runs, DE"]
    return table(header, rows)


def parameter_table(found: Mapping[str, Found], *, noise: bool) -> str:
    """Return the parameters of every measure, with Table 3's below."""
    rows = []
    for measure, fit in found.items():
        theirs = paper_parameters(measure, noise=noise)
        rows.append([TITLES[measure], *map(parameter, fit.parameters.values())])
        rows.append(["*paper*", *(f"*{parameter(value)}*" for value in theirs.values())])
    return table(["measure", *hardening_bounds()], rows)


def parameter(value: float) -> str:
    """Return a parameter with the digits of Table 3."""
    return f"{value:.0f}" if value >= 2 else f"{value:.3f}"


def value_table(found: Mapping[str, Found]) -> str:
    """Return every measure of every optimum beside Table 4, printed and recomputed."""
    printed = tables()["table_4_without_noise"]
    rows = []
    for measure, fit in found.items():
        theirs = paper_values(measure)
        ours = [number(fit.measures[m], m, bold=m == measure) for m in MEASURES]
        rows.append([TITLES[measure], *ours])
        rows.append(["*paper, recomputed*", *(f"*{number(theirs[m], m)}*" for m in MEASURES)])
        rows.append(["*paper, printed*", *(f"*{value}*" for value in printed[measure])])
    return table(["optimum of", *COLUMNS], rows)


def noisy_value_table(draws: Sequence[Mapping[str, Found]]) -> str:
    """Return every measure of every optimum with noise beside Table 5: mean (range) of draws."""
    printed = tables()["table_5_with_noise"]
    rows = []
    for measure in MEASURES:
        cells = []
        for m in MEASURES:
            values = [draw[measure].measures[m] for draw in draws]
            mean = number(float(np.mean(values)), m, bold=m == measure)
            cells.append(f"{mean} ({min(values):{DIGITS[m]}}–{max(values):{DIGITS[m]}})")
        rows.append([TITLES[measure], *cells])
        rows.append(["*paper, printed*", *(f"*{value}*" for value in printed[measure])])
    return table(["optimum of", *COLUMNS], rows)


def noise_table(
    found: Mapping[str, Mapping[str, Found]], names: Mapping[str, Sequence[str]]
) -> str:
    """Return how far noise moves each response: mean (largest) of the draws, RMS in MPa."""
    rows = []
    for measure in MEASURES:
        reference = model()(found[CLEAN][measure].parameters)
        cells = []
        for case in reversed(NOISE):
            moved = []
            for name in names[case]:
                response = model()(found[name][measure].parameters)
                moved.append(rms(stress(response) - stress(reference)))
            cells.append(f"{np.mean(moved):.1f} ({max(moved):.1f})")
        rows.append([TITLES[measure], *cells])
    return table(["measure", *(f"noise of {NOISE[c]:.1f} MPa" for c in reversed(NOISE))], rows)


def fit_table(found: Mapping[str, Mapping[str, Found]], names: Mapping[str, Sequence[str]]) -> str:
    """Return how far every response is from the tests without noise: area, mean of the draws."""
    rows = []
    for measure in MEASURES:
        cells = []
        for several in ([CLEAN], names["5.9"], names["35"]):
            responses = [model()(found[name][measure].parameters) for name in several]
            areas = [all_measures(test_loops(), response)["area"] for response in responses]
            cells.append(f"{np.mean(areas):.1f}")
        rows.append([TITLES[measure], *cells])
    header = ["area to the tests without noise", "fitted to them", "noise 5.9", "noise 35 MPa"]
    cover = []
    for name in (noisy("5.9", 0), noisy("35", 0)):
        pairs = zip(tests(name), test_loops(), strict=True)
        shares = [curvewise.pcm_match(P, Q).coverage for P, Q in pairs]
        cover.append(f"{min(shares):.2f} to {max(shares):.2f}")
    note = f"Length of the clean tests over that of the noisy ones, scaled: {', '.join(cover)}."
    return f"{table(header, rows)}\n\n{note}"


def stress(loops: Sequence[Array]) -> Array:
    """Return the stresses of all loops, one after the other."""
    return np.concatenate([loop[:, 1] for loop in loops])


def rms(values: Array) -> float:
    """Return the root mean square."""
    return math.sqrt(np.mean(np.square(values)))


if __name__ == "__main__":
    main()
