"""One run: its bus, its two programs, its progress, its end."""
