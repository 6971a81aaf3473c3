"""What the report does not show: a reader must not take silence for success."""

OMISSIONS = (
    "Tilting moments, torque and their rotations are not solved: the indenter does not rotate.",
    "Friction on a coated body is judged for pressing alone (with a reference solution) and, for "
    "tangential loads, by the study gross-sliding; no reference for the latter exists yet.",
    "The finite elements are axisymmetric: neither tilt nor a load that turns, no height map and "
    "no friction map is solved by a second solver.",
    "The paper's own numbers are known from its figures and two printed values only; figure 2 is "
    "compared with the closed form that the paper compares with.",
    "Line contact is not solved: the surface grid is finite in both directions.",
    "For ν > 0 no exact solution of partial slip is known; there the closed form is a companion "
    "within a stated band.",
)
