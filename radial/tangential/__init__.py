"""Contact with tangential load: pressure and shear at points on rings, with stick and slip."""
