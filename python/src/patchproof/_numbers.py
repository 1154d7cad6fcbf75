# SPDX-License-Identifier: Apache-2.0
"""Exact numbers on their way in and out: fractions, and numbers with one square root."""
from __future__ import annotations

import dataclasses
import decimal
import math
import numbers
import re
from fractions import Fraction
from typing import Any, Union

from ._errors import Error


@dataclasses.dataclass(frozen=True, repr=False)
class Quadratic:
    """The number a + b·√d, exactly; d > 1 has no square factor, and b is not 0.

    Values of models over Q(√d), a circle's for instance, come as these where the root does not cancel. It is a record and
    does no arithmetic: float(x) rounds it, str(x) is what patchproof reads.
    """

    a: Fraction
    b: Fraction
    d: int

    def __float__(self) -> float:
        # With q = a² − b²·d, which is exact and not 0, a + b√d = q / (a − b√d): of the two the one that does not cancel.
        with decimal.localcontext() as context:
            context.prec, context.Emax, context.Emin = 60, decimal.MAX_EMAX, decimal.MIN_EMIN
            root = _decimal(self.b) * decimal.Decimal(self.d).sqrt()
            if (self.a < 0) == (self.b < 0):
                return float(_decimal(self.a) + root)
            return float(_decimal(self.a * self.a - self.b * self.b * self.d) / (_decimal(self.a) - root))

    def __str__(self) -> str:
        root = f"{self.b}*sqrt({self.d})"
        return root if self.a == 0 else f"{self.a}{'' if self.b < 0 else '+'}{root}"

    def __repr__(self) -> str:
        return f"Quadratic({self})"


Exact = Union[Fraction, Quadratic]

_QUADRATIC = re.compile(r"(?P<a>[+-]?\d+(?:/\d+)?(?=[+-]))?(?P<sign>[+-]?)(?:(?P<b>\d+(?:/\d+)?)\*)?sqrt\((?P<d>\d+)\)")
_FRACTION = re.compile(r"(?P<sign>[+-]?)(?P<above>\d+)(?:/(?P<below>\d+))?")
_MOST_DIGITS = 4000  # that Python's int() and str() take; patchproof reads numbers of at most 4096 characters


def from_text(text: str) -> Exact:
    """The number that patchproof writes as "7/3" or "1/2+1/2*sqrt(2)"."""
    match = _QUADRATIC.fullmatch(text)
    if match is None:
        return _fraction(text)
    b = _fraction(match["b"] or "1")
    return Quadratic(_fraction(match["a"] or "0"), -b if match["sign"] == "-" else b, int(match["d"]))


def exact_or_text(text: str) -> Union[Exact, str]:
    """from_text, or the text where it is no such number."""
    try:
        return from_text(text)
    except ValueError:
        return text


def to_text(number: Any) -> str:
    """An int, Fraction, Decimal, Quadratic or text as it is; a float as exactly the number that it is.

    Raises TypeError for anything else. "nan" and what is no number are refused later, with their place.
    """
    if isinstance(number, str):
        return number
    if isinstance(number, Quadratic):
        return str(number)
    if isinstance(number, numbers.Rational):
        return _text_of_fraction(Fraction(int(number.numerator), int(number.denominator)))
    if isinstance(number, decimal.Decimal):
        return _text_of_fraction(Fraction(number)) if number.is_finite() else str(number)
    if isinstance(number, numbers.Real) and not math.isfinite(number):
        return str(float(number))
    if isinstance(number, numbers.Real) and float(number) == number:
        return _text_of_fraction(Fraction(float(number)))
    raise TypeError(f"an exact number is an int, Fraction, float, Decimal, Quadratic or text such as '1/3', not {number!r}")


def _decimal(x: Fraction) -> decimal.Decimal:
    return decimal.Decimal(x.numerator) / x.denominator


def _integer(digits: str) -> int:
    """int(digits), however many there are."""
    if len(digits) <= _MOST_DIGITS:
        return int(digits)
    half = len(digits) // 2
    power: int = 10**half
    return _integer(digits[:-half]) * power + _integer(digits[-half:])


def _fraction(text: str) -> Fraction:
    match = _FRACTION.fullmatch(text)
    if match is None:
        raise ValueError(f"no fraction: {text!r}")
    above, below = _integer(match["above"]), _integer(match["below"] or "1")
    return Fraction(-above if match["sign"] == "-" else above, below)


def _text_of_fraction(x: Fraction) -> str:
    bits = max(abs(x.numerator), x.denominator).bit_length()
    if bits > _MOST_DIGITS * 3:
        raise Error("bad_number", "", "a number of more than 4096 characters", f"one of {bits} bits")
    return str(x)
