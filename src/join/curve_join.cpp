// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/curve_join.h"

#include "patchproof/scalar/ball.h"
#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/scalar/quadratic.h"
#include "patchproof/spline/smoothness.h"

namespace patchproof {
namespace {

template <ExactField T>
using Point = Vec<T, 3>;
template <ExactField T>
using Taylor = detail::TaylorQuotient<T, 3>;

template <ExactField T>
Sign sign_of(const T& x) {
  return *scalar_traits<T>::sign(x);
}

template <ExactField T>
bool is_zero(const Point<T>& p) {
  return detail::is_zero_point(p);
}

// √(square), enclosed. REQUIRES square ≥ 0 and a RoundingGuard.
template <ExactField T>
Interval enclosed_root(const T& square) {
  if (sign_of(square) == Sign::zero) return Interval(0);
  ScaledInterval s = enclose_scaled(square);
  if (s.exponent % 2 != 0) s = {s.mantissa + s.mantissa, s.exponent - 1};
  return scale_by_power_of_two(sqrt(s.mantissa), s.exponent / 2);
}

Enclosure bounds(const Interval& x) { return {std::max(0.0, x.inf()), x.sup()}; }

template <ExactField T>
Enclosure length_of(const Point<T>& p) {
  return bounds(enclosed_root(dot(p, p)));
}

// The angle in degrees between two directions that are not zero.
template <ExactField T>
Enclosure angle_between(const Point<T>& u, const Point<T>& v) {
  const Point<T> normal = cross(u, v);
  const T sine = dot(normal, normal), cosine = dot(u, v);  // the first one squared, times the same lengths
  if (sign_of(sine) == Sign::zero) return sign_of(cosine) == Sign::positive ? Enclosure{0, 0} : Enclosure{180, 180};
  if (sign_of(cosine) == Sign::zero) return {90, 90};
  const T square = cosine * cosine;
  const bool steep = square < sine;  // from 45° to 135°
  const Ball acute = atan(Ball(enclosed_root(steep ? T(square / sine) : T(sine / square)))) * Ball(180) / Ball::pi();
  const Ball angle = steep ? sign_of(cosine) == Sign::positive ? Ball(90) - acute : Ball(90) + acute
                     : sign_of(cosine) == Sign::positive ? acute
                                                         : Ball(180) - acute;
  return bounds(angle.to_interval());
}

template <ExactField T>
std::vector<std::string> texts(const Point<T>& p) {
  return {to_text(p[0]), to_text(p[1]), to_text(p[2])};
}

// The curve's Taylor coefficients at its end in the parameter of travel, or in the distance from the join (outwards).
enum class Seen { into, out_of, outwards };
template <ExactField T>
Taylor<T> expansion(const CurveSide<T>& side, int order, Seen seen) {
  const bool at_begin = side.end == CurveEnd::begin;
  const KnotVector<T>& knots = side.curve->knots();
  const T& t = at_begin ? knots.domain_begin() : knots.domain_end();
  auto coefficients = detail::taylor(*side.curve, t, at_begin ? Side::right : Side::left, order);
  const bool backwards = seen == Seen::into ? at_begin : !at_begin;
  for (std::size_t k = 1; backwards && k < coefficients.size(); k += 2) coefficients[k] = -coefficients[k];
  return detail::as_quotient(coefficients);
}

// The curve near its end: affine Taylor coefficients outwards.
template <ExactField T>
struct Shape {
  int first = 0;  // k
  std::vector<Point<T>> c;
  bool infinite = false;
  Point<T> curvature{};

  const Point<T>& direction() const { return c[first]; }
};

template <ExactField T>
Shape<T> shape_of(const CurveSide<T>& side) {
  const int degree = side.curve->degree();
  Shape<T> out;
  for (int order = std::min(degree, 2);; order = std::min(degree, 2 * order)) {
    out.first = detail::first_derivative_not_zero(expansion(side, order, Seen::outwards)).first;
    if (out.first != 0 || order == degree) break;
  }
  const int last = std::max(2, 2 * out.first);
  const Taylor<T> series = expansion(side, last, Seen::outwards);
  for (int k = 0; k <= last; ++k) {
    Point<T> sum = series.a[k];
    for (int j = 1; j <= k; ++j) sum = sum - series.w[j] * out.c[k - j];
    out.c.push_back(T(1) / series.w[0] * sum);
  }
  if (out.first == 0) return out;
  const T square = dot(out.direction(), out.direction());
  for (int k = out.first + 1; k <= last && !out.infinite; ++k) {
    const Point<T> across = out.c[k] - (dot(out.c[k], out.direction()) / square) * out.direction();
    if (k < 2 * out.first)
      out.infinite = !is_zero(across);
    else
      out.curvature = T(2) / square * across;
  }
  return out;
}

CurveClass proven() { return {Verdict::proven, "", "", {}}; }
CurveClass undecided(std::string reason) { return {Verdict::undecided, std::move(reason), "", {}}; }

template <ExactField T>
class Certifier {
 public:
  Certifier(const CurveSide<T>& a, const CurveSide<T>& b) : a_(a), b_(b), x_(shape_of(a)), y_(shape_of(b)) {}

