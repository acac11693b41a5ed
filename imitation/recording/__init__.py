"""Recordings: written live as MCAP, derived for the Rerun viewer."""
