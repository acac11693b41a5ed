"""What each command does inside a run: a Hydra function that makes the parts and joins them."""