  CurveCertificate run() {
    const Point<T> gap = x_.c[0] - y_.c[0];
    const T squared = dot(gap, gap);
    out_.gap_squared = to_text(squared);
    out_.gap = bounds(enclosed_root(squared));
    out_.first = {x_.first, y_.first};
    measure();
    const Smoothness<T, 3> meeting = meet(T(1));
    out_.order = out_.scaled_order = meeting.order;
    if (meeting.order < 0) {
      refute_all(gap);
      return std::move(out_);
    }
    out_.c0 = proven();
    decide_parametric(meeting);
    decide_tangent();
    decide_curvature();
    return std::move(out_);
  }

 private:
  // x, and y run through λ times slower.
  Smoothness<T, 3> meet(const T& ratio) const {
    const int degree = std::max(a_.curve->degree(), b_.curve->degree());
    return detail::meet_lazily(degree, [&](int order, bool complete) {
      Taylor<T> right = expansion(b_, order, Seen::out_of);
      T factor(1);
      for (std::size_t k = 1; k < right.w.size(); ++k) {
        factor = factor / ratio;
        right.a[k] = factor * right.a[k];
        right.w[k] = factor * right.w[k];
      }
      return detail::meet(expansion(a_, order, Seen::into), right, complete);
    });
  }

  void measure() {
    // Along the travel x' = −c_1, x'' = 2 c_2, y' = c'_1, y'' = 2 c'_2.
    const Point<T> second = T(2) * x_.c[2], other_second = T(2) * y_.c[2];
    out_.first_difference = length_of(x_.c[1] + y_.c[1]);
    out_.second_difference = length_of(second - other_second);
    if (!is_zero(second) && !is_zero(other_second)) out_.second_angle = angle_between(second, other_second);
    if (x_.first == 1 && y_.first == 1)
      out_.speed_ratio = bounds(enclosed_root(T(dot(y_.c[1], y_.c[1]) / dot(x_.c[1], x_.c[1]))));
    if (x_.first > 0 && y_.first > 0) out_.angle = angle_between(-x_.direction(), y_.direction());
    for (const Shape<T>* s : {&x_, &y_})
      if (s->first > 0 && !s->infinite) out_.curvature[s == &y_] = length_of(s->curvature);
    if (out_.curvature[0] && out_.curvature[1]) out_.curvature_difference = length_of(x_.curvature - y_.curvature);
  }

  void refute_all(const Point<T>& gap) {
    out_.c0 = {Verdict::refuted, "the ends are apart", "x - y", texts(gap)};
    for (CurveClass* other : {&out_.c1, &out_.c2, &out_.g1, &out_.g2})
      *other = {Verdict::refuted, "the ends are apart: not C0", "", {}};
  }

  void decide_parametric(const Smoothness<T, 3>& meeting) {
    out_.c1 = meeting.order >= 1
                  ? proven()
                  : CurveClass{Verdict::refuted, "the first derivatives differ", "x' - y'", texts(-meeting.jump)};
    if (meeting.order >= 2) {
      out_.c2 = proven();
    } else if (meeting.order == 1) {
      out_.c2 = {Verdict::refuted, "the second derivatives differ", "x'' - y''", texts(-meeting.jump)};
    } else {
      out_.c2 = {Verdict::refuted, "not C1", "", {}};
    }
  }

  void decide_tangent() {
    if (x_.first == 0 || y_.first == 0) {
      out_.g1 = undecided("a curve is a point near its end: it has no tangent");
      return;
    }
    const Point<T> normal = cross(x_.direction(), y_.direction());
    const T along = dot(x_.direction(), y_.direction());
    if (!is_zero(normal)) {
      out_.g1 = {Verdict::refuted, "the tangents differ", "c × c'", texts(normal)};
    } else if (sign_of(along) == Sign::positive) {
      out_.g1 = {Verdict::refuted, "the second curve runs back: a cusp", "c · c'", {to_text(along)}};
    } else {
      out_.g1 = proven();
      if (x_.first != 1 || y_.first != 1) return;
      const T ratio = -(along / dot(x_.direction(), x_.direction()));
      out_.ratio = to_text(ratio);
      out_.scaled_order = meet(ratio).order;
    }
  }

