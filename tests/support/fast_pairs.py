"""Draw random requests for gear pairs in oil, up to very high speeds, as users may send them."""

from typing import Any

import numpy as np

GRADES = (22, 32, 46, 68, 100, 150, 220, 320)
KINDS = ("mineral", "pao", "ester", "polyglycol")


def random_request(random: np.random.Generator) -> dict[str, Any]:
    """Draw the request for a gear pair with its oil and some fields of its cooling."""
    # The pitch-line velocity is 2 to 180 m/s.
    module, teeth = random.uniform(1, 8), (int(random.integers(18, 50)), int(random.integers(20, 140)))
    helix = float(random.choice([0.0, random.uniform(5, 30)]))
    diameter = module * teeth[0] / np.cos(np.radians(helix))
    width = diameter * random.uniform(0.2, 1.2)
    velocity = float(np.exp(random.uniform(np.log(2), np.log(180))))
    speed = velocity / (diameter / 2e3) * 30 / np.pi
    power = random.uniform(0.3, 4) * diameter * width * 1e-6 * velocity * 1e3  # N/mm2 on the projected pinion
    request: dict[str, Any] = {
        "gears": {
            "pinion": {"teeth": teeth[0], "profile_shift": round(random.uniform(0, 0.3), 2)},
            "wheel": {"teeth": teeth[1]},
            "module_mm": module,
            "helix_angle_deg": helix,
            "face_width_mm": width,
        },
        "load": {"power_kw": power, "pinion_speed_rpm": speed},
        "modifications": {"helix_slope_um": random.uniform(-15, 15), "lead_crowning_um": random.uniform(0, 10)},
        "lubricant": {"iso_vg": int(random.choice(GRADES)), "kind": str(random.choice(KINDS))},
        "temperatures": {
            "oil_c": random.uniform(20, 90),
            "bulk_method": "heat_balance",
            "scuffing_c": random.uniform(250, 500),
        },
        "model": {"lubrication": "closed_form"},
        "detail": "summary",
    }
    if random.random() < 0.3:
        request["friction_coefficient"] = random.uniform(0.02, 0.1)
    return request | {"cooling": random_cooling(random, power)}


def random_cooling(random: np.random.Generator, power: float) -> dict[str, Any]:
    """Draw values for the fields of a cooling, and keep each of the fields with a probability of 0.3."""
    # The oil flow scatters widely about 0.012 l/min per kW of `power` [kW].
    choices: dict[str, Any] = {
        "gear_flow_l_per_min": float(np.clip(power * 0.012 * np.exp(random.normal(0, 1.5)), 0.1, 5000)),
        "flow_rise_k": random.uniform(3, 50),
        "flow_to_pinion": random.uniform(0.05, 0.95),
        "jets": str(random.choice(["into_mesh", "out_of_mesh"])),
        "jet_speed_m_per_s": random.uniform(5, 60),
        "wetting_share": random.uniform(0.02, 1),
        "rewetting_share": random.uniform(0, 1),
        "fling_off_factor": random.uniform(0.2, 5),
        "mist_convection_factor": random.uniform(0.5, 20),
        "pumping_to_teeth": random.uniform(0.02, 1),
        "pumping_w": random.uniform(0, 2) * power,
        "other_w": random.uniform(0, 2) * power,
        "casing": {"area_m2": random.uniform(0.1, 20), "ambient_c": random.uniform(-20, 50)},
    }
    return {name: value for name, value in choices.items() if random.random() < 0.3}
