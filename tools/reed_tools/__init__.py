"""What people type: runs of the two programs, and the figures, plots and pages made from what they recorded."""
