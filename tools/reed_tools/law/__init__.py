"""Laws from outside: what --law names, and the process that runs a law in Python."""
