"""A bench for emergent imitation: visuo-motor maps, attractor dynamics, and the arms they move."""
