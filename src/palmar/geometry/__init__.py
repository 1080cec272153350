"""Planar primitives and pure functions; polygons carry the bound of their flattening error."""
