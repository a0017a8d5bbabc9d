"""The estimators over an archive, hour by hour, on many processors (docs/archive.md)."""
