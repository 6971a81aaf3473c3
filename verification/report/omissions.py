"""What the report does not show: a reader must not take silence for success."""

OMISSIONS = (
    "Tilt and torsion are judged by problems of their own: torsion of balls up to sliding, with a "
    "coating and without, a punch and a ball pressed beside their axes. No case and no reference "
    "has them together with a tangential push.",
    "Tangential loads on coated bodies with friction have no closed form: they are judged by the "
    "other solvers, by an external code and by the study coated-tractions.",
    "Where both solvers are compared they take the same increments: what finite increments cost is "
    "judged apart, by refining them.",
    "The finite elements are axisymmetric: neither tilt nor a load that turns, no height map and "
    "no friction map is solved by a second solver.",
    "The paper's own numbers are known from its figures and two printed values only; figure 2 is "
    "compared with the closed form that the paper compares with.",
    "Line contact is not solved: the surface grid is finite in both directions.",
    "For ν > 0 no exact solution of partial slip is known; there the closed form is a companion "
    "within a stated band.",
)
