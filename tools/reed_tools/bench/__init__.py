"""Speed and latency, measured beside what they are compared with."""
