// SPDX-License-Identifier: Apache-2.0
// Free-form curves and surfaces in OBJ files: curv and surf of cstype bezier and bspline, rational or not. Vertices are points
// in space, their fourth number is the weight and not multiplied into them; the first parameter runs fastest.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "patchproof/scalar/parse_scalar.h"
#include "raw_spline.h"
#include "text_cursor.h"

namespace patchproof {
namespace {

using Words = std::vector<std::string_view>;

constexpr std::string_view kDisplay[] = {"vt",    "vn",       "mg",       "s",      "mtllib",     "usemtl",
                                         "bevel", "c_interp", "d_interp", "lod",    "shadow_obj", "trace_obj",
                                         "ctech", "stech",    "maplib",   "usemap", "step"};
constexpr std::string_view kTrimming[] = {"trim", "hole", "scrv", "sp"};

template <std::size_t N>
bool is_one_of(std::string_view word, const std::string_view (&list)[N]) {
  return std::find(std::begin(list), std::end(list), word) != std::end(list);
}

class ObjReader {
 public:
  ObjReader(const SourceFile& source, ModelSink& sink)
      : source_(source), sink_(sink), cursor_(source, TextCursor::Comments::hash) {}

  std::optional<Error> read() {
    while (!error_ && next_statement()) statement();
    if (error_) return error_;
    if (element_) return cursor_.ended(ErrorCode::syntax, fmt::format("the file ends inside a {}", element_->keyword));
    if (sink_.patch_count() == 0 && sink_.curve_count() == 0)
      return cursor_.ended(ErrorCode::unsupported,
                           "the OBJ file holds no free-form curve or surface (polygons are not read)");
    const auto note = [&](std::size_t count, std::string_view what) {
      if (count > 0) sink_.notes.push_back(fmt::format("{} {} skipped", count, what));
    };
    note(polygons_, "points, lines and faces");
    note(connections_, "connections of surfaces (con)");
    note(plane_curves_, "curves in parameter planes (curv2)");
    return std::nullopt;
  }

 private:
  struct Element {
    std::string_view keyword;  // "curv", "surf", "curv2"
    std::string_view at;
    Words range;  // first and last parameter, of each direction
    Words vertices;
    std::array<Words, 2> parameters;
    bool rational, bezier;
    std::array<long, 2> degree;
    std::string name;
  };

  bool fail(ErrorCode code, std::string_view at, std::string message) {
    error_ = source_.error(code, at, std::move(message), at);
    return false;
  }

  // A line, with those that follow a backslash.
  bool next_statement() {
    words_.clear();
    bool continued = true;
    while (continued) {
      const std::string_view line = cursor_.next_line();
      if (line.empty()) break;
      const SourceFile text{"", line};
      TextCursor words(text, TextCursor::Comments::none);
      for (std::string_view word = words.next(); !word.empty(); word = words.next()) words_.push_back(word);
      continued = words_.back().ends_with('\\');
      if (continued) words_.back().remove_suffix(1);
      if (words_.back().empty()) words_.pop_back();
    }
    return !words_.empty();
  }

  bool statement() {
    const std::string_view keyword = words_.front();
    if (keyword == "v" || keyword == "vp") return keyword == "vp" || vertex();
    if (is_one_of(keyword, kDisplay)) return true;
    if (keyword == "o" || keyword == "g") return name_ = words_.size() > 1 ? std::string(words_[1]) : "", true;
    if (keyword == "f" || keyword == "l" || keyword == "p") return ++polygons_, true;
    if (keyword == "con") return ++connections_, true;
    if (keyword == "cstype") return curve_type();
    if (keyword == "deg") return degree();
    if (keyword == "bmat") return fail(ErrorCode::unsupported, keyword, "basis matrices are not read");
    if (keyword == "curv" || keyword == "surf" || keyword == "curv2") return begin(keyword);
    if (keyword == "parm") return parameters();
    if (keyword == "end") return end();
    if (is_one_of(keyword, kTrimming)) {
      if (element_ && element_->keyword == "surf")
        return fail(ErrorCode::unsupported, keyword, "a trimmed surface, or one with special curves, is not read");
      return element_ ? true : fail(ErrorCode::syntax, keyword, "outside of an element");
    }
    return fail(ErrorCode::syntax, keyword, "not a statement of OBJ files");
  }

  struct Vertex {
    std::array<std::string_view, 3> point;
    std::string_view weight;
  };

  // x y z [w], or x y z r g b.
  bool vertex() {
    if (words_.size() < 4) return fail(ErrorCode::wrong_count, words_.front(), "a vertex has at least three numbers");
    points_.push_back({{words_[1], words_[2], words_[3]}, words_.size() == 5 ? words_[4] : "1"});
    return true;
  }

  bool curve_type() {
    rational_ = words_.size() > 2 && words_[1] == "rat";
    const std::string_view type = words_.back();
    bezier_ = type == "bezier";
    typed_ = bezier_ || type == "bspline";
    return typed_ || fail(ErrorCode::unsupported, type, "only cstype bezier and bspline are read");
  }

  bool degree() {
    if (words_.size() < 2) return fail(ErrorCode::syntax, words_.front(), "a degree is missing");
    degree_ = {0, 0};
    for (std::size_t d = 0; d < 2 && d + 1 < words_.size(); ++d) {
      const std::optional<long> value = to_integer(words_[d + 1]);
      if (!value) return fail(ErrorCode::syntax, words_[d + 1], "a degree should be a whole number");
      if (*value < 1 || *value > kMaxDegree)
        return fail(ErrorCode::bad_degree, words_[d + 1], fmt::format("degrees are from 1 to {}", kMaxDegree));
      degree_[d] = *value;
    }
    return true;
  }

