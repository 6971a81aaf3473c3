"""Coverage of the errors that runs state, over drawn scenes of known answer."""
