"""Sweeps: from one case to millions of rows, in shards that survive being killed."""
