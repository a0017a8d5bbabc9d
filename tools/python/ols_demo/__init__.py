"""The demo: a whole simulated site on one computer, run, watched, recorded and judged."""
