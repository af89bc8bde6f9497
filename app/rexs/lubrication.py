"""The oil, the oil supply, the temperatures of oil and teeth, and the friction of a mesh, taken from the file."""

from app.rexs import table
from app.rexs.model import Component
from app.rexs.stages import SAME, StageDraft


class Lubrication:
    """Builder that fills in the oil, the temperatures and the coefficient of friction in the draft of a stage."""

    def __init__(self, stage: StageDraft) -> None:
        self._stage, self._reading = stage, stage.reading

    def fill(self) -> None:
        self._oil()
        self._temperatures()
        self._friction()

    def _oil(self) -> None:
        oil = self._stage.lubricant
        if oil is None:
            self._stage.lacks(
                "lubricant", self._stage.stage, None, "without an oil there is no film and no scuffing safety"
            )
            return
        if self._reading.text(oil, "kind") == "grease":
            self._reading.find("grease", oil, "kind", "greases are not modelled; the lubricant in the file is not used")
            self._stage.lacks("lubricant", oil, "kind", "without an oil there is no film and no scuffing safety")
            return
        thick = table.OIL[0]
        if self._reading.number(oil, thick) is None:
            elsewhere = self._reading.is_elsewhere(oil)
            why = "; the oil is in another file, which is not read" if elsewhere else ""
            self._stage.lacks("lubricant", oil, thick.name, f"the viscosity of the oil at 40 °C is needed{why}")
            return
        for row in table.OIL:
            self._stage.take(row, oil, "lubricant.")
        at_bulk = "lubricant.pressure_viscosity_per_gpa" in self._stage.fields
        if not at_bulk and (alpha := self._stage.take(table.PRESSURE_VISCOSITY_38, oil)) is not None:
            reason = "holds at 38 °C; it is converted to the temperature of the contact by ISO/TR 15144-1, Eq. 8"
            self._stage.note(table.PRESSURE_VISCOSITY_38.field, alpha, reason)
        self._base_oil(oil)

    def _base_oil(self, oil: Component) -> None:
        """Fill in the kind of base oil."""
        path, texts = "lubricant.kind", {}
        for name in (*table.OIL_TYPES, *table.OIL_WORDS):
            texts[name] = self._reading.text(oil, name)
        texts["component"] = oil.name.lower()
        vague: str | None = None
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
                self._stage.put(path, kind, oil, name)
                return
            vague = vague or stated
            if name in table.OIL_TYPES:
                break
        if vague is None:
            self._stage.assume(path, "mineral", "the file does not give the base oil")
            return
        self._reading.find(
            "oil_kind", oil, None, f"there is no model for an oil of the kind {vague[:40]}; choose the nearest kind"
        )
        self._stage.lacks(
            path, oil, None, f"choose the kind of oil that is nearest to {vague[:40]}; otherwise a mineral oil is used"
        )

    def _temperatures(self) -> None:
        """Fill in the oil temperature, the oil supply and the bulk temperature."""
        for origin in self._stage.oil_origins:
            if self._stage.take(table.OIL_TEMPERATURE, origin) is not None:
                break
        row, bulks = table.BULK_TEMPERATURE, self._stage.values_of(self._stage.gears, table.BULK_TEMPERATURE)
        if bulks:
            self._stage.put(row.field, sum(value for value, _ in bulks) / len(bulks), bulks[0][1], row.name)
            if abs(bulks[0][0] - bulks[-1][0]) > SAME * 100.0:
                self._stage.note(row.field, self._stage.fields[row.field], "the mean of both gears is used")
        else:
            self._stage.take(row, self._stage.stage)
        for name in table.OIL_SUPPLY:
            text = self._reading.text(self._stage.stage, name)
            supply = next((ours for word, ours in table.SUPPLIES.items() if word in text), None)
            if supply is not None:
                self._stage.put("temperatures.oil_supply", supply, self._stage.stage, name)
                return
            if text:
                message = f"the lubrication method {text[:40]} is not modelled; the value is not used"
                self._reading.find("oil_supply", self._stage.stage, name, message)
        self._supply_by_factor()

    def _supply_by_factor(self) -> None:
        """Set the oil supply from the lubrication factor in the file."""
        factor = self._reading.number(self._stage.stage, table.SUPPLY_FACTOR)
        if factor is None:
            return
        if (supply := table.SUPPLY_FACTORS.get(factor)) is not None:
            self._stage.put("temperatures.oil_supply", supply, self._stage.stage, table.SUPPLY_FACTOR)
        else:
            message = (
                f"the lubrication factor {factor:.4g} does not belong to any oil supply of the model; the factor is "
                "not used"
            )
            self._reading.find("oil_supply", self._stage.stage, table.SUPPLY_FACTOR, message)

    def _friction(self) -> None:
        """Fill in the coefficient of friction, unless the file says that this coefficient was calculated."""
        methods = [self._reading.text(self._stage.stage, name) for name in table.FRICTION_METHODS]
        if set(methods) <= {"", "is_given"}:
            self._stage.take(table.FRICTION, self._stage.stage)
