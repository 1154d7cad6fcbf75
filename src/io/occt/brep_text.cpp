// SPDX-License-Identifier: Apache-2.0
#include "brep_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "brep_words.h"

namespace patchproof::occt {
namespace {

class Parser : BrepWords {
 public:
  using BrepWords::BrepWords;

  BrepText read() {
    skip_to_version();
    locations();
    table("Curve2ds", "parameter curve", out_.curves2d, [&] { curve(2); });
    table("Curves", "curve", out_.curves, [&] { curve(3); });
    table("Polygon3D", "polygon", polygons_, [&] { polygon(); });
    table("PolygonOnTriangulations", "polygon on a triangulation", polygons_on_, [&] { polygon_on_triangulation(); });
    table("Surfaces", "surface", out_.surfaces, [&] { surface(); });
    table("Triangulations", "triangulation", triangulations_, [&] { triangulation(); });
    shapes();
    out_.numbers = std::move(replacements_);
    return std::move(out_);
  }

 private:
  int location() { return static_cast<int>(integer("a placement", 0, locations_, ErrorCode::bad_reference)); }

  // Tables.

  void skip_to_version() {
    while (at_ < bytes_.size()) {
      const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
      const std::string_view line = bytes_.substr(at_, end - at_);
      at_ = std::min(end + 1, bytes_.size());
      ++line_;
      if (line.substr(0, 18) != "CASCADE Topology V" || line.size() < 19) continue;
      version_ = line[18] - '0';
      if (version_ >= 1 && version_ <= 3) return;
      stop(ErrorCode::unsupported, "versions 1 to 3 of the BREP format are known, not this one", line);
    }
    line_ = 1;
    stop(ErrorCode::syntax, "there is no line that begins with 'CASCADE Topology V'");
  }

  void heading(const char* name) {
    table_ = name;
    entity_.clear();
    if (const std::string_view text = word(name); text != name)
      stop(ErrorCode::syntax, std::string("the word ") + name + " should stand here", text);
  }

  void locations() {
    heading("Locations");
    const int n = count("a count");
    for (locations_ = 0; locations_ < n; ++locations_) {
      entity_ = fmt::format("placement {}", locations_ + 1);
      if (integer("the kind of a placement", 1, 2) == 1) {
        coordinates(12, "a number of the matrix");
        if (damage_) stop(damage_->code, damage_->reason);
      } else {
        while (integer("a placement, or 0", 0, locations_) != 0) integer("a power", -kMany, kMany);
      }
    }
  }

  template <class ReadOne>
  void table(const char* name, const char* what, std::vector<BrepEntity>& entities, ReadOne read) {
    heading(name);
    const int n = count("a count");
    mends_ = &entities == &polygons_ || &entities == &polygons_on_ || &entities == &triangulations_;
    for (int i = 1; i <= n; ++i) {
      entity_ = fmt::format("{} {}", what, i);
      damage_.reset();
      skip_space();
      BrepEntity entity{at_, at_, line_, std::nullopt};
      read();
      entity.end = at_;
      entity.damage = std::move(damage_);
      damage_.reset();
      entities.push_back(std::move(entity));
    }
  }

  // Curves, of 2 or 3 coordinates, and surfaces.

  void direction(int dimension) {
    double square = 0;
    for (int i = 0; i < dimension; ++i) {
      const double x = number(Number::coordinate, [] { return "a direction"; });
      square += x * x;
    }
    if (!(square > 0)) note(ErrorCode::unsupported, "a direction is zero");
  }
  void axes(int dimension) {
    coordinates(dimension, "a coordinate");
    for (int i = 0; i < dimension; ++i) direction(dimension);
  }
  void radius() {
    if (number(Number::coordinate, [] { return "a radius"; }) < 0) note(ErrorCode::unsupported, "a radius is negative");
  }

  void control_point(int dimension, bool rational, int i, int j = 0) {
    const auto name = [&](const char* what) {
      return j > 0 ? fmt::format("{} of control point ({}, {})", what, i, j)
                   : fmt::format("{} of control point {}", what, i);
    };
    for (int c = 0; c < dimension; ++c) number(Number::coordinate, [&] { return name("a coordinate"); });
    if (rational) number(Number::positive, [&] { return name("the weight"); });
  }
  void knots(int n, const char* along) {
    double before = -HUGE_VAL;
    for (int i = 1; i <= n; ++i) {
      const double knot = number(Number::coordinate, [&] { return fmt::format("knot {}{}", i, along); });
      if (!damage_ && !(knot > before))
        note(ErrorCode::decreasing_knots,
             fmt::format("knot {}{} is not above the one before it: {} after {}", i, along, knot, before));
      before = knot;
      integer("a multiplicity", 0, kMany);
    }
  }

