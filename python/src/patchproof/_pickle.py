# SPDX-License-Identifier: Apache-2.0
"""How models, and patches and curves of them, come back from a pickle: the model travels as JSON."""
from __future__ import annotations

from typing import Any

from ._patchproof import Model, read_text


def model(text: str) -> Model:
    return read_text(text, "pickled.json")


def part(model: Model, parts: str, index: int) -> Any:
    return getattr(model, parts)[index]
