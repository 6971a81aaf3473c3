"""Charts, tables and texts of numbers for reports, as plain data records."""
