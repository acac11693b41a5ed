"""From recordings and samples to numbers, figures and claims."""
