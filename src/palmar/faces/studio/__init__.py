"""The web page: a server that parses, calls and serialises; what it shows is computed where the command line computes it."""
