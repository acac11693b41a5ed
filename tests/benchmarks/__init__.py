"""Ratios of speed and memory against their bounds: `make bench`."""
