"""The files of a run: summary, fields, tables and figures, written whole or not at all."""
