"""The paper's precision figures and experiments, and ours in comparison: docs/accuracy.md."""
