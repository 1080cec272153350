"""Reflexes and plans: programs that turn touch into motion, and what is certain about where they end."""
