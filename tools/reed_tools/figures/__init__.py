"""From records to figures, checks, pictures and the report of one run."""
