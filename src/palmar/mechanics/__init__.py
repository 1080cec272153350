"""Closed forms and kernels: SI floats and arrays in, arrays out, no input or output."""
