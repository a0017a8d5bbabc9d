"""Mutation testing of the C++ product code: tools/mutate."""
