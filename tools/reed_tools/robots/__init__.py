"""Models of the arm beside the controller's own, and the arm as a picture."""
