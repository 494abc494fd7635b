"""``python -m curvewise``: the same as the command ``curvewise``."""

from __future__ import annotations

import sys

from .commands import main

if __name__ == "__main__":
    sys.exit(main())
