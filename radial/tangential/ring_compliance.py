"""Galerkin matrices of tractions on rings for every harmonic, with both bodies and their layers.

p and q_r are ∝ cos mθ, q_θ ∝ sin mθ; for m = 0, q_θ is torsion. P = q_r - q_θ is transformed by
J_{m-1}, Q = q_r + q_θ by J_{m+1}, p by J_m. `hat_integrals` has the integrals of the half-space in
these variables. Layers add

    ∫ k dk ¼[(F_11 + F_sh)(P² + Q²) + 2 (F_sh - F_11) P Q] + ½ C (P - Q) p + F_22 p²

where P, Q, p denote transforms, and F and C are the frequency responses of the layers. The closed
forms and their combination originate here. Weber–Schafheitlin integrals (DLMF 10.22.56) verify
them.
"""

from __future__ import annotations

import numpy as np

from contact_scene.array_types import Array
from radial.frictional.coupling import Coupling
from radial.response.bodies import layer_responses
from radial.response.wavenumbers import wave_blocks
from radial.tangential.hat_integrals import (
    WAVE_POINTS,
    half_space_integrals,
    hat_transforms,
)


def ring_compliance(
    coupling: Coupling, nodes: tuple[float, ...], radius: float, highest: int
) -> Array:
    """Compute the Galerkin compliance matrices of tractions on rings, for every angular harmonic.

    The traction of a node is a hat function φ along the radius r, times cos mθ for q_r and p or sin
    mθ for q_θ. An entry is ∫ φ_i u r dr [length^5/force]: the displacement u in the direction of
    the row by the traction of the column, weighted with the hat function φ_i of the row. The shape
    is (M + 1, 3, 3, n + 1, n + 1): harmonics, directions r, θ, z of displacement and of traction,
    and nodes. Harmonic 0 of q_θ is torsion, which is not coupled to r and z.

    coupling  elastic response of both bodies, with their layers
    nodes     radii of the n + 1 nodes over `radius`, increasing from 0
    radius    unit of the radii [length]
    highest   highest harmonic M
    """
    unit = half_space_integrals(nodes, highest)
    found = np.zeros((highest + 1, 3, 3, len(nodes), len(nodes)))
    mean, difference = (
        (coupling.direct + coupling.across) / 4,
        (coupling.across - coupling.direct) / 4,
    )
    crossed = coupling.crossed / 2
    added = _layer_matrices(coupling, nodes, radius, highest) if coupling.bodies.layered else None
    for m, block in enumerate(found):
        below = abs(m - 1)
        pp, qq = mean * unit.equal_order[below], mean * unit.equal_order[m + 1]
        pq, zz = difference * unit.shifted[m], coupling.direct * unit.equal_order[m]
        # For m = 0 the transform of P has the order -1: J_{-1} = -J_1.
        zp = crossed * unit.stepped[below].T if m else -crossed * unit.stepped[0]
        zq = -crossed * unit.stepped[m]
        if added is not None:
            pp, qq, pq, zz, zp, zq = np.add((pp, qq, pq, zz, zp, zq), added[m])
        block[0, 0] = pp + qq + pq + pq.T
        block[2, 2], block[2, 0] = zz, zp + zq
        block[0, 2] = block[2, 0].T
        block[1, 1] = pp + qq - pq - pq.T
        block[0, 1], block[2, 1] = qq - pp + pq - pq.T, zq - zp
        block[1, 0], block[1, 2] = block[0, 1].T, block[2, 1].T
    return radius**3 * found


def _layer_matrices(
    coupling: Coupling, nodes: tuple[float, ...], radius: float, highest: int
) -> Array:
    """Compute the contribution of layers to the Galerkin compliance matrices of tractions on rings.

    The tractions are expressed by P = q_r - q_θ, Q = q_r + q_θ and the pressure z, because each of
    the three has a Hankel transform of one order: m - 1, m + 1 and m. The six results per angular
    harmonic m couple PP, QQ, PQ, zz, zP and zQ. The shape is (M + 1, 6, n + 1, n + 1). Lengths are
    in units of `radius`. The function `ring_compliance` adds the results to the matrices of
    half-spaces.

    coupling  elastic response of both bodies, with their layers
    nodes     radii of the n + 1 nodes over `radius`, increasing from 0
    radius    unit of length [length]
    highest   highest angular harmonic M
    """
    found = np.zeros((highest + 1, 6, len(nodes), len(nodes)))
    waves = coupling.bodies.waves(radius, max(1.0, nodes[-1]))
    kappa = waves.rule[0]
    scalars = waves.rule[1] * layer_responses(coupling.stacks, waves, radius)
    for some in wave_blocks(len(kappa), (WAVE_POINTS + highest + 2) * len(nodes)):
        fields = hat_transforms(nodes, highest, kappa[some])
        along, c12, c22, across = scalars[:, some]
        mean, apart, half = (along + across) / 4, (across - along) / 4, c12 / 2
        for m, total in enumerate(found):
            # For m = 0 the order -1 is J_{-1} = -J_1.
            p, q, z = (1 if m else -1) * fields[abs(m - 1)], fields[m + 1], fields[m]
            raised = z.T * half
            total += (
                (p.T * mean) @ p,
                (q.T * mean) @ q,
                (p.T * apart) @ q,
                (z.T * c22) @ z,
                raised @ p,
                -raised @ q,
            )
    return found
