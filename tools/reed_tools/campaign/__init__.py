"""Many runs with drawn numbers, and what holds for all of them."""
