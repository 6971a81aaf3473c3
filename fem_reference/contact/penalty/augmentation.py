"""Uzawa's update: tractions of one pass become the multipliers of the next."""

from collections.abc import Callable, Sequence

from fem_reference.contact.penalty.newton import Iterate
from fem_reference.contact.penalty.spring_contact import PenaltyLaw

Pass = Callable[[PenaltyLaw, Sequence[Iterate]], Iterate]


def augmented(
    solve: Pass, law: PenaltyLaw, starts: Sequence[Iterate], augmentations: int
) -> tuple[list[Iterate], PenaltyLaw]:
    """All passes of an increment, the last one the best, and the law of the last one.

    (Alart and Curnier 1991, Comput. Methods Appl. Mech. Eng. 92, 353; Simo and Laursen 1992,
    Comput. Struct. 42, 97.) One update takes away nearly all of the penalty's error. More do harm:
    Gauss points can carry more pressures than the displacements can tell apart, and what is left
    to chance piles up as ripples. For the same reason the multiplier of the pressure starts from
    zero in every increment; only that of the shear, which remembers, goes on from the last one.

    solve   a pass: from its law and some starts to the solution
    starts  of the first pass; the others start where the one before has ended
    """
    passes = [solve(law, starts)]
    for _ in range(augmentations):
        law = law.carrying(passes[-1].traction)
        passes.append(solve(law, passes[-1:]))
    return passes, law
