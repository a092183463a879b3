"""A page on the loopback that shows a run: live from telemetry, or a run folder with a time slider."""
