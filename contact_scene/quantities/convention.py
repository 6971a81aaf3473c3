"""What a file that leaves the house says of axes and signs; CONVENTIONS.md in one line."""

CONVENTION = (
    "SI units. x and y lie in the plane of contact, z points into the lower body [body], which "
    "fills z >= 0; the origin is the point of first touch. Tractions act on the lower body: "
    "pressure is positive in compression, so that sigma_zz = -pressure, sigma_xz = -shear_x and "
    "sigma_yz = -shear_y at z = 0. Slip is of the lower body against the indenter since the start "
    "of the history; approach, forces and shifts are of the indenter against the body."
)

OF_THE_INDENTER = (
    "SI units. x and y lie in the plane of contact, z points into the indenter, which fills "
    "z >= 0; the origin is the point of first touch. Tractions act on the indenter: pressure is "
    "positive in compression, so that sigma_zz = -pressure, sigma_xz = -shear_x and "
    "sigma_yz = -shear_y at z = 0."
)
