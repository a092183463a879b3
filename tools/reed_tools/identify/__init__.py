"""Inertial parameters and friction of an arm from recorded runs."""
