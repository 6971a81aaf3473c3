"""What a reader is shown: charts, tables and numbers, as plain records."""
