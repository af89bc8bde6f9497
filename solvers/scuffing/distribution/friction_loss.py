"""Friction loss of the mesh at a constant coefficient of friction."""

from solvers.gears.path_of_contact import PathOfContact
from solvers.scuffing.balance.load_balance import LoadBalance
from solvers.scuffing.distribution.transmission_error import period_mean
from solvers.scuffing.inputs import Load
from solvers.scuffing.results import FrictionLoss


def friction_loss(
    path: PathOfContact, balance: LoadBalance, load: Load, friction_coefficient: float | None
) -> FrictionLoss:
    """P_V = f/p_bt int sum_j int w |u1 - u2| dl dphase, u1 - u2 = (omega_1 + omega_2)(s - s_C); H_V = P_V / (f P).

    Power and efficiency are those of the transmitted power; load factors raise the load of the contacts only.
    """
    if balance.force == 0.0:
        return FrictionLoss(friction_coefficient, loss_factor=None, power=0.0, efficiency=None)
    speed_ratio = path.pair.pinion.teeth / path.pair.wheel.teeth
    moment = period_mean(balance.survey.friction_moment, balance.rolls.phase) / load.contact_factor
    loss_factor = moment * (1 + speed_ratio) / load.pinion_torque
    if friction_coefficient is None:
        return FrictionLoss(None, loss_factor=loss_factor, power=None, efficiency=None)
    return FrictionLoss(
        friction_coefficient,
        loss_factor=loss_factor,
        power=friction_coefficient * moment * load.pinion_speed * (1 + speed_ratio),
        efficiency=1.0 - friction_coefficient * loss_factor,
    )