  void decide_curvature() {
    if (out_.g1.verdict != Verdict::proven) {
      out_.g2 = out_.g1.verdict == Verdict::refuted ? CurveClass{Verdict::refuted, "not G1", "", {}}
                                                    : undecided(out_.g1.reason);
    } else if (x_.infinite && y_.infinite) {
      out_.g2 = undecided("both curvatures are infinite");
    } else if (x_.infinite || y_.infinite) {
      out_.g2 = {Verdict::refuted, "one curvature is infinite, the other is not", "", {}};
    } else if (const Point<T> difference = x_.curvature - y_.curvature; is_zero(difference)) {
      out_.g2 = proven();
    } else {
      out_.g2 = {Verdict::refuted, "the curvatures differ", "κ - κ'", texts(difference)};
    }
  }

  const CurveSide<T>&a_, b_;
  Shape<T> x_, y_;
  CurveCertificate out_;
};

bool is_proven(const CurveClass& c) { return c.verdict == Verdict::proven; }

// One step of class_within.
Outcome compare(const std::optional<Enclosure>& bound, double tolerance) {
  if (!bound) return Outcome::undecided;
  return bound->upper <= tolerance ? Outcome::pass : bound->lower > tolerance ? Outcome::fail : Outcome::undecided;
}

}  // namespace

template <ExactField T>
CurveCertificate certify_curve_join(const CurveSide<T>& a, const CurveSide<T>& b) {
  PATCHPROOF_REQUIRES(a.curve && b.curve && !(a.curve == b.curve && a.end == b.end),
                      "certify_curve_join: two ends, not the same one twice");
  const RoundingGuard guard;
  return Certifier<T>(a, b).run();
}

template CurveCertificate certify_curve_join(const CurveSide<Rational>&, const CurveSide<Rational>&);
template CurveCertificate certify_curve_join(const CurveSide<Quadratic>&, const CurveSide<Quadratic>&);

std::string class_name(const CurveCertificate& c) {
  if (!is_proven(c.c0)) return "gap";
  const bool cusp = c.angle && c.angle->lower >= 180;
  const std::string parametric = c.order == kOneFunction ? "C∞" : "C" + std::to_string(c.order);
  if (c.g1.verdict == Verdict::undecided) return parametric + ", no tangent";
  if (!is_proven(c.g1)) return parametric + (cusp ? ", cusp" : c.order > 0 ? ", not G1" : "");
  const int geometric = is_proven(c.g2) ? 2 : 1;
  if (c.order >= geometric) return parametric + (c.order >= 2 && c.g2.verdict == Verdict::refuted ? ", not G2" : "");
  return "G" + std::to_string(geometric) + (c.order > 0 ? ", " + parametric : "");
}

std::string class_within(const CurveCertificate& c, const CurveTolerances& tolerances) {
  if (!tolerances.gap) return "";
  const std::pair<std::optional<Enclosure>, std::optional<double>> steps[] = {
      {c.gap, tolerances.gap}, {c.angle, tolerances.angle}, {c.curvature_difference, tolerances.curvature}};
  std::string reached = "apart";
  for (int k = 0; k < 3 && steps[k].second; ++k) {
    const Outcome outcome = compare(steps[k].first, *steps[k].second);
    if (outcome != Outcome::pass) return reached + (outcome == Outcome::undecided ? "?" : "");
    reached = "G" + std::to_string(k);
  }
  return reached;
}

Judgement judge(const CurveCertificate& c, const Request& request, std::optional<double> curvature) {
  Judgement judgement;
  const auto lower_to = [&](Outcome outcome, const std::string& reason) {
    if (outcome == Outcome::pass || judgement.outcome == Outcome::fail) return;
    if (outcome == Outcome::undecided && judgement.outcome == Outcome::undecided) return;
    judgement = {outcome, reason};
  };
  if (request.require) {
    const CurveClass& asked = *request.require == Continuity::c0   ? c.c0
                              : *request.require == Continuity::c1 ? c.c1
                                                                   : c.g1;
    if (asked.verdict == Verdict::refuted) lower_to(Outcome::fail, asked.reason);
    if (asked.verdict == Verdict::undecided) lower_to(Outcome::undecided, asked.reason);
  }
  const auto against = [&](const std::optional<Enclosure>& bound, const std::optional<double>& tolerance,
                           const std::string& name, const char* missing) {
    if (!tolerance) return;
    const Outcome outcome = compare(bound, *tolerance);
    lower_to(outcome, !bound                     ? missing
                      : outcome == Outcome::fail ? "the " + name + " exceeds the tolerance"
                                                 : "the tolerance lies between the bounds of the " + name);
  };
  against(c.gap, request.gap_tolerance, "gap", "");
  against(c.angle, request.angle_tolerance, "tangent angle", "a curve is a point near its end: it has no tangent");
  against(c.curvature_difference, curvature, "curvature difference", "a curvature is infinite or there is none");
  return judgement;
}

const char* to_string(CurveEnd end) { return end == CurveEnd::begin ? "begin" : "end"; }

}  // namespace patchproof
