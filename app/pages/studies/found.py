"""What a search has found, in sentences: the answer first, its number beside it, the reason after it."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.figures.wording import listed, number
from app.schema.fields import Leaf
from app.studies.fields import whole_range
from app.studies.runner import Line

DIGITS = 4  # significant digits of an answer; the search finds more, but no input is known better
FURTHER = 4.0  # how much longer the range is made to search on, in ranges; above zero the end is multiplied by it
LEVEL = 0.05  # a curve levels off if it changes by less than this share of its range in the last quarter
ENDS = {"min": "the lower end of the range", "max": "the upper end of the range"}


@dataclass(frozen=True, slots=True)
class Found:
    """The last line of a search, with the field, the output and the header of the search."""

    field: Leaf
    output: Leaf
    header: Line
    end: Line
    points: Sequence[Line] = ()

    def value(self, at: Any) -> str:
        """Return a value of the field with its unit."""
        return at if isinstance(at, str) else number(float(at), self.field.unit, digits=DIGITS)

    def named(self, at: Any) -> str:
        """Return a value of the field with the name of the field; oils have names of their own."""
        return at if isinstance(at, str) else f"{self.field.title} {self.value(at)}"

    def reached(self, out: float) -> str:
        """Return a value of the output with its unit."""
        return number(out, self.output.unit, digits=DIGITS)

    def span(self, gap: Line) -> str:
        """Return the values between which there is no solution."""
        first, last = self.value(gap["from"]), self.value(gap["to"])
        return f"at {first}" if first == last else f"from {first} to {last}"

    @property
    def wanted(self) -> str:
        """The value that the output shall have, with its unit."""
        return self.reached(self.header["equals"])

    @property
    def keeps(self) -> int:
        """On which side of a limit the output is safe: -1 below, 1 above, 0 if it has no limit."""
        return {"lower": 1, "upper": -1}.get(self.output.view.bound or "", 0)

    def beyond(self, end: str) -> tuple[float, float] | None:
        """Return a range beyond an end of the one that was searched; None if the field permits nothing there."""
        low, high = self.header["find"]["min"], self.header["find"]["max"]
        least, most = whole_range(self.field)
        if end == "max":
            ends = high, min(FURTHER * high if low >= 0.0 else high + FURTHER * (high - low), most)
        else:
            ends = (
                max(low / FURTHER if least >= 0.0 else low - FURTHER * (high - low), 0.0 if low > 0.0 else least),
                low,
            )
        return ends if ends[0] < ends[1] and not self.field.options else None

    @property
    def levels_off(self) -> bool:
        """Whether the curve ends flat beside the nearest point: its last quarter adds hardly anything."""
        nearest, find = self.end["nearest"], self.header["find"]
        known = sorted((each["at"], each["out"][0]) for each in self.points if each["out"][0] is not None)
        if not nearest or not nearest["end"] or self.header["extreme"] or find["min"] is None or len(known) < 4:
            return False
        quarter = (find["max"] - find["min"]) / 4
        inner = find["max"] - quarter if nearest["end"] == "max" else find["min"] + quarter
        places, outs = zip(*known, strict=True)
        before = float(np.interp(inner, places, outs))
        return abs(float(nearest["out"]) - before) < LEVEL * float(np.ptp(outs))

    def answer(self) -> str:
        """Return the answer to the question of the search."""
        nearest, out = self.end["nearest"], self.output.title
        if nearest is None:
            return "No answer: no point of the range has a solution."
        if self.end["constant"] and not self.end["answers"]:
            return f"The {out} does not depend on it: {self.reached(nearest['out'])} at every point."
        if self.header["find"]["scale"] == "oils":
            return self._of_oils()
        if self.header["extreme"]:
            return self._extreme()
        sentences = [*self._answers(), *(self._crossing(each) for each in self.end["crossings"])]
        return " ".join(sentences) or self._none()

    def _extreme(self) -> str:
        (best,) = self.end["answers"]
        ends = f", {ENDS[best['end']]}" if best["end"] else ""
        if best["end"] and self.beyond(best["end"]):
            ends += f": it may be {self._better()} beyond"
        return _sentence(
            f"{self.named(best['at'])}: the {self.output.title} is {self.header['extreme']} there, "
            f"{self.reached(best['out'])}{ends}."
        )

    def _better(self) -> str:
        return "less" if self.header["extreme"] == "least" else "greater"

    def _answers(self) -> list[str]:
        answers = self.end["answers"]
        if not answers:
            return []
        out, wanted = self.output.title, self.wanted
        if len(answers) > 1:
            places = listed([self.value(each["at"]) for each in answers])
            after = {each["after"] for each in answers[:-1]}
            between = "above" if after == {1} else "below" if after == {-1} else ""
            told = f"{len(answers)} answers: {self.field.title} {places}; the {out} is {wanted} there"
            return [f"{told}, and {between} it in between." if between else f"{told}."]
        (only,) = answers
        if only["until"] is not None:
            return [_sentence(f"{self.named(only['at'])} to {self.value(only['until'])}: the {out} is {wanted} there.")]
        sides = (only["before"], only["after"])
        beyond = {(-1, 1): ", and more beyond", (1, -1): ", and less beyond"}.get(sides, "")
        if sides in {(-1, -1), (1, 1)}:
            beyond = f", its {'greatest' if sides[0] < 0 else 'least'} value nearby"
        return [_sentence(f"{self.named(only['at'])}: the {out} is {wanted} there{beyond}.")]

    def _crossing(self, crossing: Line) -> str:
        (low, high), (before, after) = crossing["between"], crossing["out"]
        out, wanted = self.output.title, self.wanted
        if crossing["kind"] == "jump":
            told = f"from {self.reached(before)} to {self.reached(after)}, past {wanted}"
            return f"No answer at {self.named(high)}: the {out} jumps there {told}."
        if crossing["kind"] == "gap":
            return f"No solution between {self.value(low)} and {self.value(high)}, where the {out} passes {wanted}."
        is_alone = len(self.end["crossings"]) == 1 and not self.end["answers"]
        if self.keeps and is_alone:
            is_high = self._is_safe_above(crossing)
            (good, reached), (bad, missed) = (
                ((high, after), (low, before)) if is_high else ((low, before), (high, after))
            )
            side = "more" if is_high else "less"
            return _sentence(
                f"{self.named(good)} or {side}: the {out} is {self.reached(reached)} there, and {self.reached(missed)} "
                f"at {self.value(bad)}."
            )
        return (
            f"Between {self.named(low)} and {self.value(high)} the {out} goes from {self.reached(before)} to "
            f"{self.reached(after)}, past {wanted}."
        )

    def _is_safe_above(self, crossing: Line) -> bool:
        """Return whether the output is on its safe side above a crossing, and not below it."""
        before, after = crossing["out"]
        return bool(after > before) == (self.keeps > 0)

    def to_open(self) -> list[Any]:
        """Return the values of the field whose cases are worth opening: the answers, or those beside them in a list."""
        if self.end["answers"]:
            return [each["at"] for each in self.end["answers"]]
        found = []
        for crossing in self.end["crossings"]:
            if crossing["kind"] == "between":
                low, high = crossing["between"]
                found += ([high] if self._is_safe_above(crossing) else [low]) if self.keeps else [low, high]
        return found

    def _none(self) -> str:
        nearest, find = self.end["nearest"], self.header["find"]
        span = f"from {self.value(find['min'])} to {self.value(find['max'])}"
        where = f", {ENDS[nearest['end']]}" if nearest["end"] else ""
        where += ", where it levels off" if self.levels_off else ""
        return (
            f"No answer {span}: the nearest {self.output.title} is {self.reached(nearest['out'])}, at "
            f"{self.named(nearest['at'])}{where}."
        )

    def _of_oils(self) -> str:
        answers, nearest, out = self.end["answers"], self.end["nearest"], self.output.title
        if self.header["extreme"]:
            return f"{nearest['at']}: the {out} is {self.header['extreme']} with it, {self.reached(nearest['out'])}."
        if not answers:
            return (
                f"No oil reaches {self.wanted}: the nearest is {nearest['at']}, {out} {self.reached(nearest['out'])}."
            )
        first = answers[0]
        count = f"{len(answers)} of {self.end['points']} oils {'keep' if len(answers) > 1 else 'keeps'}"
        return (
            f"{first['at']} is the thinnest: the {out} is {self.reached(first['out'])} with it. {count} "
            f"{'at most' if self.keeps < 0 else 'at least'} {self.wanted}."
        )


def _sentence(text: str) -> str:
    return text[0].upper() + text[1:]
