"""Scuffing over the whole flank of a unit: bulk temperature along the face, flash temperature and safety factors."""

from dataclasses import dataclass, replace

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.gap.thermal_lead import ThermalLead
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.results import FlashPlaces, TrainSafety
from solvers.notices import Notice
from solvers.scuffing.contact_slices import Peak
from solvers.scuffing.inputs import ScuffingInputs, ScuffingTest
from solvers.scuffing.micropitting.check import CheckedFlank, check_micropitting
from solvers.scuffing.results import LoadDistribution, Place
from solvers.scuffing.safety import safety_factor
from solvers.scuffing.safety_results import ThermalPath
from solvers.scuffing.standard.check import check_by_standard, standard_notices
from solvers.scuffing.standard.results import ScuffingStandard
from solvers.scuffing.thermal.blok import blok_flash
from solvers.scuffing.thermal.flank import (
    SURVEY_POINTS,
    FaceFunction,
    FlashMap,
    contact_at_points,
    find_hottest,
    find_thinnest,
    formula_film,
)
from solvers.scuffing.thermal.places import Places, solve_places
from solvers.scuffing.thermal.thermal_path import solve_line, solver_notices
from solvers.scuffing.thermal.verdict import hotter_surface, unknown_points


@dataclass(frozen=True, slots=True)
class FlankHeat:
    """Blok's contact temperature over the flank [profile, face] [K], and the results at the hottest places.

    `unsolved_points` is the number of points without a solution of the thermal EHL.
    """

    temperature: FloatArray
    flash: FlashPlaces
    safety: TrainSafety | None
    micropitting: CheckedFlank
    unsolved_points: int
    warnings: tuple[Notice, ...]


def contact_of(inputs: DriveTrainInputs) -> ScuffingInputs:
    """Return the inputs of the mesh with a bulk temperature.

    If the inputs neither give a bulk temperature nor ask for its calculation, the mean of the tooth temperatures is
    used. Given tooth temperatures count as a given bulk temperature where no method is chosen.
    """
    temperatures, heat = inputs.mesh.temperatures, inputs.heat
    by_teeth = temperatures.bulk_method is None and temperatures.flanks is None and heat.states_teeth
    if temperatures.bulk is not None or not (by_teeth or temperatures.bulk_method == "given"):
        return inputs.mesh
    return replace(inputs.mesh, temperatures=replace(temperatures, bulk=sum(heat.teeth) / 2, bulk_method="given"))


@dataclass(frozen=True, slots=True)
class FaceBulk:
    """Bulk temperatures of the contact along the face; NaN if they are not known (Eq. D15).

    `deviations` (gears, stations) [K] are those of both surfaces from their means, by the warm face. If `local_bulk` is
    on, the temperature rise due to pumping is added, as the mean of pinion and wheel.
    """

    inputs: DriveTrainInputs
    thermal: ThermalLead
    deviations: FloatArray | None = None

    @property
    def varies(self) -> bool:
        """Whether the temperatures follow the face."""
        return self.inputs.local_bulk or self.deviations is not None

    def __call__(self, y: FloatArray) -> FloatArray:
        """Mean of both surfaces [K] at distances y [m] along the face."""
        temperature = self.inputs.mesh.temperatures.bulk
        mean = np.full(y.shape, np.nan if temperature is None else temperature)
        if self.inputs.local_bulk:
            mean += self._along(y, (self.thermal.pinion_rise + self.thermal.wheel_rise) / 2)
        if self.deviations is not None:
            mean += self._along(y, self.deviations.mean(axis=0))
        return mean

    def surfaces(self, y: FloatArray) -> FloatArray:
        """Bulk temperatures of pinion and wheel in two rows [K]."""
        surfaces, mean = self.inputs.mesh.temperatures.surfaces, self.inputs.mesh.temperatures.bulk
        assert surfaces is not None
        assert mean is not None
        own = np.add(self(y), (np.array(surfaces) - mean)[:, None])
        if self.deviations is not None:
            half = self._along(y, np.diff(self.deviations, axis=0)[0]) / 2
            own += np.array([-half, half])
        return own

    def _along(self, y: FloatArray, values: FloatArray) -> FloatArray:
        return np.interp(y, np.linspace(0.0, self.inputs.mesh.distribution.gears.face_width, values.size), values)


