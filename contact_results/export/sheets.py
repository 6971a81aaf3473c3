"""What is exported of a run or a stress, by the names of its files: tables and groups of arrays."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from contact_results.files.stored_run import StoredRun
from contact_results.files.stored_table import StoredTable, StoredValues
from contact_results.stress.stored_stress import StoredMesh, StoredStress
from contact_scene.increment import SCALARS, components, numbers

Stored = StoredRun | StoredStress
Sheets = Mapping[str, StoredTable]


def title_of(stored: Stored) -> str:
    """Of the scene."""
    return stored.summary.title if isinstance(stored, StoredRun) else str(stored.record["title"])


def tables_of(stored: Stored) -> Sheets:
    """What has rows, for a spreadsheet."""
    steps = {"steps": _steps(stored)} if isinstance(stored, StoredRun) else {}
    return steps | dict(stored.tables)


def arrays_of(stored: Stored) -> Sheets:
    """Everything, arrays of any number of indices; those of fields instead of their tables."""
    if isinstance(stored, StoredRun):
        groups = {
            "coordinates": stored.coordinates,
            "increments": stored.increments,
            "last_cycle": stored.last_cycle,
        }
        return {**tables_of(stored), **{name: group for name, group in groups.items() if group}}
    meshes = {"section": stored.section, "surface": stored.surface, "volume": stored.volume}
    return {
        **tables_of(stored),
        **{name: _arrays(mesh) for name, mesh in meshes.items() if mesh is not None},
    }


def _arrays(mesh: StoredMesh) -> StoredTable:
    return {"points": mesh.points, "cells": mesh.cells, **mesh.fields}


def _steps(run: StoredRun) -> StoredTable:
    """One row per loading step, the error of a number in the column behind it."""
    columns: dict[str, StoredValues] = {
        "step": StoredValues(
            np.arange(1, len(run.summary.steps) + 1), "", "Loading step, from 1.", ("row",)
        )
    }
    values = [numbers(step) for step in run.summary.steps]
    for name, mark in SCALARS.items():
        for place, part in enumerate(components(name)):
            found = [of_step[part] for of_step in values]
            if any(value is not None for value in found):
                columns[part] = StoredValues(_array(found), mark.unit, mark.meaning, ("row",))
            errors = [_error(step.errors, name, place) for step in run.summary.steps]
            if any(error is not None for error in errors):
                meaning = f"How far {part} may be from the exact answer."
                columns[f"{part}_error"] = StoredValues(
                    _array(errors), mark.unit, meaning, ("row",)
                )
    return columns


def _error(errors: object, name: str, place: int) -> float | None:
    stated = errors.get(name) if isinstance(errors, Mapping) else None
    if stated is None or stated.error is None:
        return None
    return float(np.ravel(stated.error)[place]) if np.ndim(stated.error) else float(stated.error)


def _array(values: list[float | int | None]) -> np.ndarray:
    return np.array([np.nan if value is None else value for value in values], dtype=np.float64)
