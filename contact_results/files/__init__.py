"""The files of a run: summary, tables, fields, stress."""
