"""Figures of a gear coupling at one operating point."""

from math import degrees

import numpy as np

from app.figures.data import (
    Axis,
    Bars,
    Figure,
    Hue,
    Level,
    Line,
    Mark,
    Panel,
    Ribbon,
    Row,
    Span,
    Values,
    values,
)
from app.figures.declaration import Declaration, present
from app.figures.models.friction_map import friction_map
from app.figures.wording import number, percent
from app.schema.coupling import CouplingRequest, CouplingResponse

QUARTERS = (0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0, 360.0)
TOOTH = Axis("tooth position φ (tilt at 90° and 270°)", "°", limits=(0.0, 360.0), ticks=QUARTERS, magnitude=False)
TILTS = (Span(82.0, 98.0, ""), Span(262.0, 278.0, ""))


def _tilt_deg(request: CouplingRequest) -> float:
    """Tilt of hub against sleeve [°], given or by the offset of the shafts."""
    return degrees(request.inputs().operation.misalignment)


def tooth_loads(request: CouplingRequest, answer: CouplingResponse) -> Figure:
    """Tangential force of each tooth, mean and largest; the pitch errors behind it."""
    load = present(answer.load_distribution)
    curves = present(load.curves)
    angle, force = values(curves.angle_deg), values(curves.tangential_force_n)
    largest = int(np.argmax(force))
    teeth = f"{load.loaded_teeth} of {force.size} teeth carry"
    tilt = f"at {number(abs(_tilt_deg(request)))}° tilt"
    panels = [
        Panel(
            x=TOOTH,
            y=Axis("tangential force", "N"),
            bars=(Bars("tangential force", angle, force, Hue.BLUE, strong=largest),),
            levels=(Level(load.mean_tangential_force_n, f"mean {number(load.mean_tangential_force_n, 'N')}"),),
            marks=(Mark(float(angle[largest]), float(force[largest]), number(float(force[largest]), "N")),),
        )
    ]
    if request.coupling.pitch_errors_um is not None:
        error = Axis("pitch error (positive: carries more)", "µm", magnitude=False)
        bars = Bars("pitch error", angle, values(request.coupling.pitch_errors_um), Hue.VERMILLION)
        panels.append(Panel(x=TOOTH, y=error, bars=(bars,)))
    concentration = load.load_concentration
    share = "" if concentration is None else f"; the highest loaded takes {number(concentration)} times the mean {tilt}"
    return Figure(f"{teeth}{share}", tuple(panels))


def tooth_motion(_: CouplingRequest, answer: CouplingResponse) -> Figure:
    """What wears, what builds the film and what loads a tooth over a revolution."""
    kinematics, limits = present(answer.kinematics), present(answer.limits)
    curves = present(kinematics.curves)
    angle, limit = values(curves.angle_deg), limits.sliding_velocity_limit_m_per_s
    sliding = values(curves.sliding_velocity_m_per_s)
    share = kinematics.max_sliding_velocity_m_per_s / limit
    top = int(np.argmax(sliding))
    panels = (
        Panel(
            x=TOOTH,
            y=Axis("sliding velocity, that wears", "m/s"),
            lines=(Line("sliding velocity", angle, sliding, Hue.VERMILLION, named=False),),
            levels=(Level(limit, f"lasting limit {number(limit, 'm/s')}", limit=True),),
            marks=(Mark(float(angle[top]), float(sliding[top]), number(float(sliding[top]), "m/s"), Hue.VERMILLION),),
            spans=TILTS,
        ),
        _motion(
            "hydrodynamic velocity, that builds the film", "m/s", angle, curves.hydrodynamic_velocity_m_per_s, Hue.BLUE
        ),
        _motion(
            "tangential displacement, that loads the tooth", "µm", angle, curves.tangential_displacement_um, Hue.GREEN
        ),
    )
    finding = f"sliding reaches {percent(share)} of its lasting limit; least film velocity near the tilt positions"
    return Figure(finding, panels)


def _motion(title: str, unit: str, angle: Values, items: list[float], hue: Hue) -> Panel:
    line = Line(title.split(",", maxsplit=1)[0], angle, values(items), hue, named=False)
    return Panel(x=TOOTH, y=Axis(title, unit), lines=(line,), spans=TILTS)


