"""Studies without Python: an identification that a file describes, ``study.toml``.

``curvewise identify study.toml`` runs one from the shell, and :class:`Study` from Python. The file
names the measured curves, the solver's command and its templates, how its output is read, the
parameters, and how to search; docs/reference/study_file.md has every key.
"""

from .._names import names_alone
from .dry_run import DryRun
from .formulas import Formula
from .result_files import StudyResult
from .study import Study
from .toml_source import StudyError

__all__ = ["DryRun", "Formula", "Study", "StudyError", "StudyResult"]
__dir__ = names_alone(__all__)
