"""The oil, the oil supply, the temperatures of oil and teeth, and the friction of a mesh, taken from the file."""

from app.rexs import table
from app.rexs.model import Component
from app.rexs.stages import SAME, StageDraft


def add_lubrication(stage: StageDraft) -> None:
    """Fill in the oil, the temperatures and the coefficient of friction in the draft of a stage."""
    _oil(stage)
    _temperatures(stage)
    _friction(stage)


def _oil(stage: StageDraft) -> None:
    oil, reading = stage.lubricant, stage.reading
    missing = "without an oil there is no film and no scuffing safety"
    if oil is None:
        stage.lacks("lubricant", stage.stage, None, missing)
        return
    if reading.text(oil, "kind") == "grease":
        reading.find("grease", oil, "kind", "greases are not modelled; the lubricant in the file is not used")
        stage.lacks("lubricant", oil, "kind", missing)
        return
    thick = table.OIL[0]
    if reading.number(oil, thick) is None:
        why = "; the oil is in another file, which is not read" if reading.is_elsewhere(oil) else ""
        stage.lacks("lubricant", oil, thick.name, f"the viscosity of the oil at 40 °C is needed{why}")
        return
    for row in table.OIL:
        stage.take(row, oil, "lubricant.")
    at_bulk = "lubricant.pressure_viscosity_per_gpa" in stage.fields
    if not at_bulk and (alpha := stage.take(table.PRESSURE_VISCOSITY_38, oil)) is not None:
        reason = "holds at 38 °C; it is converted to the temperature of the contact by ISO/TR 15144-1, Eq. 8"
        stage.note(table.PRESSURE_VISCOSITY_38.field, alpha, reason)
    _base_oil(stage, oil)


def _base_oil(stage: StageDraft, oil: Component) -> None:
    """Fill in the kind of base oil."""
    path, vague = "lubricant.kind", ""
    texts = {name: stage.reading.text(oil, name) for name in (*table.OIL_TYPES, *table.OIL_WORDS)}
    texts["component"] = oil.name.lower()
    for name, stated in texts.items():
        text = stated.replace("-", "_").replace(" ", "_")
        if not any(part in text for part in table.NOT_SOLUBLE) and any(part in text for part in table.OTHER_OILS):
            vague = stated
            break
        word = next((part for part in table.BASE_OILS if part in text), None)
        if word is None:
            continue
        kind = table.BASE_OILS[word]
        if kind is not None:
            stage.put(path, kind, oil, name)
            return
        vague = vague or stated
        if name in table.OIL_TYPES:
            break
    if not vague:
        stage.assume(path, "mineral", "the file does not give the base oil")
        return
    message = f"there is no model for an oil of the kind {vague[:40]}; choose the nearest kind"
    stage.reading.find("oil_kind", oil, None, message)
    message = f"choose the kind of oil that is nearest to {vague[:40]}; otherwise a mineral oil is used"
    stage.lacks(path, oil, None, message)


def _temperatures(stage: StageDraft) -> None:
    """Fill in the oil temperature, the oil supply and the bulk temperature."""
    for origin in stage.oil_origins:
        if stage.take(table.OIL_TEMPERATURE, origin) is not None:
            break
    row, bulks = table.BULK_TEMPERATURE, stage.values_of(stage.gears, table.BULK_TEMPERATURE)
    if bulks:
        stage.put(row.field, sum(value for value, _ in bulks) / len(bulks), bulks[0][1], row.name)
        if abs(bulks[0][0] - bulks[-1][0]) > SAME * 100.0:
            stage.note(row.field, stage.fields[row.field], "the mean of both gears is used")
    else:
        stage.take(row, stage.stage)
    for name in table.OIL_SUPPLY:
        text = stage.reading.text(stage.stage, name)
        supply = next((ours for word, ours in table.SUPPLIES.items() if word in text), None)
        if supply is not None:
            stage.put("temperatures.oil_supply", supply, stage.stage, name)
            return
        if text:
            message = f"the lubrication method {text[:40]} is not modelled; the value is not used"
            stage.reading.find("oil_supply", stage.stage, name, message)
    _supply_by_factor(stage)


def _supply_by_factor(stage: StageDraft) -> None:
    """Set the oil supply from the lubrication factor in the file."""
    factor = stage.reading.number(stage.stage, table.SUPPLY_FACTOR)
    if factor is None:
        return
    if (supply := table.SUPPLY_FACTORS.get(factor)) is not None:
        stage.put("temperatures.oil_supply", supply, stage.stage, table.SUPPLY_FACTOR)
    else:
        message = (
            f"the lubrication factor {factor:.4g} does not belong to any oil supply of the model; the factor is not "
            "used"
        )
        stage.reading.find("oil_supply", stage.stage, table.SUPPLY_FACTOR, message)


def _friction(stage: StageDraft) -> None:
    """Fill in the coefficient of friction, unless the file says that this coefficient was calculated."""
    methods = {stage.reading.text(stage.stage, name) for name in table.FRICTION_METHODS}
    if methods <= {"", "is_given"}:
        stage.take(table.FRICTION, stage.stage)
