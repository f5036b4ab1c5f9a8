"""What came of a study: monitor, people and their records, results, export."""
