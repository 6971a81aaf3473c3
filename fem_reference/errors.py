"""What can go wrong in a finite-element solve, beside what can go wrong in any solve."""

from contact_scene.solver_errors import SolverError


class ContactAtZoneEdge(SolverError):
    """The contact reached the end of the zone of fine elements, so its tractions are cut off."""
