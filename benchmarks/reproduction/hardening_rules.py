"""Which hardening the paper's responses have: section 3.3's element beside variants of the point.

At Table 3's parameters the uniaxial Yoshida–Uemori point is 20 to 42 MPa from the responses that
LS-DYNA's *MAT_125 gave. Three things that could explain it are measured: the modulus on unloading;
the rule by which the yield surface's centre moves towards the bounding surface's (a square root of
its distance, as in F. Yoshida, T. Uemori, Int. J. Plasticity 18, 2002, or the distance itself, as
in Armstrong and Frederick's rule); and whether the bounding surface's growth stagnates after a
reversal. Explicit steps of strain, of first order: 1 MPa at most; all responses take a few seconds.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from problems import (
    LOOPS,
    MEASURES,
    TITLES,
    YOUNGS_MODULUS,
    Array,
    paper_parameters,
    paper_responses,
    test_loops,
)
from report import Run, table

SUBSTEP = 5e-5


@dataclass(frozen=True)
class Rule:
    """How the point hardens."""

    square_root: bool = True
    stagnation: bool = True


RULES = {
    "Yoshida and Uemori": Rule(),
    "linear": Rule(square_root=False),
    "no stagnation": Rule(stagnation=False),
    "linear, no stagnation": Rule(square_root=False, stagnation=False),
}


def main() -> None:
    """Measure moduli and rules, write."""
    run = Run(__doc__)
    run.section("moduli", modulus_table())
    run.section("hardening_rules", rule_table(MEASURES[:1] if run.quick else MEASURES))


def turns(strain: Array) -> list[int]:
    """Return where the strain turns back, after its first point."""
    step = np.diff(strain)
    return [0, *(i + 1 for i in range(len(step) - 1) if step[i] * step[i + 1] < 0)]


def modulus_table() -> str:
    """Return the slope of the first step of each branch in GPa, of five responses and the test."""
    rows = []
    for k, test, *responses in zip(
        LOOPS, test_loops(), *(paper_responses(m) for m in MEASURES), strict=True
    ):
        cells = []
        slopes = np.array([first_slopes(response) for response in responses])
        for branch in slopes.T:
            cells.append(f"{branch.min():.1f} to {branch.max():.1f}")
        rows.append([f"loop {k}", *cells, ", ".join(f"{s:.0f}" for s in first_slopes(test))])
    header = ["first slope, GPa", "loading", "after the first turn", "after the second"]
    return table([*header, "test: the three"], rows)


def first_slopes(loop: Array) -> list[float]:
    """Return the slope of the first step after the start and each turning point, in GPa."""
    return [float((s[1] - s[0]) / (e[1] - e[0])) / 1e3 for e, s in map(np.transpose, starts(loop))]


def starts(loop: Array) -> list[Array]:
    """Return the first two points of each branch."""
    return [loop[i : i + 2] for i in turns(loop[:, 0])]


def rule_table(measures: Sequence[str]) -> str:
    """Return how far each rule is from the responses, in MPa, at Table 3's parameters."""
    rows = []
    for name, rule in RULES.items():
        errors, first = {}, []
        for measure in measures:
            found = []
            for response in paper_responses(measure):
                stress = stresses(rule, paper_parameters(measure), response[:, 0])
                found.append(stress - response[:, 1])
                first.append(found[-1][: turns(response[:, 0])[1]])
            errors[measure] = np.concatenate(found)
        every = np.concatenate(list(errors.values()))
        cells = [*errors.values(), every, np.concatenate(first)]
        median = f"{np.median(np.abs(every)):.1f}"
        rows.append([name, *(f"{rms(error):.1f}" for error in cells), median])
    header = ["RMS, MPa", *(TITLES[m] for m in measures), "all", "all, first branches"]
    return table([*header, "all, median"], rows)


def stresses(rule: Rule, parameters: Mapping[str, float], path: Array) -> Array:
    """Return the stress at each point of a strain path, from the unloaded state."""
    bound, size, rate, k, rsat, saturation, h, c1, c2 = parameters.values()
    s = theta = beta = growth = p = q = r = last = 0.0
    result = np.empty_like(path)
    for i, strain in enumerate(path.tolist()):
        steps = max(1, math.ceil(abs(strain - last) / SUBSTEP))
        step = (strain - last) / steps
        last = strain
        n = math.copysign(1.0, step)
        for _ in range(steps):
            trial = s + YOUNGS_MODULUS * step
            beyond = n * (trial - theta - beta) - size
            if beyond <= 0.0:
                s = trial
                continue
            a = bound + growth - size
            recall = math.copysign(math.sqrt(a * abs(theta)), theta) if rule.square_root else theta
            pull = rate * (n * a - recall)
            dp = beyond / (YOUNGS_MODULUS + n * pull + k * (saturation - n * beta))
            theta += pull * dp
            moved = n * saturation + (beta - n * saturation) * math.exp(-k * dp)
            grown = rsat * ((c1 + p + dp) ** c2 - (c1 + p) ** c2)
            p += dp
            outside = abs(moved - q) - r
            if not rule.stagnation:
                growth += grown
            elif outside > 0.0 and (moved - q) * (moved - beta) > 0.0:
                growth += min(1.0, outside / abs(moved - beta)) * grown
                q += (1.0 - h) * math.copysign(outside, moved - q)
                r += h * outside
            beta = moved
            s = theta + beta + n * size
        result[i] = s
    return result


def rms(values: Array) -> float:
    """Return the root mean square."""
    return math.sqrt(np.mean(np.square(values)))


if __name__ == "__main__":
    main()
