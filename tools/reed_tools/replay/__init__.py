"""A recorded run through the controller's own code again: the same to the bit, or the first difference."""