  bool begin(std::string_view keyword) {
    if (element_)
      return fail(ErrorCode::syntax, keyword, fmt::format("inside a {}: its end is missing", element_->keyword));
    const std::size_t bounds = keyword == "surf" ? 4 : keyword == "curv" ? 2 : 0;
    if (!typed_) return fail(ErrorCode::syntax, keyword, "no cstype stands before it");
    if (degree_[0] == 0 || (keyword == "surf" && degree_[1] == 0))
      return fail(ErrorCode::bad_degree, keyword, "no degree stands before it");
    if (words_.size() <= bounds + 1) return fail(ErrorCode::wrong_count, keyword, "it has no control points");
    element_.emplace(Element{keyword, keyword, {}, {}, {}, rational_, bezier_, degree_, name_});
    element_->range.assign(words_.begin() + 1, words_.begin() + 1 + static_cast<long>(bounds));
    element_->vertices.assign(words_.begin() + 1 + static_cast<long>(bounds), words_.end());
    return true;
  }

  bool parameters() {
    if (!element_) return fail(ErrorCode::syntax, words_.front(), "outside of an element");
    if (words_.size() < 4 || (words_[1] != "u" && words_[1] != "v"))
      return fail(ErrorCode::syntax, words_.front(), "u or v and at least two parameters should follow");
    Words& out = element_->parameters[words_[1] == "v"];
    if (!out.empty()) return fail(ErrorCode::syntax, words_[1], "its parameters stand twice");
    out.assign(words_.begin() + 2, words_.end());
    return true;
  }

  bool end() {
    if (!element_) return fail(ErrorCode::syntax, words_.front(), "outside of an element");
    const Element element = std::move(*element_);
    element_.reset();
    if (element.keyword == "curv2") return ++plane_curves_, true;
    RawSpline spline;
    spline.at = element.at;
    spline.name = element.name;
    spline.directions = element.keyword == "surf" ? 2 : 1;
    spline.has_knots = true;
    spline.u_fastest = true;
    spline.weight_form = element.rational ? Weights::separate : Weights::none;
    spline.count = {1, 1};
    for (int d = 0; d < spline.directions; ++d)
      if (!direction(element, d, spline)) return false;
    const std::size_t needed = static_cast<std::size_t>(spline.count[0]) * static_cast<std::size_t>(spline.count[1]);
    if (element.vertices.size() != needed)
      return fail(
          ErrorCode::wrong_count, element.at,
          fmt::format("degrees and parameters need {} control points, {} are given", needed, element.vertices.size()));
    for (const std::string_view reference : element.vertices)
      if (!control_point(reference, spline)) return false;
    error_ = sink_.add(spline);
    return !error_;
  }

  // Knots and number of control points. Of Bézier pieces the parameters are where they meet.
  bool direction(const Element& element, int d, RawSpline& spline) {
    const Words& parameters = element.parameters[d];
    const long degree = spline.degree[d] = element.degree[d];
    if (parameters.empty())
      return fail(ErrorCode::syntax, element.at,
                  fmt::format("its parameters along {} are missing", d == 0 ? "u" : "v"));
    Words& knots = spline.knots[d];
    if (element.bezier) {
      knots.push_back(parameters.front());
      for (const std::string_view t : parameters) knots.insert(knots.end(), static_cast<std::size_t>(degree), t);
      knots.push_back(parameters.back());
    } else {
      knots = parameters;
    }
    const long count = static_cast<long>(knots.size()) - degree - 1;
    if (count < degree + 1)
      return fail(ErrorCode::wrong_count, parameters.front(),
                  fmt::format("degree {} needs at least {} knots, {} are given", degree, 2 * degree + 2, knots.size()));
    spline.count[d] = count;
    // The element may be only a part of what its knots say.
    for (const auto& [bound, knot] :
         {std::pair(element.range[2 * d], knots[degree]), {element.range[2 * d + 1], knots[count]}}) {
      const Result<Rational> asked = parse_scalar<Rational>(bound), domain = parse_scalar<Rational>(knot);
      if (!asked) return fail(asked.error().code, bound, asked.error().message);
      if (!domain) return fail(domain.error().code, knot, domain.error().message);
      if (*asked != *domain)
        return fail(ErrorCode::unsupported, bound,
                    fmt::format("only whole curves and surfaces are read: the domain ends at {}", knot));
    }
    return true;
  }

  // "7", "-1", "7/2/3": of vertex, texture and normal only the vertex counts. Negative: from the last vertex on.
  bool control_point(std::string_view reference, RawSpline& spline) {
    const std::optional<long> index = to_integer(reference.substr(0, reference.find('/')));
    if (!index) return fail(ErrorCode::syntax, reference, "a vertex number should stand here");
    const long count = static_cast<long>(points_.size()), place = *index < 0 ? count + *index : *index - 1;
    if (place < 0 || place >= count)
      return fail(ErrorCode::bad_reference, reference, fmt::format("{} vertices stand before it", count));
    const Vertex& vertex = points_[static_cast<std::size_t>(place)];
    spline.coordinates.insert(spline.coordinates.end(), vertex.point.begin(), vertex.point.end());
    if (spline.weight_form == Weights::separate) spline.weights.push_back(vertex.weight);
    return true;
  }

  const SourceFile& source_;
  ModelSink& sink_;
  TextCursor cursor_;
  Words words_;
  std::optional<Error> error_;
  std::vector<Vertex> points_;
  std::optional<Element> element_;
  bool typed_ = false, rational_ = false, bezier_ = false;
  std::array<long, 2> degree_{};
  std::string name_;
  std::size_t polygons_ = 0, connections_ = 0, plane_curves_ = 0;
};

}  // namespace

std::optional<Error> read_obj(const SourceFile& source, ModelSink& sink) { return ObjReader(source, sink).read(); }

}  // namespace patchproof
