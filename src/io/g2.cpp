// SPDX-License-Identifier: Apache-2.0
// GoTools' and SISL's .g2: a sequence of objects, each with a header "class major minor n", n integers, and a body.
//   100 spline curve (checked and left out)   200 spline surface   210 bounded surface (read when nothing is cut away)
// Rational coefficients are homogeneous (w·x, w·y, w·z, w); the first parameter runs fastest.
#include <fmt/format.h>

#include <algorithm>

#include "raw_patch.h"
#include "text_cursor.h"

namespace patchproof {
namespace {

constexpr long kSplineCurve = 100, kSplineSurface = 200, kBoundedSurface = 210;

// A curve in the parameter plane or in space, as far as trimming needs it.
struct RawCurve {
  int per_point = 0;
  bool rational = false;
  bool clamped = false;  // begins and ends at its first and last coefficient
  std::vector<std::string_view> coordinates;
};

class G2Reader {
 public:
  G2Reader(const SourceFile& source, ModelSink& sink)
      : source_(source), sink_(sink), cursor_(source, TextCursor::Comments::none) {}

  std::optional<Error> read() {
    while (!cursor_.at_end())
      if (!object()) return error_;
    if (sink_.patch_count() == 0)
      return cursor_.ended(ErrorCode::unsupported, "the file holds no spline surface",
                           fmt::format("{} curves", curves_));
    if (curves_ > 0) sink_.notes.push_back(fmt::format("{} curve{} skipped", curves_, curves_ == 1 ? "" : "s"));
    return std::nullopt;
  }

 private:
  bool fail(Error error) {
    error_ = std::move(error);
    return false;
  }

  bool integer(std::string_view what, long low, long high, long& value, ErrorCode code = ErrorCode::syntax) {
    const Result<long> read = cursor_.integer(what);
    if (!read) return fail(read.error());
    value = *read;
    if (low <= value && value <= high) return true;
    return fail(
        source_.error(code, cursor_.last(), fmt::format("{} is not in {} … {}", what, low, high), cursor_.last()));
  }

  bool object() {
    long type, version, extra;
    if (!integer("the class of an object", 1, 99999, type)) return false;
    const std::string_view at = cursor_.last();
    if (!integer("a major version", 0, 1000, version) || !integer("a minor version", 0, 1000, version)) return false;
    if (!integer("the number of auxiliary integers", 0, 1000, extra)) return false;
    for (long i = 0, ignored; i < extra; ++i)
      if (!integer("an auxiliary integer", -1000000000, 1000000000, ignored)) return false;
    if (type == kSplineCurve) {
      ++curves_;
      RawCurve ignored;
      return spline_curve(ignored);
    }
    RawPatch patch;
    patch.at = at;
    if (type == kSplineSurface) return spline_surface(patch) && deliver(patch);
    if (type == kBoundedSurface) return bounded_surface(patch) && deliver(patch);
    return fail(source_.error(
        ErrorCode::unsupported, at,
        "only objects of class 100 (spline curve), 200 (spline surface) and 210 (bounded surface) are read", at));
  }

  bool deliver(const RawPatch& patch) {
    error_ = sink_.add(patch);
    return !error_;
  }

  // "dimension rational"
  bool dimension_line(long low, int& per_point, bool& rational) {
    long dimension, flag;
    if (!integer("the dimension of space", low, 3, dimension, ErrorCode::unsupported)) return false;
    if (!integer("the flag for rational", 0, 1, flag)) return false;
    rational = flag == 1;
    per_point = static_cast<int>(dimension + flag);
    return true;
  }

  // "count order" and count + order knots.
  bool basis(std::string_view direction, long& count, long& degree, RawPatch& patch,
             std::vector<std::string_view>& knots) {
    long order;
    if (!integer(fmt::format("the number of coefficients along {}", direction), 1, kMaxFileBytes, count,
                 ErrorCode::wrong_count))
      return false;
    if (!integer(fmt::format("the order along {}", direction), 2, kMaxDegree + 1, order, ErrorCode::bad_degree))
      return false;
    degree = order - 1;
    if (count < order)
      return fail(source_.error(ErrorCode::wrong_count, cursor_.last(),
                                fmt::format("fewer coefficients than the order along {}", direction),
                                fmt::format("{} coefficients, order {}", count, order)));
    if (cursor_.take(static_cast<std::size_t>(count + order), knots)) return true;
    return ended_inside(patch, "knots");
  }

  bool ended_inside(const RawPatch& patch, std::string_view what) {
    error_ = sink_.first_bad_number(patch);
    if (!error_)
      error_ = cursor_.ended(ErrorCode::syntax, fmt::format("the file ends inside the {} of an object", what));
    return false;
  }

  bool spline_surface(RawPatch& patch) {
    bool rational;
    if (!dimension_line(2, patch.per_point, rational)) return false;
    patch.weight_form = rational ? Weights::homogeneous : Weights::none;
    patch.has_knots = true;
    patch.u_fastest = true;
    if (!basis("u", patch.count[0], patch.degree[0], patch, patch.knots[0])) return false;
    if (!basis("v", patch.count[1], patch.degree[1], patch, patch.knots[1])) return false;
    const std::size_t needed = static_cast<std::size_t>(patch.count[0]) * patch.count[1] * patch.per_point;
    if (cursor_.take(needed, patch.coordinates)) return true;
    return ended_inside(patch, "coefficients");
  }

