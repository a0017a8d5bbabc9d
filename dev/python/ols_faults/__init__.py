"""The fault run: every fault that a site must survive, done to a simulated one, and judged."""
