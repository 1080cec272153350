"""Slow rival methods that the fast code is compared with; they share no formula with it."""
