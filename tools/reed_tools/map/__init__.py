"""How much delay, jitter and loss a scenario bears: a grid of runs, with the border of its limits and that of stability."""
