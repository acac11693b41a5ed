"""Controllers of reaching: each sets V, A and epsilon in its own way."""
