"""Pre-images: build, combine, shrink and measure them."""
