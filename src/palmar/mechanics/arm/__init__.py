"""The arm that carries the hand: where its joints put the hand, and which joints put it somewhere."""
