"""Parts of the 3-D cell that need no physics engine: the arm's link with its deadline, the simulated camera, faults."""
