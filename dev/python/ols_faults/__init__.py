"""The fault run: applies every fault that a site must survive to a simulated one, and judges."""
