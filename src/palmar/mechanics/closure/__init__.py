"""Which disks and polygons a closed hand can hold."""
