"""A run in the formats of other tools, and frames of the bus in engineering units."""
