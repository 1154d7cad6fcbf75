// SPDX-License-Identifier: Apache-2.0
// GoTools' and SISL's .g2: a sequence of objects, each with a header "class major minor n", n integers, and a body.
//   100 spline curve   200 spline surface   210 bounded surface (read when nothing is cut away)
// Rational coefficients are homogeneous (w·x, w·y, w·z, w); the first parameter runs fastest.
#include <fmt/format.h>

#include <algorithm>

#include "raw_spline.h"
#include "text_cursor.h"

namespace patchproof {
namespace {

constexpr long kSplineCurve = 100, kSplineSurface = 200, kBoundedSurface = 210;

// Begins and ends at its first and last coefficient.
bool is_clamped(const RawSpline& curve) {
  const std::vector<std::string_view>& knots = curve.knots[0];
  const auto order = curve.degree[0] + 1;
  return std::all_of(knots.begin(), knots.begin() + order, [&](auto t) { return t == knots.front(); }) &&
         std::all_of(knots.end() - order, knots.end(), [&](auto t) { return t == knots.back(); });
}

class G2Reader {
 public:
  G2Reader(const SourceFile& source, ModelSink& sink)
      : source_(source), sink_(sink), cursor_(source, TextCursor::Comments::none) {}

  std::optional<Error> read() {
    while (!cursor_.at_end())
      if (!object()) return error_;
    if (sink_.patch_count() == 0 && sink_.curve_count() == 0)
      return cursor_.ended(ErrorCode::unsupported, "the file holds no spline surface and no curve in plane or space");
    if (functions_ > 0)
      sink_.notes.push_back(fmt::format("{} curve{} of dimension 1 skipped", functions_, functions_ == 1 ? "" : "s"));
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
    RawSpline spline;
    spline.at = at;
    if (type == kSplineCurve) {
      if (!spline_curve(spline)) return false;
      return spline.dimension() == 1 ? ++functions_, true : deliver(spline);
    }
    if (type == kSplineSurface) return spline_surface(spline) && deliver(spline);
    if (type == kBoundedSurface) return bounded_surface(spline) && deliver(spline);
    return fail(source_.error(
        ErrorCode::unsupported, at,
        "only objects of class 100 (spline curve), 200 (spline surface) and 210 (bounded surface) are read", at));
  }

  bool deliver(const RawSpline& spline) {
    error_ = sink_.add(spline);
    return !error_;
  }

  // "dimension rational"
  bool dimension_line(long low, RawSpline& spline) {
    long dimension, flag;
    if (!integer("the dimension of space", low, 3, dimension, ErrorCode::unsupported)) return false;
    if (!integer("the flag for rational", 0, 1, flag)) return false;
    spline.weight_form = flag == 1 ? Weights::homogeneous : Weights::none;
    spline.per_point = static_cast<int>(dimension + flag);
    return true;
  }

  // "count order" and count + order knots.
  bool basis(RawSpline& spline, int direction) {
    long order, &count = spline.count[direction];
    const std::string_view along = spline.along(direction);
    if (!integer(fmt::format("the number of coefficients{}", along), 1, kMaxFileBytes, count, ErrorCode::wrong_count))
      return false;
    const long lowest = spline.is_curve() ? 1 : 2;
    if (!integer(fmt::format("the order{}", along), lowest, kMaxDegree + 1, order, ErrorCode::bad_degree)) return false;
    spline.degree[direction] = order - 1;
    if (count < order)
      return fail(source_.error(ErrorCode::wrong_count, cursor_.last(),
                                fmt::format("fewer coefficients than the order{}", along),
                                fmt::format("{} coefficients, order {}", count, order)));
    if (cursor_.take(static_cast<std::size_t>(count + order), spline.knots[direction])) return true;
    return ended_inside(spline, "knots");
  }

  bool ended_inside(const RawSpline& spline, std::string_view what) {
    error_ = sink_.first_bad_number(spline);
    if (!error_)
      error_ = cursor_.ended(ErrorCode::syntax, fmt::format("the file ends inside the {} of an object", what));
    return false;
  }

  bool coefficients(RawSpline& spline, std::size_t points) {
    return cursor_.take(points * spline.per_point, spline.coordinates) || ended_inside(spline, "coefficients");
  }

  bool spline_surface(RawSpline& patch) {
    patch.has_knots = true;
    patch.u_fastest = true;
    return dimension_line(2, patch) && basis(patch, 0) && basis(patch, 1) &&
           coefficients(patch, static_cast<std::size_t>(patch.count[0]) * patch.count[1]);
  }

  bool spline_curve(RawSpline& curve) {
    curve.directions = 1;
    curve.has_knots = true;
    if (!dimension_line(1, curve) || !basis(curve, 0) || !coefficients(curve, curve.count[0])) return false;
    error_ = sink_.first_bad_number(curve);
    return !error_;
  }

  // 210: a surface, then loops of curves on it. Legal here when the one loop is the rectangle of the domain.
  bool bounded_surface(RawSpline& patch) {
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
    std::vector<RawSpline> loop;
    for (long c = 0; c < curves; ++c) {
      long plane_type, space_type;
      if (!integer("the flag for the preferred curve", 0, 1, ignored)) return false;
      if (!integer("the class of the parameter curve", 0, 99999, plane_type)) return false;
      if (!integer("the class of the space curve", 0, 99999, space_type)) return false;
      if (plane_type != kSplineCurve || (space_type != kSplineCurve && space_type != 0))
        return trimmed(patch, fmt::format("curve classes {} and {}", plane_type, space_type));
      RawSpline space;
      if (!spline_curve(loop.emplace_back())) return false;
      if (space_type == kSplineCurve && !spline_curve(space)) return false;
    }
    return is_whole(patch, loop) || (error_ ? false : trimmed(patch, "a loop inside the domain"));
  }

  bool trimmed(const RawSpline& patch, std::string values) {
    return fail(source_.error(
        ErrorCode::unsupported, patch.at,
        "a trimmed surface: only bounded surfaces whose loop is the border of the domain are read", values));
  }

  // Exactly: every parameter curve stays on one side of the domain's rectangle, each begins where the one before ends, and
  // the loop meets each of the four corners, in the order of one turn.
  bool is_whole(const RawSpline& patch, const std::vector<RawSpline>& loop) {
    std::array<Rational, 2> low, high;
    for (int d = 0; d < 2; ++d)
      if (!value(patch.knots[d][patch.degree[d]], low[d]) || !value(patch.knots[d][patch.count[d]], high[d]))
        return false;
    using Point = std::array<Rational, 2>;
    std::vector<Point> corners;
    Point last, first;
    for (std::size_t c = 0; c < loop.size(); ++c) {
      if (loop[c].weight_form != Weights::none || !is_clamped(loop[c]) || loop[c].per_point != 2) return false;
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
  long functions_ = 0;
};

}  // namespace

std::optional<Error> read_g2(const SourceFile& source, ModelSink& sink) { return G2Reader(source, sink).read(); }

}  // namespace patchproof
