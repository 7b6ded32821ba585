"""Socially guided intrinsic motivation."""
