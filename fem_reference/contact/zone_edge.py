"""Contact that has outgrown the zone of fine elements."""

from contact_scene.solver_errors import ContactAtZoneEdge


def refuse_contact_at_edge(is_there: bool, radius: float) -> None:
    """Raise ContactAtZoneEdge where the contact is at the outer radius of the zone [length]."""
    if is_there:
        raise ContactAtZoneEdge(
            f"the contact reaches {radius:.6g} m, where the zone of fine elements ends; give a "
            f"larger contact_radius"
        )
