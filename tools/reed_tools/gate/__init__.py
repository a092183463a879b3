"""Two versions of the controller on the same tapes and scenarios: what changed, and whether a commit says so."""
