"""Arm files: from and to URDF, judged, drawn."""
