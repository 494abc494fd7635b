"""Close matches of misspelt names, and the names that a shell completes."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from difflib import get_close_matches

__all__ = ["did_you_mean", "names_alone", "option_hint"]

# What other packages call it, without capitals, blanks, hyphens and underscores.
_ELSEWHERE = {
    "band": "window",
    "itakura": "typeIIIc",
    "discretefrechet": "frechet",
    "l1": "cityblock",
    "l2": "euclidean",
    "linf": "chebyshev",
    "manhattan": "cityblock",
    "maximum": "chebyshev",
    "njobs": "workers",
    "numworkers": "workers",
    "psi": "relax",
    "sakoechibaradius": "window",
    "squared": "sqeuclidean",
    "squaredeuclidean": "sqeuclidean",
    "taxicab": "cityblock",
    "threads": "workers",
}

# What to write for options of other packages, and of papers, that no measure has.
_WITHOUT_OPTION = {
    "derivative": "give slopes: curvewise.curves.derivative(curve) for each curve",
    "dependent": "dtw, and cdist and pdist of dtw, have it; else add {measure}(P[:, c], Q[:, c]) "
    "over all c",
    "globalconstraint": "give window=, or step_pattern='typeIIIc' for Itakura's slopes",
    "itakuramaxslope": "step_pattern='typeIIIc' of dtw has Itakura's slopes",
    "timestamps": "points are one unit of time apart",
    "weights": "multiply the coordinates: P * w and Q * w, with the roots of weights of squares",
}
_WITHOUT_OPTION["independent"] = _WITHOUT_OPTION["dependent"]


def option_hint(measure: str, name: str, known: Iterable[str]) -> str:
    """Return "; ...": what to write instead of an option, or close matches of known options."""
    remedy = _WITHOUT_OPTION.get(_plain(name))
    return f"; {remedy.format(measure=measure)}" if remedy else did_you_mean([name], known)


def did_you_mean(
    names: Iterable[object], known: Iterable[str], shown: Callable[[str], str] = repr
) -> str:
    """Return "; did you mean ...?" for close matches of known names, or "".

    Parameters
    ----------
    names
        The given names; some of them may be correct.
    known
        The known names.
    shown
        Formats a name, with its quotes.
    """
    known = list(known)
    plain = {_plain(name): name for name in known}
    found = []
    for name in names:
        if isinstance(name, str) and name not in known:
            elsewhere = _ELSEWHERE.get(_plain(name))
            near = get_close_matches(_plain(name), plain, n=1)
            found += [elsewhere] if elsewhere in known else [plain[one] for one in near]
    listed = ", ".join(shown(name) for name in dict.fromkeys(found))
    return f"; did you mean {listed}?" if listed else ""


def _plain(name: str) -> str:
    """Return a name without the characters that are most often confused."""
    return name.lower().replace("-", "").replace("_", "").replace(" ", "")


def names_alone(names: Iterable[str]) -> Callable[[], list[str]]:
    """Return a module's ``__dir__``, which lists its public names only."""
    listed = sorted(names)
    return lambda: listed
