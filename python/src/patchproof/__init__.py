# SPDX-License-Identifier: Apache-2.0
"""patchproof: exact and certified free-form geometry.

    import patchproof
    model = patchproof.read("cup.json")
    points = model.patches[0].evaluate(uv)           # uv: float64 array of shape (n, 2); points: (n, 3)
    report = patchproof.certify(model, require="G1")
    for join in report.joins: print(join)

Models hold exact numbers and never change. Lengths are in the model's units, angles in degrees; parameters are those of
the patch's own domain. Everything may be called by any number of threads at once, and works without the interpreter's
lock. Bad data raises patchproof.Error, a wrong type, dtype or shape TypeError.
"""
from ._construct import CurveData, DeclaredJoin, PatchData
from ._errors import Error, InternalError
from ._numbers import Quadratic
from ._patchproof import (Curve, Mesh, Model, Patch, Report, __version__, certify, fill, fill_text, read, read_text,
                          tessellate)
from ._values import (Bounds, CurveDerivatives, CurveJoin, Derivatives, FillSummary, Join, JoinSide, Proofs, ReportSummary,
                      Verdict, Witness)

__all__ = [
    "Bounds", "Curve", "CurveData", "CurveDerivatives", "CurveJoin", "DeclaredJoin", "Derivatives", "Error", "FillSummary",
    "InternalError", "Join", "JoinSide", "Mesh", "Model", "Patch", "PatchData", "Proofs", "Quadratic", "Report",
    "ReportSummary", "Verdict", "Witness", "certify", "fill", "fill_text", "read", "read_text", "tessellate",
]
