"""What this machine can do, and what is installed on it."""
