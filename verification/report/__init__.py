"""The report: one record, and the page, the table for machines and the texts made from it.

`record` holds everything that is shown; `page`, `junit` and `summary_text` are functions of it, so
a report can be rendered again from `report.json` alone.
"""
