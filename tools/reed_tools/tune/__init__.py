"""Gains of a scenario: by rule, then better ones on a small campaign of its own."""
