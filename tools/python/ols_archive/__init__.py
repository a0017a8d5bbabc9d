"""The archive: a region's messages as hourly Parquet files (docs/archive.md)."""
