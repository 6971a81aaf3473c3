"""Charts, tables and numbers of reports, as plain records."""
