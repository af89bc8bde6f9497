"""Friction loss of the mesh at a constant coefficient of friction."""

from solvers.gears.path_of_contact import PathOfContact
from solvers.scuffing.inputs import Load
from solvers.scuffing.load_balance import LoadBalance
from solvers.scuffing.results import FrictionLoss
from solvers.scuffing.transmission_error import period_mean


def friction_loss(path: PathOfContact, balance: LoadBalance, load: Load, friction_coefficient: float) -> FrictionLoss:
    """P_V = f/p_bt int sum_j int w |u1 - u2| dl dphase, u1 - u2 = (omega_1 + omega_2)(s - s_C); H_V = P_V / (f P)."""
    if balance.force == 0.0:
        return FrictionLoss(loss_factor=None, power=0.0)
    speed_ratio = path.pair.pinion.teeth / path.pair.wheel.teeth
    moment = period_mean(balance.survey.friction_moment, balance.rolls.phase)
    return FrictionLoss(
        loss_factor=moment * (1 + speed_ratio) / load.pinion_torque,
        power=friction_coefficient * moment * load.pinion_speed * (1 + speed_ratio),
    )
