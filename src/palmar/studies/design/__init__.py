"""From what a hand is to do to the smallest hand that does it."""
