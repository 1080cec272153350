"""Bodies that meet fingers in zero gravity: motion in contact, single impacts, flight between them, capture."""
