// SPDX-License-Identifier: Apache-2.0
#include "validation/verdicts/ours.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "patchproof/patch/rational_patch.h"
#include "patchproof/scalar/parse_scalar.h"

namespace patchproof::verdicts {
namespace {

std::map<std::string, Verdict> classes_of(const Certificate& c) {
  return {{"C0", c.c0.verdict}, {"C1", c.c1.verdict}, {"C2", c.c2.verdict}, {"G1", c.g1.verdict}};
}

struct Values {
  double gap, angle;  // degrees
};

// Gap and angle where both patches have the parameter v: exact up to the last square roots and the arc tangent.
Values values_at(const Shape& shape, const Rational& v) {
  const auto side_of = [](const Rational& at, const KnotVector<Rational>& k) {
    return at < k.domain_end() ? Side::right : Side::left;
  };
  const auto derivatives = [&](const BsplinePatch<Rational, 4>& s, EdgeName edge) {
    const IsoLine<Rational> line = edge_line(s, edge);
    return rational_derivatives(s, line.value, v, 1, 1, line.side, side_of(v, s.knots(Direction::v)));
  };
  const auto a = derivatives(shape.a, EdgeName::u_max), b = derivatives(shape.b, EdgeName::u_min);
  const auto d = a.at(0, 0) - b.at(0, 0);
  const auto n = cross(a.at(1, 0), a.at(0, 1)), m = cross(b.at(1, 0), b.at(0, 1));
  const Rational size = dot(n, n) * dot(m, m), cosine = dot(n, m);
  const auto c = cross(n, m);
  const double sine = std::sqrt(nearest_double(dot(c, c) / size));
  const double turned = std::copysign(std::sqrt(nearest_double(cosine * cosine / size)), nearest_double(cosine));
  return {std::sqrt(nearest_double(dot(d, d))), std::atan2(sine, turned) * (180 / std::numbers::pi)};
}

constexpr double kRounding = 1e-12;  // relative: of the square roots and the arc tangent above

class Examination {
 public:
  std::vector<std::string> found;

  void truth(const Truth& truth, const Certificate& c) {
    for (const auto& [name, verdict] : classes_of(c))
      if (const std::string& expected = truth.classes.at(name); to_string(verdict) != expected)
        complain("{} is {}, but {} is true", name, to_string(verdict), expected);
    if (!truth.orientation.empty() && to_string(c.orientation) != truth.orientation)
      complain("the orientation is {}, not {}", to_string(c.orientation), truth.orientation);
    encloses("gap", c.gap, truth.gap);
    encloses("angle", c.angle, truth.angle);
  }

  // With both exact ends, 33 values or, for one shape of many, 5.
  void values(const Shape& shape, const Certificate& c, int intervals) {
    const ParameterBox<Rational> domain = shape.a.domain();
    for (int i = 0; i <= intervals; ++i) {
      const Rational v = domain.v_begin + (domain.v_end - domain.v_begin) * (Rational(i) / Rational(intervals));
      const Values at = values_at(shape, v);
      below("gap", c.gap, at.gap, v);
      below("angle", c.angle, at.angle, v);
    }
    if (c.gap.lower > 0) attained("gap", c.gap, values_at(shape, from_double(c.gap.at.a[1])).gap);
    if (c.angle.lower > 0) attained("angle", c.angle, values_at(shape, from_double(c.angle.at.a[1])).angle);
  }

  void rounded_angle(double limit, const Certificate& c) {
    if (!(c.angle.upper < limit))
      complain("the angle in doubles has the upper bound {}, not below {}", c.angle.upper, limit);
  }

  template <class... Args>
  void complain(fmt::format_string<Args...> text, Args&&... args) {
    found.push_back(fmt::format(text, std::forward<Args>(args)...));
  }

 private:
  void encloses(const char* what, const EnclosedMaximum& bound, const std::array<Rational, 2>& range) {
    if (!(from_double(bound.lower) <= range[1] && range[0] <= from_double(bound.upper)))
      complain("the {} is in [{}, {}], but [{}, {}] is true", what, bound.lower, bound.upper, to_text(range[0]),
               to_text(range[1]));
    if (!bound.converged) complain("the bounds of the {}, [{}, {}], are not tight", what, bound.lower, bound.upper);
  }

