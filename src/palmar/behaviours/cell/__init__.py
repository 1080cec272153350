"""Reflexes and behaviours of the 3-D cell (chapter 7): pure steps from (state, what the sensors say) to (state, order)."""
