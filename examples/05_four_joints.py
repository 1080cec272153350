"""How much does a second joint in each finger add? The best hands of one total length, and what the test-bed hand holds."""

from palmar.mechanics.closure.four_jointed_5_1 import four_jointed_radii
from palmar.mechanics.closure.shortest_hand import shortest_hand

for links in (1, 2, 3):
    hand = shortest_hand(links, radius=0.05)
    parts = " + ".join(f"{1e3 * each:.1f}" for each in hand.links)
    print(f"{links} links: palm {2e3 * hand.half_palm:.1f}, fingers {parts}, in all {1e3 * hand.length:.1f} mm")

radii = four_jointed_radii(half_palm=0.060, proximal=0.137, distal=0.107).overall
print(f"the test bed holds radii up to {1e3 * float(radii.max):.1f} mm without friction, 60.0 with straight fingers")
