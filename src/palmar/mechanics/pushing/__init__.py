"""Quasi-static pushing on a table: limit surfaces, Coulomb contacts, and the motions that links and pushers impose."""
