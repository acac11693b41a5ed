"""What runs on a robot: generators of samples."""
