"""What has changed since a version whose numbers were accepted.

`baseline` is what is recorded, `baseline_files` keeps it, `acceptance` makes it from a report, and
`comparison` gives every number of a report its verdict against it. A recorded number is no
reference: it says that something changed, not that it was right.
"""
