"""Scenarios made for an arm by rule: gains, motions, walls."""
