"""Two or more runs, or campaigns, beside each other: what differs comes first."""