  void curve(int dimension) {
    switch (integer("the kind of a curve, 1 to 9,", 1, 9)) {
      case 1: coordinates(dimension, "a coordinate"); return direction(dimension);
      case 2: axes(dimension); return radius();
      case 3:
      case 5:
        axes(dimension);
        radius();
        return radius();
      case 4: axes(dimension); return radius();
      case 6: {
        const bool rational = flag("whether a curve is rational");
        const int degree = count("a degree");
        for (int i = 1; i <= degree + 1; ++i) control_point(dimension, rational, i);
        return;
      }
      case 7: {
        const bool rational = flag("whether a curve is rational");
        flag("whether a curve is periodic");
        count("a degree");
        const int poles = count("a count"), distinct = count("a count");
        for (int i = 1; i <= poles; ++i) control_point(dimension, rational, i);
        return knots(distinct, "");
      }
      case 8: numbers(2, Number::parameter, "a bound of its range"); return basis([&] { curve(dimension); });
      case 9:
        coordinates(1, "a distance");
        if (dimension == 3) direction(3);
        return basis([&] { curve(dimension); });
    }
  }

  void surface() {
    switch (integer("the kind of a surface, 1 to 11,", 1, 11)) {
      case 1: return axes(3);
      case 2:
      case 4: axes(3); return radius();
      case 3:
        axes(3);
        radius();
        return coordinates(1, "an angle");
      case 5:
        axes(3);
        radius();
        return radius();
      case 6: direction(3); return basis([&] { curve(3); });
      case 7:
        coordinates(3, "a coordinate");
        direction(3);
        return basis([&] { curve(3); });
      case 8: {
        const bool u = flag("whether a surface is rational"), v = flag("whether a surface is rational");
        const int p = count("a degree"), q = count("a degree");
        return net(p + 1, q + 1, u || v);
      }
      case 9: {
        const bool u = flag("whether a surface is rational"), v = flag("whether a surface is rational");
        for (int i = 0; i < 2; ++i) flag("whether a surface is periodic");
        for (int i = 0; i < 2; ++i) count("a degree");
        const int rows = count("a count"), columns = count("a count");
        const int along_u = count("a count"), along_v = count("a count");
        net(rows, columns, u || v);
        knots(along_u, " along u");
        return knots(along_v, " along v");
      }
      case 10: numbers(4, Number::parameter, "a bound of its range"); return basis([&] { surface(); });
      case 11: coordinates(1, "a distance"); return basis([&] { surface(); });
    }
  }
  void net(int rows, int columns, bool rational) {
    for (int i = 1; i <= rows; ++i)
      for (int j = 1; j <= columns; ++j) control_point(3, rational, i, j);
  }
  template <class Read>
  void basis(Read read) {
    if (++nested_ > kDeepest) stop(ErrorCode::syntax, "curves and surfaces are nested too deeply");
    read();
    --nested_;
  }

  // Polygons and triangles.

  void polygon() {
    const int n = count("a count");
    const bool parameters = flag("whether there are parameters");
    numbers(1, Number::parameter, "a deflection");
    for (int i = 0; i < n; ++i) numbers(parameters ? 4 : 3, Number::parameter, "a coordinate");
  }
  void polygon_on_triangulation() {
    const int n = count("a count");
    for (int i = 0; i < n; ++i) integer("a node", 0, kMany);
    if (const std::string_view p = word("p"); p != "p") stop(ErrorCode::syntax, "the word p should stand here", p);
    numbers(1, Number::parameter, "a deflection");
    if (flag("whether there are parameters"))
      for (int i = 0; i < n; ++i) numbers(1, Number::parameter, "a parameter");
  }
  void triangulation() {
    const int nodes = count("a count"), triangles = count("a count");
    const bool parameters = flag("whether there are parameters"),
               normals = version_ == 3 && flag("whether there are normals");
    numbers(1, Number::parameter, "a deflection");
    for (int i = 0; i < nodes; ++i) numbers(parameters ? 5 : 3, Number::parameter, "a coordinate");
    for (int i = 0; i < triangles; ++i)
      for (int k = 0; k < 3; ++k) integer("a node", 0, kMany);
    for (int i = 0; normals && i < nodes; ++i) numbers(3, Number::parameter, "a normal");
  }

  // Shapes.

