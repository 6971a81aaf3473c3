"""The picture of the README: a coated contact in partial slip, and the stress below it.

`python docs/picture.py` writes docs/coated_contact.png, the same bytes at every run on a machine.
"""

from pathlib import Path

import numpy as np
from matplotlib.patches import Patch

from contact_results.figures import style
from contact_results.stress.loaded_bodies import state_of_result
from contact_results.stress.on_cells import OnCells
from contact_scene import read_scene_file
from slipstick import solve

HERE = Path(__file__).parent
SCENE = HERE.parent / "scenes" / "coated_fretting.toml"
CHANGES = (
    'loading[2].tangential_force=["60 N", 0]',
    "loading[2].increments=10",
    "semi_analytical.cells=[128, 128]",
)
MM = 1e-3
GPA = 1e9
# of the section [mm]
REACH = 0.5
DEPTH = 0.62
DEPTHS = 120  # with as many points along x the isolines have no visible corners
LEVELS = np.arange(-2.0, 2.01, 0.125)  # [GPa]
ISOLINES = (-3.0, -2.0, -1.0, -0.5, 0.0, 0.5)


def main() -> None:
    """Solve the scene, draw tractions and stress, and write the picture."""
    result = solve(read_scene_file(SCENE, CHANGES))
    end, scene = result.steps[-1], result.scene
    depths = np.linspace(0.0, DEPTH * MM, DEPTHS).tolist()
    section = OnCells(state_of_result(result, None)).stress(depths).section
    with style.figure_style():
        figure = style.new_figure(7.2, 5.8)
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=(1, 1.5))
        surface(above, result.grid.x / MM, end, scene.friction.coefficient)
        drawn = body(below, section, scene.body.layers[0].thickness / MM)
        figure.colorbar(
            drawn,
            ax=below,
            label="σxx (GPa), lines at −3, −2, −1, −½, 0, ½",
            ticks=(-2, -1, 0, 1, 2),
            pad=0.01,
        )
        style.save(figure, HERE / "coated_contact.png")


def surface(ax, x, end, friction) -> None:
    """Draw pressure and shear at y = 0 over the coloured stick and slip zones."""
    middle = len(x) // 2
    pressure, shear = end.pressure[:, middle] / GPA, end.shear[0, :, middle] / GPA
    stuck, touching = end.in_stick[:, middle], end.in_contact[:, middle]
    top = 1.12 * pressure.max()
    zones = (("slip", touching & ~stuck, style.SLIP_COLOUR), ("stick", stuck, style.STICK_COLOUR))
    side = (x[1] - x[0]) / 2
    for _, zone, colour in zones:
        for centre in x[zone]:
            ax.axvspan(centre - side, centre + side, color=colour, alpha=0.3, lw=0)
    lines = [
        *ax.plot(x, pressure, color="black", label="pressure p"),
        *ax.plot(x, shear / friction, label=f"shear q/µ, µ = {friction}", **style.line_style(1)),
    ]
    patches = [Patch(color=colour, alpha=0.3, label=name) for name, _, colour in zones]
    ax.legend(handles=[*lines, *patches], loc="upper right")
    ax.axhline(0, color="black", linewidth=0.5)
    ax.set_ylim(min(0, 1.1 * (shear / friction).min()), top)
    ax.set_ylabel("traction at y = 0 (GPa)")
    load = f"W = {end.normal_force:.0f} N and T = {end.tangential_force[0]:.0f} N →"
    ax.set_title(f"Rigid ball on a coating twice as stiff as its substrate, {load}")


def body(ax, section, interface):
    """Draw σxx on the section y = 0 of each material separately, as it jumps at the interface."""
    x, z = section.x[..., 0] / MM, section.depth[..., 0] / MM
    stress = section.components["xx"][..., 0] / GPA
    for material in np.unique(section.material):
        rows = section.material[:, 0, 0] == material
        field = (x[rows], z[rows], stress[rows])
        drawn = ax.contourf(*field, levels=LEVELS, cmap=style.SIGNED_MAP, extend="both")
        ax.contour(*field, levels=ISOLINES, colors="black", linewidths=0.4, linestyles="solid")
    ax.axhline(interface, color="black", linestyle="--", linewidth=0.8)
    ax.text(-REACH + 0.02, interface - 0.02, "coating 420 GPa", fontsize=8)
    ax.text(-REACH + 0.02, interface + 0.045, "substrate 210 GPa", fontsize=8)
    ax.annotate(
        "tension behind\nthe contact",
        (-0.34, 0.003),
        (-0.485, 0.13),
        arrowprops={"arrowstyle": "->"},
    )
    ax.set(xlim=(-REACH, REACH), ylim=(DEPTH, 0), xlabel="x (mm)", ylabel="depth z (mm)")
    return drawn


if __name__ == "__main__":
    main()