def contact_track(_: CouplingRequest, answer: CouplingResponse) -> Figure:
    """Where the contact is on the face, and how wide."""
    curves, lubrication = present(present(answer.kinematics).curves), present(answer.lubrication)
    angle, position = values(curves.angle_deg), values(curves.contact_position_mm)
    half, width = lubrication.hertz_half_width_mm, present(answer.derived).face_width_mm
    edge = width / 2.0
    reach = float(np.abs(position).max()) + half
    panel = Panel(
        x=TOOTH,
        y=Axis("position on the hub tooth from its middle", "mm", magnitude=False),
        lines=(Line("middle", angle, position, Hue.BLUE),),
        ribbons=(Ribbon("contact", angle, position - half, position + half),),
        levels=(Level(edge, "edge of the face", limit=True), Level(-edge, "edge of the face", limit=True)),
    )
    overlap = lubrication.contact_overlap
    supply = "without travel no oil comes in" if overlap is None else f"overlap Pu = {number(overlap)}"
    finding = f"contact reaches {number(reach, 'mm')} of {number(edge, 'mm')} to the edge; {supply}"
    return Figure(finding, (panel,))


def axial_thrust(request: CouplingRequest, answer: CouplingResponse) -> Figure:
    """Which teeth slide which way, and the thrust that is left of the coaxial one."""
    thrust, curves = present(answer.axial_thrust), present(present(answer.kinematics).curves)
    axial = request.operation.axial_velocity_mm_per_s / 1e3
    sliding = values(curves.sliding_velocity_m_per_s)
    opposed = float(np.mean(sliding[:-1] > abs(axial)))
    rows = [
        Row("thrust", thrust.force_n, Hue.BLUE, (thrust.lower_bound_n, thrust.upper_bound_n)),
        Row("if all teeth carried alike", thrust.uniform_load_force_n, Hue.GREY),
        Row("breakaway, coaxial at rest", thrust.breakaway_force_n, Hue.ORANGE),
    ]
    if thrust.self_induced is not None:
        rows += [
            Row("self-induced", thrust.self_induced.force_n, Hue.PURPLE),
            Row("self-induced, one-pair model", thrust.self_induced.simple_model_force_n, Hue.GREY),
        ]
    limit = Level(thrust.coaxial_limit_n, "coaxial limit", limit=True, vertical=True)
    motion = Panel(
        x=TOOTH,
        y=Axis("velocity along the tooth", "m/s"),
        lines=(Line("sliding by tilt", values(curves.angle_deg), sliding, Hue.VERMILLION),),
        levels=(Level(axial, f"axial velocity {number(axial * 1e3, 'mm/s')}"),) if axial else (),
    )
    share = (
        "no limit without load or friction"
        if thrust.fraction_of_limit is None
        else f"{percent(thrust.fraction_of_limit)} of the coaxial limit"
    )
    state = (
        "friction at rest is indeterminate"
        if thrust.indeterminate
        else f"{percent(opposed)} of the revolution slides against the axial motion"
    )
    finding = f"{share}; {state}" if axial or thrust.indeterminate else share
    return Figure(
        finding,
        (Panel(x=Axis("thrust", "N"), y=Axis("thrust"), rows=tuple(rows), levels=(limit,)), motion),
    )


def losses(_: CouplingRequest, answer: CouplingResponse) -> Figure:
    """Moments on shaft and bearings, and the power that becomes heat."""
    loss = present(answer.losses)
    moments = (
        Row("friction", loss.friction_moment_n_m, Hue.VERMILLION),
        Row("shift of the contacts", loss.contact_shift_moment_n_m, Hue.BLUE),
        Row("bending of the hub, resultant", loss.hub_bending_moment_n_m, Hue.GREY),
    )
    power = (Row("friction power of one mesh", loss.friction_power_w, Hue.VERMILLION),)
    bending = number(loss.hub_bending_moment_n_m, "N m")
    finding = f"{number(loss.friction_power_w, 'W')} of heat and {bending} of bending in one mesh"
    panels = (
        Panel(x=Axis("moment", "N m"), y=Axis("moment"), rows=moments),
        Panel(x=Axis("power", "W"), y=Axis("power"), rows=power),
    )
    return Figure(finding, panels)


FIGURES = (
    Declaration("friction-regime", "Friction regime of the coupling", "Pahl 1978, Fig. 9", friction_map),
    Declaration("tooth-loads", "Load on the coupling teeth", "Pahl 1978, Figs. 3, 4", tooth_loads),
    Declaration("tooth-motion", "Motion of one tooth over a revolution", "Pahl 1978, Figs. 6, 12", tooth_motion),
    Declaration("contact-track", "Track of the contact on the face", "Pahl 1978, Fig. 7", contact_track),
    Declaration("axial-thrust", "Axial thrust of the coupling", "Pahl 1978, Fig. 14", axial_thrust),
    Declaration("losses", "Moments and losses of one mesh", "Pahl 1978", losses, detail="summary"),
)
