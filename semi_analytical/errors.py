"""What can go wrong in a solve on a surface grid, beside what can go wrong in any solve."""

from contact_scene.solver_errors import GrossSliding as GrossSliding
from contact_scene.solver_errors import NotConverged as NotConverged
from contact_scene.solver_errors import ResourceRefused as ResourceRefused
from contact_scene.solver_errors import SolverError as SolverError
from contact_scene.solver_errors import UnsupportedScene as UnsupportedScene


class ContactAtWindowEdge(SolverError):
    """The contact reached the border of the computed window, so its tractions are cut off."""


class ContactNotResolved(SolverError):
    """The contact lies between the cell centres: no cell touches."""
