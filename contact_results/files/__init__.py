"""The files of a run: summary, tables, fields, and their readers."""
