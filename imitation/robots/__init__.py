"""Bodies: arms, cameras, and what moves in front of them."""
