"""What is known besides: the true vectors, and what a reference is good for."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .joints import Joint
from .reading import RefusedError, reason_of

# Keys of a truth file that say how good its values are.
AXES_GOOD_TO = "axes_good_to_deg"
VECTORS_GOOD_TO_M = "vectors_good_to_m"
VECTORS_GOOD_TO_PERCENT = "vectors_good_to_percent"
ANGLES_GOOD_TO = "angles_good_to_deg"


@dataclass(frozen=True)
class GoodTo:
    """Differences below say nothing: the reference is not better."""

    value: float  # in the unit drawn
    words: str


@dataclass(frozen=True)
class Truth:
    vectors: np.ndarray  # (K, 3) as the joint's keys
    good_to: GoodTo | None


def facts_of(path: Path) -> dict[str, object]:
    try:
        facts = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise RefusedError(path, reason_of(error)) from None
    except UnicodeDecodeError:
        raise RefusedError(path, "not UTF-8 text") from None
    except json.JSONDecodeError as error:
        raise RefusedError(path, f"not JSON: {error.msg}", error.lineno, error.colno) from None
    if not isinstance(facts, dict):
        raise RefusedError(path, "not a JSON object", 1)
    return facts


def vector_of(path: Path, facts: dict[str, object], key: str) -> np.ndarray:
    try:
        vector = np.array(facts[key], float)
    except (TypeError, ValueError):
        vector = np.empty(0)
    if vector.shape != (3,) or not np.isfinite(vector).all():
        raise RefusedError(path, f"{key}: three numbers are needed")
    return vector


def number_of(place: Path, facts: dict[str, object], key: str) -> float | None:
    value = facts.get(key)
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not 0.0 < value < np.inf:
        raise RefusedError(place, f"{key}: a number above 0 is needed")
    return float(value)


def share_of(percent: float, vectors: np.ndarray, per_unit: float, unit: str) -> GoodTo:
    """A share of the length; of several vectors the longest counts."""
    value = 0.01 * percent * float(np.linalg.norm(vectors, axis=1).max()) * per_unit
    return GoodTo(value, f"{percent:g} % ({value:.2g} {unit})")


def asked_good_to(text: str, unit: str, vectors: np.ndarray | None = None, per_unit: float = 1.0) -> GoodTo:
    """From the option: a number, with or without the unit drawn, or percent where there are lengths."""
    match = re.fullmatch(r"([0-9.]+(?:e-?[0-9]+)?) *(deg|mm|%)?", text.strip())
    try:
        value = float(match[1]) if match else 0.0
    except ValueError:
        value = 0.0
    if not match or not 0.0 < value < np.inf:
        raise RefusedError("--reference-good-to", f"'{text}' is not a number above 0, such as 1deg, 7mm or 5%")
    if match[2] == "%" and vectors is not None:
        return share_of(value, vectors, per_unit, unit)
    if match[2] not in (None, unit):
        raise RefusedError("--reference-good-to", f"'{text}': this figure is in {unit}")
    return GoodTo(value, f"{value:g} {unit}")


def told_good_to(path: Path, facts: dict[str, object], joint: Joint, vectors: np.ndarray) -> GoodTo | None:
    if joint.directions:
        value = number_of(path, facts, AXES_GOOD_TO)
        return None if value is None else GoodTo(value, f"{value:g} deg")
    percent, value_m = number_of(path, facts, VECTORS_GOOD_TO_PERCENT), number_of(path, facts, VECTORS_GOOD_TO_M)
    if percent is not None:
        return share_of(percent, vectors, joint.per_unit, joint.unit)
    return None if value_m is None else GoodTo(joint.per_unit * value_m, f"{joint.per_unit * value_m:g} {joint.unit}")


def read_truth(path: Path | None, recording: Path, joint: Joint, good_to: str | None) -> Truth | None:
    """None if the true vectors are not known. Without a path, RECORDING.json is read if it has them."""
    chosen = path or recording.with_suffix(".json")
    facts = facts_of(chosen) if path or chosen.is_file() else {}
    missing = [key for key in joint.keys if key not in facts]
    if missing:
        if path or good_to:
            raise RefusedError(chosen, f"no {' and no '.join(missing)}: nothing to compare with")
        return None
    vectors = np.array([vector_of(chosen, facts, key) for key in joint.keys])
    if joint.directions and not np.linalg.norm(vectors, axis=1).all():
        raise RefusedError(chosen, "an axis without length")
    if good_to:
        return Truth(vectors, asked_good_to(good_to, joint.unit, vectors if not joint.directions else None, joint.per_unit))
    return Truth(vectors, told_good_to(chosen, facts, joint, vectors))