def flank_heat(
    inputs: DriveTrainInputs,
    mesh: LoadDistribution,
    flash: FlashMap,
    bulk: FaceBulk,
    test: ScuffingTest | None,
) -> FlankHeat:
    """Compute Blok's temperatures on the feature line and over the flank, and solve the thermal EHL (Eq. D15).

    Thermal EHL is solved on the feature line and at the places of the flank that decide. `test` is the scuffing test as
    asked, without the X_L of 90 C: the standard has its own.
    """
    given, plane = inputs.mesh.distribution, mesh.path_of_contact.plane
    psi = _feature_points(inputs, mesh, bulk)
    along, across = psi * plane.path_length, psi * plane.face_width
    feature = contact_at_points(given, mesh, along, across)
    on_feature = blok_flash(given, feature)
    hottest = strongest = _with_line(find_hottest(given, mesh, flash), along, across, on_feature)
    contacts = list[float | None]([None, None])
    has_bulk = inputs.mesh.temperatures.bulk is not None
    if has_bulk:
        warm_feature = on_feature + bulk(across)
        hottest = _with_line(find_hottest(given, mesh, flash, bulk), along, across, warm_feature)
        contacts = [None, None] if hottest is None else [float(warm_feature.max()), hottest.value]
    unsolved, warnings, thinnest = 0, tuple[Notice, ...](), None
    has_film = inputs.mesh.lubrication == "thermal_ehl" and inputs.mesh.lubricant is not None
    if has_film and has_bulk and hottest is not None:
        line = solve_line(inputs.mesh, feature)
        places = _places(inputs, mesh, flash, hottest, bulk)
        solved = [line] if places is None else [line, places.solved]
        warnings = solver_notices(solved)
        contacts.append(_hottest_surface(line.path, bulk.surfaces(across)))
        contacts.append(None if places is None else _hottest_surface(places.solved.path, places.surfaces))
        thinnest = None if places is None else _thinnest_film(places)
        unsolved = sum(each.path.status.count(status) for each in solved for status in ("no_solution", "refused"))
    micropitting = check_micropitting(inputs.mesh, mesh, flash, thinnest, bulk if bulk.varies else None)
    safety, place = None, None
    if strongest is not None and hottest is not None and strongest.value > 0.0:
        place = _place(mesh, hottest)
    if has_bulk and inputs.mesh.temperatures.scuffing is not None:
        safety = _safety(inputs, contacts, place, check_by_standard(inputs.mesh, mesh, test))
    return FlankHeat(
        temperature=(flash.flash + bulk(flash.y))[flash.mapped],
        flash=FlashPlaces(
            feature=None if strongest is None else float(on_feature.max()),
            flank=None if strongest is None else strongest.value,
            flank_at=place,
            contact_max=contacts[1],
            friction_coefficient=inputs.mesh.distribution.friction_coefficient,
        ),
        safety=safety,
        micropitting=micropitting,
        unsolved_points=unsolved,
        warnings=warnings
        + micropitting.warnings
        + tuple(standard_notices(given, None if safety is None else safety.standard)),
    )


def _feature_points(inputs: DriveTrainInputs, mesh: LoadDistribution, bulk: FaceFunction) -> FloatArray:
    """Return the positions psi of the points on the feature line.

    The points are equidistant, except for two points that are added: the place of the largest flash temperature and the
    place of the largest contact temperature, both by Blok. Without these two points the maxima would depend on the
    number of points.
    """
    given, plane, psi = inputs.mesh.distribution, mesh.path_of_contact.plane, np.linspace(0.0, 1.0, SURVEY_POINTS)
    across = psi * plane.face_width
    flash = blok_flash(given, contact_at_points(given, mesh, psi * plane.path_length, across))
    hottest = [int(np.argmax(flash)), int(np.argmax(flash + bulk(across)))]
    return np.unique([*np.linspace(0.0, 1.0, inputs.mesh.path_points), *psi[hottest]])


def _with_line(peak: Peak | None, along: FloatArray, across: FloatArray, on_line: FloatArray) -> Peak | None:
    """Return the higher of two peaks: the peak over the flank and the peak on the feature line.

    Return None if the peak over the flank or a value on the feature line is not known.
    """
    if peak is None or np.isnan(on_line).any():
        return None
    top = int(np.argmax(on_line))
    return max(peak, Peak(float(on_line[top]), float(along[top]), float(across[top])), key=lambda place: place.value)


def _place(mesh: LoadDistribution, peak: Peak) -> Place:
    plane = mesh.path_of_contact.plane
    return Place(
        gamma=mesh.path_of_contact.profile_parameter(peak.x),
        profile_fraction=peak.x / plane.path_length,
        face_fraction=peak.y / plane.face_width,
    )


def _places(
    inputs: DriveTrainInputs, mesh: LoadDistribution, flash: FlashMap, hottest: Peak, bulk: FaceBulk
) -> Places | None:
    """Solve thermal EHL at the places of the flank that decide; None without a loaded contact."""
    film_at = formula_film(inputs.mesh)
    thinnest = find_thinnest(inputs.mesh.distribution, mesh, flash, film_at)
    if thinnest is None:
        return None
    mean = inputs.mesh.temperatures.bulk
    assert mean is not None
    return solve_places(
        inputs.mesh,
        mesh,
        flash,
        film_at,
        (hottest, thinnest),
        bulk.surfaces,
        lambda y: np.subtract(bulk(y), mean),
    )


def _hottest_surface(path: ThermalPath, bulk: FloatArray) -> float | None:
    """Return the temperature of the hottest flank surface at points of the flank [K], computed by thermal EHL.

    Return None if no point is loaded. Also return None if an unsolved point may be hotter, or may have a
    thinner film, than every solved point.
    """
    if set(path.status) == {"unloaded"} or unknown_points(path, bulk):
        return None
    return float(np.nanmax(hotter_surface(path, bulk)))


def _thinnest_film(places: Places) -> float | None:
    """Return the thinnest film of the flank [m], computed by thermal EHL.

    Return None if no place has a film. Also return None if an unsolved place may have a thinner film, or may be hotter,
    than every solved place.
    """
    films = places.solved.path.minimum_film
    unknown = np.isnan(films).all() or unknown_points(places.solved.path, places.surfaces)
    return None if unknown else float(np.nanmin(films))


def _safety(
    inputs: DriveTrainInputs, hottest: list[float | None], worst: Place | None, standard: ScuffingStandard | None
) -> TrainSafety:
    limit, oil = inputs.mesh.temperatures.scuffing, inputs.mesh.temperatures.oil
    assert limit is not None
    factors = [None if contact is None else safety_factor(limit, oil, contact) for contact in hottest]
    finite = [factor for factor in factors if factor is not None]
    feature, places = factors[2:] if len(factors) > 2 else (None, None)
    # A known contact without a factor is as cool as the oil: its safety has no bound and is not the least.
    least = min(finite, default=None) if None not in hottest else None
    return TrainSafety(factors[0], factors[1], worst, feature, places, least, standard)
