"""The same hands and objects in MuJoCo: inertia, limited motors and contacts that give way, for comparison."""
