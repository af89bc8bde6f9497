"""Double-helical pairs: the more loaded helix is checked, and the losses are those of both helices."""

from collections.abc import Iterator
from dataclasses import replace

from solvers.errors import NoSolution
from solvers.gears.pair import meshing_path
from solvers.notices import Notice
from solvers.scuffing import model, safety
from solvers.scuffing.inputs import Load, LoadDistributionInputs, ScuffingInputs
from solvers.scuffing.results import FrictionLoss, HelixShare, LoadDistribution
from solvers.scuffing.safety_results import Scuffing
from solvers.scuffing.thermal import temperatures

UNEQUAL = 1.1  # chosen: larger share over half the load above which unequal helices are worth a warning


def helix_share(inputs: LoadDistributionInputs) -> HelixShare | None:
    """Return the share of the more loaded helix, (1 + |F_ext|/(F_bt tan beta_b))/2 (Eq. D20); None for one helix.

    Raises NoSolution `helix_unloaded` if the axial force lifts the other helix off.
    """
    if inputs.gears.helices == 1:
        return None
    path, force = meshing_path(inputs.gears), abs(inputs.load.axial_force)
    limit = inputs.load.torque / path.pair.pinion.base_radius * path.plane.tan_base_helix
    if force and force >= limit:
        message = (
            f"axial force of {force / 1e3:.4g} kN on the floating shaft; one helix lifts off at {limit / 1e3:.4g} kN: "
            "lower the axial force, or raise the torque or the helix angle"
        )
        residuals = {"axial_force_n": force, "unloading_force_n": limit}
        raise NoSolution("helix_unloaded", message, residuals, "axial_force")
    share = (1.0 + force / limit) / 2 if force else 0.5
    return HelixShare(share=share, share_factor=2 * share, unloading_force=limit)


def solve_load_distribution(inputs: LoadDistributionInputs) -> LoadDistribution:
    """Compute load, pressure, transmission error and friction loss of a pair, of two helices the more loaded one.

    Parameters
    ----------
    inputs : LoadDistributionInputs
        The pair, its load and its modifications.

    Returns
    -------
    LoadDistribution
        Results over the plane of action; the friction loss is that of both helices.

    Raises
    ------
    InvalidInput
        The errors of `mesh_of`.
    NoSolution
        `load_balance` if the load balance does not converge; the error of `helix_share`.

    Examples
    --------
    >>> from solvers import scuffing
    >>> teeth = scuffing.GearTeeth(25), scuffing.GearTeeth(76)
    >>> gears = scuffing.GearPairInputs(*teeth, 4e-3, 60e-3, rack_tip_radius=0.38)
    >>> inputs = scuffing.LoadDistributionInputs(gears, scuffing.Load(900.0, 157.0))
    >>> result = scuffing.solve_load_distribution(inputs)
    >>> round(result.load.face_load_factor, 2)
    1.0
    """
    helix = helix_share(inputs)
    if helix is None:
        return model.solve(inputs)
    loaded = model.solve(_carrying(inputs, helix.share))
    other = loaded if helix.share == 0.5 else model.solve(_carrying(inputs, 1.0 - helix.share))
    return replace(loaded, helix=helix, friction_loss=_of_both(loaded.friction_loss, other.friction_loss, helix.share))


def solve_scuffing(inputs: ScuffingInputs) -> Scuffing:
    """Check a pair against scuffing, of two helices the more loaded one.

    Parameters
    ----------
    inputs : ScuffingInputs
        The pair, its load, its oil and its temperatures.

    Returns
    -------
    Scuffing
        Load distribution, flash temperature, and curves along the checked lines. Film, contact temperature and safety
        are None if the bulk temperature is unknown, the film also without an oil, safety also without a limit.

    Raises
    ------
    InvalidInput
        The errors of `safety.solve_scuffing`.
    NoSolution
        The errors of `safety.solve_scuffing` and of `helix_share`.

    Examples
    --------
    >>> from solvers import scuffing
    >>> teeth = scuffing.GearTeeth(25), scuffing.GearTeeth(76)
    >>> gears = scuffing.GearPairInputs(*teeth, 4e-3, 60e-3, rack_tip_radius=0.38)
    >>> load = scuffing.LoadDistributionInputs(gears, scuffing.Load(900.0, 157.0))
    >>> warm = scuffing.Temperatures(oil=343.15, scuffing=573.15)
    >>> oil = scuffing.iso_vg(220)
    >>> inputs = scuffing.ScuffingInputs(load, oil=oil, temperatures=warm, lubrication="closed_form")
    >>> scuffing.solve_scuffing(inputs).safety.verdict
    'low'
    """
    helix = helix_share(inputs.distribution)
    if helix is None:
        return safety.solve_scuffing(inputs)
    inputs = _with_flow(inputs)
    checked = safety.solve_scuffing(_of_helix(inputs, helix.share))
    loaded = checked.distribution
    loss = loaded.friction_loss
    if helix.share != 0.5:
        lighter = _of_helix(inputs, 1.0 - helix.share)
        _, other = temperatures.with_friction(lighter, model.solve(lighter.distribution))
        loss = _of_both(loss, other.friction_loss, helix.share)
    else:
        loss = _of_both(loss, loss, helix.share)
    return replace(
        checked,
        distribution=replace(loaded, helix=helix, friction_loss=loss),
        warnings=(*checked.warnings, *_notices(inputs, helix, checked)),
    )


