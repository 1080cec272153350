"""Frozen inputs: the hand, the object, their contact, the support, and the case file that holds them."""
