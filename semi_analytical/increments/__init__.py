"""One increment of the load history: normal problem, tangential problem and energy balance."""
