"""Histories from result files of CalculiX, Abaqus and LS-DYNA.

Each reader returns a :class:`SolverOutput`, which prints as a list of what the file holds and gives
one number per increment: ``read_calculix_dat("deck.dat").history("fx", set_name="PULLED")``. A
`read` of :class:`curvewise.calibration.CommandModel` puts a curve together from two of them; a
study file (:mod:`curvewise.studies`) does so without Python. `read_card` reads a material card back
that :meth:`curvewise.materials.Material.card` has written.
"""

from .._names import names_alone
from .abaqus_dat import read_abaqus_dat
from .calculix_dat import read_calculix_dat
from .calculix_frd import read_calculix_frd
from .cards import SolverCard, TabulatedLayer, read_card
from .ls_dyna_binout import read_ls_dyna_binout
from .ls_dyna_text import read_ls_dyna_elout, read_ls_dyna_nodout
from .overlaid_mesh import overlaid_mesh
from .solver_output import SolverOutput

__all__ = [
    "SolverCard",
    "SolverOutput",
    "TabulatedLayer",
    "overlaid_mesh",
    "read_abaqus_dat",
    "read_calculix_dat",
    "read_calculix_frd",
    "read_card",
    "read_ls_dyna_binout",
    "read_ls_dyna_elout",
    "read_ls_dyna_nodout",
]
__dir__ = names_alone(__all__)
