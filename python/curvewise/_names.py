"""What a misspelt name was meant to be."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from difflib import get_close_matches

__all__ = ["did_you_mean"]


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
            found += [plain[near] for near in get_close_matches(_plain(name), plain, n=1)]
    listed = ", ".join(shown(name) for name in dict.fromkeys(found))
    return f"; did you mean {listed}?" if listed else ""


def _plain(name: str) -> str:
    """Return a name without the characters that are most often confused."""
    return name.lower().replace("-", "").replace("_", "").replace(" ", "")