  void shapes() {
    heading("TShapes");
    const int n = count("a count");
    mends_ = true;
    for (int i = 0; i < n; ++i) {
      const std::string_view kind = word("the kind of a shape");
      const auto kinds = {"Ve", "Ed", "Wi", "Fa", "Sh", "So", "CS", "Co"};
      entity_ = fmt::format("shape {}", i + 1);
      if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
        stop(ErrorCode::syntax, "a kind of shapes should stand here", kind);
      BrepShape shape{std::string(kind), {}, {}, 0, {}, {}};
      entity_ += kind == "Ve" ? ", a vertex" : kind == "Ed" ? ", an edge" : kind == "Fa" ? ", a face" : "";
      damage_.reset();
      if (kind == "Ve") vertex();
      if (kind == "Ed") edge(shape);
      if (kind == "Fa") face(shape);
      shape.damage = std::move(damage_);
      damage_.reset();
      if (const std::string_view flags = word("seven flags");
          flags.size() != 7 || flags.find_first_not_of("01") != std::string_view::npos)
        stop(ErrorCode::syntax, "seven flags should stand here", flags);
      while (const int part = reference(n, i)) shape.parts.push_back(n - part);
      out_.shapes.push_back(std::move(shape));
    }
    entity_ = "the whole";
    reference(n, n);
  }

  // "+3 0", counted from the end of the table; 0 for the end of a list.
  int reference(int n, int read) {
    std::string_view text = word("a part, or *,");
    if (text[0] == '*') return 0;
    const std::string_view whole = text;
    int number = 0;
    const auto [end, failure] = std::from_chars(text.data() + 1, text.data() + text.size(), number);
    if (std::string_view("+-ie").find(text[0]) == std::string_view::npos || failure != std::errc() ||
        end != text.data() + text.size())
      stop(ErrorCode::syntax, "a part of a shape should stand here", whole);
    if (number < 1 || number > n || n - number >= read)
      stop(ErrorCode::bad_reference, "no shape with this number stands before this one", whole);
    location();
    return number;
  }

  void vertex() {
    numbers(1, Number::parameter, "its tolerance");
    coordinates(3, "a coordinate");
    for (;;) {
      numbers(1, Number::parameter, "a parameter");
      switch (integer("the kind of a point", 0, 3)) {
        case 0: return;
        case 1: index("a curve", out_.curves); break;
        case 2: index("a parameter curve", out_.curves2d), index("a surface", out_.surfaces); break;
        case 3: numbers(1, Number::parameter, "a parameter"), index("a surface", out_.surfaces); break;
      }
      location();
    }
  }

  void edge(BrepShape& shape) {
    numbers(1, Number::parameter, "its tolerance");
    for (int i = 0; i < 3; ++i) flag("a flag of an edge");
    for (;;) {
      const long kind = integer("the kind of a curve of an edge", 0, 7);
      switch (kind) {
        case 0: return;
        case 1:
          shape.curves.push_back(index("a curve", out_.curves));
          location();
          numbers(2, Number::parameter, "a bound of its range");
          break;
        case 2:
        case 3: {
          BrepParameters first{index("a parameter curve", out_.curves2d), 0}, second{};
          if (kind == 3) second.curve = index("a parameter curve", out_.curves2d), word("a class of continuity");
          first.surface = second.surface = index("a surface", out_.surfaces);
          location();
          numbers(version_ == 2 ? 6 : 2, Number::parameter, "a bound of its range");
          shape.parameters.push_back(first);
          if (kind == 3) shape.parameters.push_back(second);
          break;
        }
        case 4:
          word("a class of continuity");
          for (int i = 0; i < 2; ++i) index("a surface", out_.surfaces), location();
          break;
        case 5: index("a polygon", polygons_), location(); break;
        case 6:
        case 7:
          index("a polygon on a triangulation", polygons_on_);
          if (kind == 7) index("a polygon on a triangulation", polygons_on_);
          index("a triangulation", triangulations_);
          location();
          break;
      }
    }
  }

  void face(BrepShape& shape) {
    if (integer("the kind of a face", 0, 2) == 2) {
      index("a triangulation", triangulations_);
      return;
    }
    numbers(1, Number::parameter, "its tolerance");
    shape.surface = index("a surface", out_.surfaces);
    location();
    if (coming() != "2") return;
    word("2");
    index("a triangulation", triangulations_);
  }

  static constexpr int kDeepest = 100;

  int version_ = 1, locations_ = 0, nested_ = 0;
  std::vector<BrepEntity> polygons_, polygons_on_, triangulations_;
  BrepText out_;
};

}  // namespace

Result<BrepText> check_brep_text(const std::string& path, std::string_view bytes) {
  try {
    return Parser(path, bytes).read();
  } catch (const Stop& stop) {
    return stop.error;
  }
}

}  // namespace patchproof::occt
