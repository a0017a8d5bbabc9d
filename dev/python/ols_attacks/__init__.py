"""Attacks on a live site that requires signatures (tools/bench attacks)."""
