"""Faults to order: what the controller notices of them, how soon, and whether it stays safe."""
