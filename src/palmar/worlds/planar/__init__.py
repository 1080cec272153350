"""The planar world: the kernels of the mechanics, from a case to ends, poses over time, and events."""
