"""Which finger length holds cylinders of 20 to 60 mm radius without friction, on a palm of 130 mm?"""

from palmar.mechanics.closure.sizing import Dimension, Grip, sufficient

intervals = sufficient(Grip(half_palm=0.065, finger_length=0.0), Dimension.FINGER_LENGTH, 0.020, 0.060)
(shortest_m, longest_m) = intervals[0]
print(f"fingers of at least {1e3 * shortest_m:.2f} mm")