  void below(const char* what, const EnclosedMaximum& bound, double value, const Rational& v) {
    if (value * (1 - kRounding) > bound.upper)
      complain("the {} is {} at v = {}, above its upper bound {}", what, value, to_text(v), bound.upper);
  }

  void attained(const char* what, const EnclosedMaximum& bound, double value) {
    // The witness is rounded to a double; along these edges nothing changes by more than 1e-9 of itself in that.
    if (value * (1 + 1e-9) < bound.lower)
      complain("the {} is {} at v = {}, below its lower bound {}", what, value, bound.at.a[1], bound.lower);
  }
};

}  // namespace

Ours certify_case(const Case& c) {
  Ours out;
  for (const Shape& shape : c.shapes) {
    const Shape rounded = in_doubles(shape);
    out.exact.push_back(certify_join(shape.a, shape.b, join_of(shape)));
    out.rounded.push_back(certify_join(rounded.a, rounded.b, join_of(rounded)));
    out.one_polynomial += is_one_polynomial(shape);
  }
  return out;
}

std::string classes_in_words(const Certificate& c) {
  const auto all = classes_of(c);
  std::string holds, fails, open;
  const auto add = [](std::string& list, const std::string& name) { list += (list.empty() ? "" : ", ") + name; };
  for (const char* name : {"C0", "G1", "C1", "C2"}) {
    const Verdict verdict = all.at(name);
    add(verdict == Verdict::proven ? holds : verdict == Verdict::refuted ? fails : open, name);
  }
  std::string words;
  for (const auto& [list, what] : {std::pair{&holds, "proven"}, {&fails, "refuted"}, {&open, "undecided"}})
    if (!list->empty()) words += (words.empty() ? "" : "; ") + *list + " " + what;
  return words;
}

std::vector<std::string> complaints(const Case& c, const Ours& ours) {
  Examination examination;
  const int intervals = c.shapes.size() == 1 ? 32 : 4;
  for (std::size_t i = 0; i < c.shapes.size(); ++i) {
    const std::size_t before = examination.found.size();
    examination.truth(c.truth, ours.exact[i]);
    examination.values(c.shapes[i], ours.exact[i], intervals);
    examination.values(in_doubles(c.shapes[i]), ours.rounded[i], intervals);
    if (c.truth.rounded_angle_below) examination.rounded_angle(*c.truth.rounded_angle_below, ours.rounded[i]);
    if (c.shapes.size() > 1)
      for (std::size_t k = before; k < examination.found.size(); ++k)
        examination.found[k] = fmt::format("shape {}: {}", i, examination.found[k]);
  }
  if (c.truth.one_polynomial && ours.one_polynomial != static_cast<int>(c.shapes.size()))
    examination.complain("{} of {} shapes are one polynomial", ours.one_polynomial, c.shapes.size());
  return examination.found;
}

std::vector<std::string> disagreements(const std::vector<Certificate>& rounded,
                                       const std::vector<Certificate>& others) {
  std::vector<std::string> found;
  if (rounded.size() != others.size())
    return {fmt::format("{} joins were certified as CAD shapes, not {}", others.size(), rounded.size())};
  const auto compare = [&](std::size_t i, const char* what, const EnclosedMaximum& a, const EnclosedMaximum& b) {
    if (!(a.lower <= b.upper && b.lower <= a.upper))
      found.push_back(fmt::format("shape {}: the {} is in [{}, {}], as a CAD shape in [{}, {}]", i, what, a.lower,
                                  a.upper, b.lower, b.upper));
  };
  for (std::size_t i = 0; i < rounded.size(); ++i) {
    compare(i, "gap", rounded[i].gap, others[i].gap);
    compare(i, "angle", rounded[i].angle, others[i].angle);
    if (classes_in_words(rounded[i]) != classes_in_words(others[i]))
      found.push_back(
          fmt::format("shape {}: {}, as a CAD shape {}", i, classes_in_words(rounded[i]), classes_in_words(others[i])));
  }
  return found;
}

}  // namespace patchproof::verdicts
