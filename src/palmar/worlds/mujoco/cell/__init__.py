"""The 3-D cell in MuJoCo: a Puma with the Salisbury hand, and a cylinder on a table or hanging from a bar."""
