"""The paper's experiments, reproduced on one page."""
