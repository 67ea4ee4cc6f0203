"""The formulas of the scores: pure functions of numpy arrays that know nothing of files or benchmarks."""
