"""Simulated instruments, and how well ols-calibrate finds out what they are.

The model here is written from the formulas of docs/calibration.md, in numpy alone: it shares no
code with the product, so that a sign that is wrong in one of them shows.
"""
