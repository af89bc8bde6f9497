"""Bodies to start from, for the docs page of the studies."""

from typing import Any

from app.examples import examples

_COUPLING = examples()["pahl-axial-displacement"]
_LOADS = examples()["xue-pair-1-modified"]
_UNIT = examples()["starter-turbo-gear-drive-train"]
_STAGE = examples()["starter-high-speed-scuffing"]
SWEEP_EXAMPLES: dict[str, dict[str, Any]] = {
    "map": {
        "summary": "Which crowning forgives misalignment: a map of pressure, and its best point",
        "value": {
            "endpoint": _LOADS.endpoint,
            "request": _LOADS.request,
            "vary": [
                {"path": "modifications.helix_slope_um", "start": -20, "stop": 20, "count": 9},
                {"path": "modifications.lead_crowning_um", "values": [0, 5, 10, 20]},
            ],
            "outputs": ["pressure.max_mpa", "load.face_load_factor"],
            "best": {
                "minimise": "pressure.max_mpa",
                "where": [{"output": "load.face_load_factor", "max": 1.5}],
            },
        },
    },
    "cases": {
        "summary": "A load spectrum",
        "value": {
            "endpoint": _COUPLING.endpoint,
            "request": _COUPLING.request,
            "cases": [
                {"operation.torque_n_m": 3000, "operation.speed_rpm": 1910},
                {"operation.torque_n_m": 4500, "operation.speed_rpm": 1500},
            ],
        },
    },
    "sample": {
        "summary": "Tolerances at random",
        "value": {
            "endpoint": _COUPLING.endpoint,
            "request": _COUPLING.request,
            "sample": {
                "count": 64,
                "ranges": [
                    {"path": "operation.misalignment_deg", "min": 0.03, "max": 0.08},
                    {"path": "lubricant.viscosity_pa_s", "min": 0.02, "max": 0.03},
                ],
            },
        },
    },
}
SENSITIVITY_EXAMPLES: dict[str, dict[str, Any]] = {
    "coupling": {
        "summary": "What moves the axial thrust most",
        "value": {
            "endpoint": _COUPLING.endpoint,
            "request": _COUPLING.request,
            "outputs": ["axial_thrust.force_n"],
        },
    }
}


_SHAPE = "modifications"
_OFFSETS = [f"couplings.0.offset_um.{axis}" for axis in range(2)]
CORNERS_EXAMPLES: dict[str, dict[str, Any]] = {
    "usual": {
        "summary": "The usual corners of a turbo gear: wall response, clearances, friction, offset, thrust",
        "value": {"request": _UNIT.request, "outputs": ["load.face_load_factor", "safety.blok_flank"]},
    },
    "own": {
        "summary": "Corners of one's own: how well the machine is aligned, how much heat the teeth take",
        "value": {
            "request": _UNIT.request,
            "ranges": [
                {"path": _OFFSETS, "values": [[0, 400], [0, -400], [400, 0], [-400, 0]]},
                {"path": "thermal.wall_response", "values": [0.3, 0.6, 1.0]},
            ],
            "outputs": ["load.face_load_factor", "safety.blok_flank", "misalignment.total_slope_um"],
        },
    },
}
DESIGN_EXAMPLES: dict[str, dict[str, Any]] = {
    "robust": {
        "summary": "The correction whose safety is largest at its worst corner, at full and at half power",
        "value": {
            "request": _UNIT.request,
            "variables": [
                {"path": f"{_SHAPE}.helix_slope_um", "min": 0, "max": 100},
                {"path": f"{_SHAPE}.lead_crowning_um", "min": 0, "max": 20},
                {"path": [f"{_SHAPE}.tip_relief_um", f"{_SHAPE}.root_relief_um"], "min": 0, "max": 30},
            ],
            "corners": [
                {
                    "path": ["couplings.0.friction.coefficient", _OFFSETS[1]],
                    "values": [[0.05, 400], [0.25, 400], [0.25, -400]],
                },
                {"path": "thermal.wall_response", "values": [0.3, 0.9]},
            ],
            "collective": [{"operation.power_kw": 12000}, {"operation.power_kw": 6000}],
            "objective": "safety.blok_flank",
        },
    }
}
SPECTRUM_EXAMPLES: dict[str, dict[str, Any]] = {
    "scuffing": {
        "summary": "The probability of scuffing of a high-speed stage over its load spectrum with six tolerances",
        "value": {
            "endpoint": _STAGE.endpoint,
            "request": _STAGE.request,
            "cases": [
                {
                    "name": "start",
                    "share": 0.02,
                    "set": {"load.power_kw": 2000, "load.pinion_speed_rpm": 3000, "temperatures.oil_c": 40},
                },
                {"name": "part load", "share": 0.3, "set": {"load.power_kw": 7000}},
                {"name": "full load", "share": 0.66, "set": {}},
                {"name": "overload", "share": 0.02, "set": {"load.power_kw": 14000, "temperatures.oil_c": 60}},
            ],
            "tolerances": {
                "count": 32,
                "replicates": 4,
                "inputs": [
                    {"path": "modifications.helix_slope_um", "distribution": "normal", "mean": 0, "deviation": 8},
                    {"path": "modifications.lead_crowning_um", "distribution": "uniform", "min": 4, "max": 8},
                    {
                        "path": "modifications.tip_relief_um",
                        "distribution": "triangular",
                        "min": 10,
                        "mode": 15,
                        "max": 20,
                    },
                    {
                        "path": "modifications.root_relief_um",
                        "distribution": "triangular",
                        "min": 10,
                        "mode": 15,
                        "max": 20,
                    },
                    {"path": "load.application_factor", "distribution": "lognormal", "median": 1.1, "factor": 1.05},
                    {"path": "materials.pinion.roughness_um", "distribution": "normal", "mean": 0.4, "deviation": 0.05},
                ],
            },
            "outputs": ["safety.blok_factor", "friction_loss.power_w"],
            "hours_per_year": 8000,
        },
    },
    "coupling": {
        "summary": "How often the thrust of a coupling exceeds what its bearing holds, at two loads",
        "value": {
            "endpoint": _COUPLING.endpoint,
            "request": _COUPLING.request,
            "cases": [{"set": {}}, {"set": {"operation.torque_n_m": 4500, "operation.speed_rpm": 1500}}],
            "tolerances": {
                "inputs": [
                    {"path": "friction.coefficient", "distribution": "normal", "mean": 0.2, "deviation": 0.02},
                ]
            },
            "outputs": ["axial_thrust.force_n"],
            "limits": [{"output": "axial_thrust.force_n", "above": {"value": 4000}}],
        },
    },
    "drive_train": {
        "summary": "A gear unit with oil and tooth temperatures of its own at every load",
        "value": {
            "endpoint": _UNIT.endpoint,
            "request": _UNIT.request,
            "cases": [
                {"name": "full load", "share": 0.7, "set": {}},
                {
                    "name": "half load",
                    "share": 0.3,
                    "set": {
                        "operation.power_kw": 6000,
                        "temperatures.oil_c": 45,
                        "thermal.pinion_bulk_c": 80,
                        "thermal.wheel_bulk_c": 70,
                    },
                },
            ],
            "tolerances": {
                "count": 8,
                "replicates": 2,
                "inputs": [
                    {"path": "modifications.helix_slope_um", "distribution": "normal", "mean": 50, "deviation": 6},
                    {"path": "couplings.0.offset_um.1", "distribution": "uniform", "min": 0, "max": 400},
                ],
            },
            "outputs": ["losses.total_w", "load.face_load_factor"],
        },
    },
}
