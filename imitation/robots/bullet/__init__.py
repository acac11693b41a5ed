"""Arms and cameras in a PyBullet world."""
