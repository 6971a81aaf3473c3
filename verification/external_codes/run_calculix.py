"""Run CalculiX on its decks and write down what comes out.

    python -m verification.external_codes.run_calculix NAME.json

needs `ccx` on the path; one thread, some minutes.
"""

from __future__ import annotations

import hashlib
import json
import os
import resource
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from dataclasses import asdict
from datetime import date
from pathlib import Path
from typing import Any

from verification.external_codes.calculix_deck import Fineness, calculix_deck
from verification.external_codes.calculix_result import read_normal_force, read_tractions
from verification.external_codes.coated_scene import FRICTIONAL, FRICTIONLESS, CoatedScene

SCENES = (FRICTIONLESS, FRICTIONAL)
# Coarse and fine at one stiffness, then the fine mesh with softer springs.
FINENESSES = (Fineness(16, 1000.0), Fineness(32, 1000.0), Fineness(32, 500.0))

LONGEST = 1800.0  # seconds of one run


def deck_hash(deck: str) -> str:
    """By which a deck is known again."""
    return hashlib.sha256(deck.encode("ascii")).hexdigest()


def run_calculix(scene: CoatedScene, fineness: Fineness) -> dict[str, Any]:
    """One run.

    raises  CalledProcessError if ccx fails, TimeoutExpired if it does not end, ValueError if it
            leaves no result
    """
    deck = calculix_deck(scene, fineness)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "deck.inp").write_text(deck, encoding="ascii")
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        subprocess.run(
            ["ccx", "-i", "deck"], cwd=folder, check=True, timeout=LONGEST,
            stdout=subprocess.DEVNULL, env=os.environ | {"OMP_NUM_THREADS": "1"},
        )  # fmt: skip
        spent = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        tractions = read_tractions((folder / "deck.frd").read_text(encoding="ascii"))
        return {
            **asdict(fineness),
            "deck_sha256": deck_hash(deck),
            "normal_force": round(read_normal_force((folder / "deck.dat").read_text("ascii")), 7),
            **asdict(tractions),
            "cpu_seconds": round(spent),
        }


def calculix_version() -> str:
    """As ccx states it."""
    said = subprocess.run(["ccx", "-v"], capture_output=True, text=True, check=False).stdout
    return said.strip().removeprefix("This is Version ")


def record_of(runs: Mapping[str, list[dict[str, Any]]], version: str) -> dict[str, Any]:
    """What is written down: runs by the name of their scene, and how they came to be."""
    return {
        "code": "CalculiX CrunchiX",
        "version": version,
        "command": "python -m verification.external_codes.run_calculix NAME.json",
        "date": date.today().isoformat(),
        "normalisation": (
            "force over the nominal one; radii and tractions over the Hertz radius and pressure "
            "of the bare substrate; shear is its absolute value; as the code gave them, with "
            "penalty: verification/external_codes/recorded.py extrapolates"
        ),
        "accuracy": (
            "after extrapolation to stiff springs, away from axis and edge: force 6e-5, pressure "
            "3e-3 of p_H, shear 3e-3 of µ p_H; from two meshes and two stiffnesses each"
        ),
        "scenes": [{**asdict(scene), "runs": runs[scene.name]} for scene in SCENES],
    }


def main(path: Path) -> None:
    """All runs of all scenes."""
    runs = {scene.name: [run_calculix(scene, each) for each in FINENESSES] for scene in SCENES}
    record = record_of(runs, calculix_version())
    path.write_text(json.dumps(record, indent=1) + "\n", encoding="ascii")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
