"""Quantities of a result: values with unit and meaning, residuals, errors, summary."""
