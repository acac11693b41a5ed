"""Every tunable number, once, with its unit."""
