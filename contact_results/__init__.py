"""The files of a run: summary, fields, tables and figures, each written atomically."""
