"""Charts, tables and texts of numbers for verification reports, as data records without drawing."""
