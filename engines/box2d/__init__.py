"""Box2D: distance joints that are springs, of version 2.3 and of version 3, each by a package of its own."""
