"""Where the time of a build and of its tests goes."""
