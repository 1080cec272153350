"""Places where a motion is carried out: the planar kernels under this roof, other physics beside it."""
