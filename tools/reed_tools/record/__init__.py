"""What a run leaves behind, read: telemetry logs, messages, signals, configuration."""
