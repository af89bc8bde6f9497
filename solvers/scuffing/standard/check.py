"""The check by the standard that stands beside the local one."""

from collections.abc import Iterator

from solvers.notices import Notice
from solvers.scuffing.inputs import LoadDistributionInputs, ScuffingInputs, ScuffingTest
from solvers.scuffing.load_factors.method_b import factors_of
from solvers.scuffing.micropitting.standard import has_relief
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.standard.flash import solve_flash
from solvers.scuffing.standard.integral import solve_integral
from solvers.scuffing.standard.mesh import StandardMesh, standard_oil
from solvers.scuffing.standard.results import ScuffingStandard


def standard_notices(given: LoadDistributionInputs, standard: ScuffingStandard | None) -> Iterator[Notice]:
    """Say why the flash temperature method has no numbers although the pair is checked by the standard."""
    if standard is not None and standard.flash is None and has_relief(given):
        message = (
            "the flash temperature method of the standard cannot be computed: its load sharing factors of gears with "
            "tip or root relief are not known; the integral temperature method can"
        )
        yield Notice("no_standard_flash", message, "modifications", rank="note")


def check_by_standard(
    inputs: ScuffingInputs, distribution: LoadDistribution, test: ScuffingTest | None
) -> ScuffingStandard | None:
    """Check the pair by both methods; `test` is the scuffing test as asked, without the X_L of 90 C.

    None without oil, load or motion, and if the oil has no viscosity at the oil temperature.
    """
    given, oil = inputs.distribution, inputs.known_oil
    if oil is None or distribution.balance.force == 0.0 or given.load.pinion_speed == 0.0:
        return None
    known = standard_oil(oil, inputs.temperatures.oil)
    if known is None:
        return None
    factors = factors_of(inputs, distribution)
    mesh = StandardMesh(given, distribution.path_of_contact, factors, inputs.standard, inputs.temperatures, known)
    edition = inputs.standard_edition
    return ScuffingStandard(edition, factors, solve_flash(mesh, edition, test), solve_integral(mesh, test))
