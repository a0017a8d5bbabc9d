"""The paper's precision figures and experiments, and ours beside them: docs/accuracy.md."""
