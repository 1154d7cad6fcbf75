// SPDX-License-Identifier: Apache-2.0
// How two curves join where an end of one meets an end of the other: exact classes, and certified bounds of what they miss.
//
// The join is passed along a into it and along b out of it, whichever ends meet; a curve that then runs backwards has its
// parameter reversed. x and y are a and b in such parameters, both 0 at the join. With k the order of the first derivative
// that is not zero (1 at a regular end), c = ±x^(k)/k! seen from the join outwards, and c' the same of b:
//
//     parametric  C^n   x^(j)(0) = y^(j)(0) for j = 0…n: up to a shift and, where ends of one kind meet, a reversal
//                       of the parameter, nothing else. Derivatives alone: at zero speed a cusp can be C^1.
//     scaled            the same for y(t/λ) with the λ > 0 that makes the velocities equal ("ratio"): y' = λ x'
//     geometric   G^1   C^0, and c, c' are opposite: one direction of travel, up to any reparametrisation that grows
//                 G^2   G^1, and one curvature vector  κ = 2 c_2k⊥/|c|²,  c_j the j-th outward Taylor coefficient and ⊥ its part
//                       across c (k = 1: κ = x''⊥/|x'|²). When c_j⊥ ≠ 0 for some k < j < 2k, κ is infinite.
// A side that is a point has no direction: G^1 is undecided. Without C^0 all other classes are refuted.
//
// REQUIRES  curves of homogeneous points whose denominators do not vanish at the ends.
// ENSURES   (1) each class is the statement above, decided exactly; `order` is the largest n with C^n, −1 without C^0,
//               kOneFunction when both curves are one polynomial or rational function of the parameter;
//           (2) bounds contain the exact value, are rounded outward, and are 0 (angles: also 180) when that is exact;
//               upper − lower ≤ 2^-40 upper for values in the normal range of doubles;
//           (3) exchanging a and b, or reversing one of them, changes no class and no bound but the speed ratio,
//               which is inverted by the exchange;
//           (4) translations change nothing; scaling by s multiplies lengths by s, curvatures by 1/s;
//           (5) class_within: G0 when the gap is within its tolerance, G1 (G2) when the angle (and the curvature difference) is as
//               well; with tolerances 0 it never says more than the exact class;
//           (6) match_curve_ends: the pairs are those ends that lie within the length or within the sum of their tolerances,
//               compared exactly; of one curve also within a tenth of its size, so that short curves are not closed. An end
//               without a pair is in `free`. Where ends crowd, some pairs are left out, and `crowded` says so.
// SCALARS   T: Rational, Quadratic.
// COST      O(degree³) points; match_curve_ends: O(n) for ends that do not crowd.
// SOURCE    B. A. Barsky, T. D. DeRose, Geometric continuity of parametric curves, Berkeley 1984; G. Farin, Curves and Surfaces
//           for CAGD, chapter 12. Open CASCADE's BRepLProp compares vectors of the derivatives, TiGL's getEdgeContinuity
//           only the directions of the first and of the second derivatives, both within 1e-7: `angle` and `second_angle`.
// NEIGHBOURS smoothness.h (inside one curve), certify.h (patches).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "patchproof/join/certificate.h"
#include "patchproof/spline/curve.h"

namespace patchproof {

enum class CurveEnd { begin, end };

template <ExactField T>
struct CurveSide {
  const BsplineCurve<T, 4>* curve = nullptr;
  CurveEnd end = CurveEnd::end;
};

// One exact number, enclosed.
struct Enclosure {
  double lower = 0, upper = 0;
};

// A class of a join of curves; a refuted one with exact numbers that say so.
struct CurveClass {
  Verdict verdict = Verdict::undecided;
  std::string reason;
  std::string quantity;             // "x - y", "x' - y'", "x'' - y''", "c × c'", "c · c'", "κ - κ'"
  std::vector<std::string> values;  // its exact components
};

struct CurveCertificate {
  CurveClass c0, c1, c2, g1, g2;
  int order = -1;
  int scaled_order = -1;             // of y(t/ratio); order when there is no ratio
  std::optional<std::string> ratio;  // exact λ > 0
  std::array<int, 2> first{};        // k of a and of b; 0: the curve is a point near its end
  std::string gap_squared;           // exact
  Enclosure gap;
  std::optional<Enclosure> angle;         // degrees, between the directions of travel, 0 to 180: 180 is a cusp
  std::optional<Enclosure> speed_ratio;   // |y'|/|x'|; none at zero speed
  Enclosure first_difference;             // |x' − y'|
  Enclosure second_difference;            // |x'' − y''|
  std::optional<Enclosure> second_angle;  // degrees, between x'' and y''; none when one is zero
  std::array<std::optional<Enclosure>, 2> curvature;  // none: infinite, or the curve is a point
  std::optional<Enclosure> curvature_difference;      // |κ − κ'|
};

// REQUIRES sides that are not the same end of the same curve.
template <ExactField T>
CurveCertificate certify_curve_join(const CurveSide<T>& a, const CurveSide<T>& b);

// The strongest proven class: "gap", "C0", "C0, cusp", "G1", "C1", "G2", "G2, C1", "C2", "C5", "C∞" (one function).
std::string class_name(const CurveCertificate& certificate);

struct CurveTolerances {
  std::optional<double> gap;        // model units
  std::optional<double> angle;      // degrees
  std::optional<double> curvature;  // of |κ − κ'|, 1/model units
};

// "apart", "G0", "G1", "G2": as far as the tolerances reach, each class with those before it, and "?" behind it when the next
// one is undecided; "" without a tolerance of the gap.
std::string class_within(const CurveCertificate& certificate, const CurveTolerances& tolerances);

// pass, fail, undecided of what is asked; the angle is that of the directions of travel.
Judgement judge(const CurveCertificate& certificate, const Request& request, std::optional<double> curvature = {});

struct EndOfCurve {
  int curve = 0;  // 0-based
  CurveEnd end = CurveEnd::begin;
};
struct CurveEndMatch {
  std::vector<std::pair<EndOfCurve, EndOfCurve>> pairs;  // an `end` before a `begin`, else in the order of the curves
  std::vector<EndOfCurve> free;
  bool crowded = false;  // an end has more than kMostPartners partners: further ones are not listed
  double length = 0, diagonal = 0;
};
inline constexpr int kMostPartners = 16;

// length: 0 means 1e-6 of the diagonal of the box of all control points, and never more than a tenth of that of the smaller
// curve. tolerances: of the begin and the end of each curve,
// or empty.
template <ExactField T>
CurveEndMatch match_curve_ends(const std::vector<const BsplineCurve<T, 4>*>& curves, double length = 0,
                               const std::vector<std::array<double, 2>>& tolerances = {});

const char* to_string(CurveEnd end);

}  // namespace patchproof