  bool spline_curve(RawCurve& curve) {
    RawPatch texts;  // only to complain about unreadable numbers
    if (!dimension_line(1, curve.per_point, curve.rational)) return false;
    texts.per_point = curve.per_point;
    long count, degree;
    if (!basis("the curve", count, degree, texts, texts.knots[0])) return false;
    if (!cursor_.take(static_cast<std::size_t>(count) * curve.per_point, texts.coordinates))
      return ended_inside(texts, "coefficients");
    error_ = sink_.first_bad_number(texts);
    const auto& knots = texts.knots[0];
    curve.clamped =
        std::all_of(knots.begin(), knots.begin() + degree + 1, [&](auto t) { return t == knots.front(); }) &&
        std::all_of(knots.end() - degree - 1, knots.end(), [&](auto t) { return t == knots.back(); });
    curve.coordinates = std::move(texts.coordinates);
    return !error_;
  }

  // 210: a surface, then loops of curves on it. Legal here when the one loop is the rectangle of the domain.
  bool bounded_surface(RawPatch& patch) {
    long type, loops, curves, ignored;
    if (!integer("the class of the bounded surface", 1, 99999, type)) return false;
    if (type != kSplineSurface)
      return fail(source_.error(ErrorCode::unsupported, cursor_.last(), "a bounded surface that is no spline surface",
                                cursor_.last()));
    if (!spline_surface(patch)) return false;
    if (!integer("the number of loops", 0, 1000000, loops)) return false;
    if (loops != 1) return trimmed(patch, fmt::format("{} loops", loops));
    if (!integer("the number of curves in a loop", 1, 1000000, curves)) return false;
    if (cursor_.next().empty()) return ended_inside(patch, "loops");  // the loop's tolerance
    std::vector<RawCurve> loop;
    for (long c = 0; c < curves; ++c) {
      long plane_type, space_type;
      if (!integer("the flag for the preferred curve", 0, 1, ignored)) return false;
      if (!integer("the class of the parameter curve", 0, 99999, plane_type)) return false;
      if (!integer("the class of the space curve", 0, 99999, space_type)) return false;
      if (plane_type != kSplineCurve || (space_type != kSplineCurve && space_type != 0))
        return trimmed(patch, fmt::format("curve classes {} and {}", plane_type, space_type));
      RawCurve space;
      if (!spline_curve(loop.emplace_back())) return false;
      if (space_type == kSplineCurve && !spline_curve(space)) return false;
    }
    return is_whole(patch, loop) || (error_ ? false : trimmed(patch, "a loop inside the domain"));
  }

  bool trimmed(const RawPatch& patch, std::string values) {
    return fail(source_.error(
        ErrorCode::unsupported, patch.at,
        "a trimmed surface: only bounded surfaces whose loop is the border of the domain are read", values));
  }

  // Exactly: every parameter curve stays on one side of the domain's rectangle, each begins where the one before ends, and
  // the loop meets each of the four corners, in the order of one turn.
  bool is_whole(const RawPatch& patch, const std::vector<RawCurve>& loop) {
    std::array<Rational, 2> low, high;
    for (int d = 0; d < 2; ++d)
      if (!value(patch.knots[d][patch.degree[d]], low[d]) || !value(patch.knots[d][patch.count[d]], high[d]))
        return false;
    using Point = std::array<Rational, 2>;
    std::vector<Point> corners;
    Point last, first;
    for (std::size_t c = 0; c < loop.size(); ++c) {
      if (loop[c].rational || !loop[c].clamped || loop[c].per_point != 2) return false;
      std::vector<Point> points;
      for (std::size_t k = 0; k + 1 < loop[c].coordinates.size(); k += 2) {
        Point p;
        if (!value(loop[c].coordinates[k], p[0]) || !value(loop[c].coordinates[k + 1], p[1])) return false;
        for (int d = 0; d < 2; ++d)
          if (p[d] < low[d] || high[d] < p[d]) return false;
        points.push_back(p);
      }
      if (!on_one_side(points, low, high)) return false;
      if (c == 0)
        first = points.front();
      else if (points.front() != last)
        return false;
      last = points.back();
      for (const Point& p : {points.front(), points.back()})
        if ((p[0] == low[0] || p[0] == high[0]) && (p[1] == low[1] || p[1] == high[1]) &&
            (corners.empty() || corners.back() != p))
          corners.push_back(p);
    }
    if (last != first) return false;
    if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    if (corners.size() != 4) return false;
    // Opposite corners differ in both coordinates, neighbours in one.
    return corners[0][0] != corners[2][0] && corners[0][1] != corners[2][1] && corners[1][0] != corners[3][0] &&
           corners[1][1] != corners[3][1];
  }

  static bool on_one_side(const std::vector<std::array<Rational, 2>>& points, const std::array<Rational, 2>& low,
                          const std::array<Rational, 2>& high) {
    for (int d = 0; d < 2; ++d)
      for (const Rational& side : {low[d], high[d]}) {
        bool all = true;
        for (const auto& p : points) all = all && p[d] == side;
        if (all) return true;
      }
    return false;
  }

  // Numbers that decide about trimming are compared as they are written, whatever --decimals says.
  bool value(std::string_view text, Rational& out) {
    Result<Rational> read = parse_scalar<Rational>(text);
    if (!read) return fail(source_.error(read.error().code, text, read.error().message, text));
    out = std::move(read).value();
    return true;
  }

  const SourceFile& source_;
  ModelSink& sink_;
  TextCursor cursor_;
  std::optional<Error> error_;
  long curves_ = 0;
};

}  // namespace

std::optional<Error> read_g2(const SourceFile& source, ModelSink& sink) { return G2Reader(source, sink).read(); }

}  // namespace patchproof
