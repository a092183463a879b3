"""All tests: which runners there are, and what they say."""
