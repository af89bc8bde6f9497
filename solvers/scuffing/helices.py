"""Double-helical pairs: the more loaded helix is checked, and the losses are those of both helices."""

from dataclasses import replace

from solvers.errors import NoSolution
from solvers.gears.pair import meshing_path
from solvers.notices import Notice
from solvers.scuffing import model, safety
from solvers.scuffing.inputs import LoadDistributionInputs, ScuffingInputs
from solvers.scuffing.results import FrictionLoss, HelixShare, LoadDistribution
from solvers.scuffing.safety_results import Scuffing
from solvers.scuffing.thermal import temperatures

UNEQUAL = 1.1  # chosen: larger share over half the load above which unequal helices are worth a warning


def helix_share(inputs: LoadDistributionInputs) -> HelixShare | None:
    """Return the share of the more loaded helix, (1 + |F_ext|/(F_bt tan beta_b))/2 (Eq. D17); None for one helix.

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
        raise NoSolution("helix_unloaded", message, {"axial_force_n": force, "unloading_force_n": limit})
    share = (1.0 + force / limit) / 2 if force else 0.5
    return HelixShare(share=share, share_factor=2 * share, unloading_force=limit)


def solve_load_distribution(inputs: LoadDistributionInputs) -> LoadDistribution:
    """Compute load, pressure, transmission error and friction loss of a pair, of its more loaded helix of two.

    Raises the errors of `model.solve` and of `helix_share`.
    """
    helix = helix_share(inputs)
    if helix is None:
        return model.solve(inputs)
    loaded = model.solve(_carrying(inputs, helix.share))
    other = loaded if helix.share == 0.5 else model.solve(_carrying(inputs, 1.0 - helix.share))
    return replace(loaded, helix=helix, friction_loss=_of_both(loaded.friction_loss, other.friction_loss, helix.share))


def solve_scuffing(inputs: ScuffingInputs) -> Scuffing:
    """Check a pair against scuffing, of two helices the more loaded one.

    Raises the errors of `safety.solve_scuffing` and of `helix_share`.
    """
    helix = helix_share(inputs.distribution)
    if helix is None:
        return safety.solve_scuffing(inputs)
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
        warnings=(*checked.warnings, *_notices(helix, checked)),
    )


def sized_flow(inputs: ScuffingInputs) -> float | None:
    """Compute the oil flow to the gears that is sized where none is given [m^3/s]; None if none is sized."""
    helix = helix_share(inputs.distribution)
    return temperatures.sized_flow(inputs if helix is None else _of_helix(inputs, helix.share))


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


def _notices(helix: HelixShare, checked: Scuffing) -> tuple[Notice, ...]:
    """Warn of unequal helices that share one temperature."""
    if helix.share_factor <= UNEQUAL:
        return ()
    if checked.heat is None:
        message = (
            "the helices carry unequal loads and do not have the one bulk temperature that is used: the hotter one is "
            "less safe than computed"
        )
        return (Notice("helices_warm_unequally", message, "temperatures.bulk"),)
    message = (
        "the heat balance is that of two helices which both carry the larger load; heat that flows through the gap "
        "makes the hotter one somewhat cooler"
    )
    return (Notice("helices_warm_apart", message, "cooling", rank="note"),)
