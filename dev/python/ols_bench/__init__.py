"""Benchmarks of the tracker: on clips with ground truth, and on synthetic images."""
