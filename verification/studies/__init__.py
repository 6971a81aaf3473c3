"""Studies of the report: each measures the effect of a numerical choice on accuracy or cost."""