def sized_flow(inputs: ScuffingInputs) -> float | None:
    """Compute the oil flow to the gears that is sized where none is given.

    Parameters
    ----------
    inputs : ScuffingInputs
        The pair, single or double helical.

    Returns
    -------
    float or None
        Oil flow [m^3/s]; None if a flow is given or no heat balance runs.

    Examples
    --------
    >>> from solvers import scuffing
    >>> teeth = scuffing.GearTeeth(25), scuffing.GearTeeth(76)
    >>> gears = scuffing.GearPairInputs(*teeth, 4e-3, 60e-3, rack_tip_radius=0.38)
    >>> load = scuffing.LoadDistributionInputs(gears, scuffing.Load(900.0, 157.0))
    >>> scuffing.sized_flow(scuffing.ScuffingInputs(load)) is None
    True
    """
    return temperatures.sized_flow(_of_helix(inputs, 1.0 / inputs.distribution.gears.helices))


def _with_flow(inputs: ScuffingInputs) -> ScuffingInputs:
    """Return the inputs with the flow that both helices get, which does not grow with the load of one of them."""
    flow = sized_flow(inputs)
    return inputs if flow is None else replace(inputs, cooling=replace(inputs.cooling, gear_flow=flow))


def _carrying(inputs: LoadDistributionInputs, share: float) -> LoadDistributionInputs:
    return replace(inputs, load=replace(inputs.load, helix_share=share))


def _of_helix(inputs: ScuffingInputs, share: float) -> ScuffingInputs:
    return replace(inputs, distribution=_carrying(inputs.distribution, share))


def _of_both(loaded: FrictionLoss, other: FrictionLoss, share: float) -> FrictionLoss:
    """Return the loss of both helices; the coefficient of friction is that of the more loaded one."""
    if loaded.loss_factor is None or other.loss_factor is None:
        return loaded
    factor = share * loaded.loss_factor + (1.0 - share) * other.loss_factor
    if loaded.power is None or other.power is None or loaded.coefficient is None or other.coefficient is None:
        return replace(loaded, loss_factor=factor)
    lost = share * (loaded.coefficient * loaded.loss_factor)
    lost += (1.0 - share) * (other.coefficient * other.loss_factor)
    return replace(loaded, loss_factor=factor, power=loaded.power + other.power, efficiency=1.0 - lost)


def _notices(inputs: ScuffingInputs, helix: HelixShare, checked: Scuffing) -> Iterator[Notice]:
    """Warn of unequal helices that share one temperature, and of a load factor that counts them twice."""
    load = inputs.distribution.load
    yield from counted_twice(load, helix.share_factor)
    if helix.share_factor <= UNEQUAL:
        return
    if checked.derived.bulk.bulk_method == "given" and checked.contact_temperature is not None:
        message = (
            "the helices carry unequal loads and do not have the one bulk temperature that is used: the hotter one is "
            "less safe than computed"
        )
        yield Notice("helices_warm_unequally", message, "temperatures.bulk")
    if checked.heat is not None:
        message = (
            "the heat balance and its losses are those of two helices which both carry the larger load; heat that "
            "flows through the gap makes the hotter one somewhat cooler"
        )
        yield Notice("helices_warm_apart", message, "cooling", rank="note")


def counted_twice(load: Load, share_factor: float) -> Iterator[Notice]:
    """Warn if a mesh load factor is given although unequal shares are computed."""
    if load.mesh_load_factor > 1.0 and share_factor > 1.0:
        message = (
            f"K_γ {load.mesh_load_factor:.3g} is given, and the shares of the helices are computed as well (K_γ "
            f"{share_factor:.3g}): give 1 unless yours stands for something else"
        )
        yield Notice("counted_twice", message, "mesh_load_factor")
