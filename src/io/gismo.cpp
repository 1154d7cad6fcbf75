// SPDX-License-Identifier: Apache-2.0
// G+Smo's XML: <Geometry type="BSpline|Nurbs|TensorBSpline2|TensorNurbs2"> elements, and <MultiPatch> elements that name
// some of them.
// The first parameter runs fastest; weights stand apart and are not multiplied into the coefficients. Declared interfaces
// are often incomplete in real files, so joins are left to the geometry.
#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cstring>
#include <set>

#include "raw_spline.h"
#include "text_cursor.h"

namespace patchproof {
namespace {

class GismoReader {
 public:
  GismoReader(const SourceFile& source, ModelSink& sink) : source_(source), sink_(sink) {}

  std::optional<Error> read() {
    if (const std::size_t nul = source_.bytes.find('\0'); nul != std::string_view::npos)  // the parser would stop there
      return source_.error(ErrorCode::syntax, source_.bytes.substr(nul), "a zero byte in an XML file");
    // Without translation of line ends and entities every text is found again in the bytes of the file.
    const pugi::xml_parse_result parsed =
        document_.load_buffer(source_.bytes.data(), source_.bytes.size(), pugi::parse_cdata, pugi::encoding_utf8);
    if (!parsed)
      return source_.error(ErrorCode::syntax,
                           source_.bytes.substr(std::min<std::size_t>(parsed.offset, source_.bytes.size())),
                           fmt::format("this is not well-formed XML: {}", parsed.description()));
    const pugi::xml_node root = document_.child("xml");
    if (!root)
      return source_.error(ErrorCode::unknown_format, source_.bytes, "an XML file whose root element is not <xml>");
    for (const pugi::xml_node node : root.children("Geometry"))
      if (!geometry(node)) return error_;
    for (const pugi::xml_node node : root.children("MultiPatch"))
      if (!multi_patch(node)) return error_;
    if (sink_.patch_count() == 0 && sink_.curve_count() == 0)
      return source_.error(ErrorCode::unsupported, source_.bytes,
                           "the file holds no <Geometry> that is a curve or a surface");
    if (functions_ > 0)
      sink_.notes.push_back(fmt::format("{} curve{} of dimension 1 skipped", functions_, functions_ == 1 ? "" : "s"));
    if (interfaces_) sink_.notes.emplace_back("declared interfaces are not used: joins are found from the geometry");
    return std::nullopt;
  }

 private:
  bool fail(ErrorCode code, pugi::xml_node at, std::string message, std::string_view values = {}) {
    error_ = source_.error(code, view(at), std::move(message), values);
    return false;
  }

  // Where an element stands in the file.
  std::string_view view(pugi::xml_node node) const {
    const std::ptrdiff_t offset = node.offset_debug();
    return offset < 0 ? source_.bytes.substr(0, 0) : source_.bytes.substr(static_cast<std::size_t>(offset));
  }

  // The words of an element's text, as views into the file.
  std::vector<std::string_view> words(pugi::xml_node node) const {
    std::vector<std::string_view> out;
    for (const pugi::xml_node part : node.children()) {
      const std::ptrdiff_t offset = part.offset_debug();
      if ((part.type() != pugi::node_pcdata && part.type() != pugi::node_cdata) || offset < 0) continue;
      const SourceFile text{source_.path,
                            source_.bytes.substr(static_cast<std::size_t>(offset), std::strlen(part.value()))};
      TextCursor cursor(text, TextCursor::Comments::none);
      for (std::string_view word = cursor.next(); !word.empty(); word = cursor.next()) out.push_back(word);
    }
    return out;
  }

  bool integer(pugi::xml_node node, const char* attribute, long& value) {
    const pugi::xml_attribute found = node.attribute(attribute);
    if (!found) return fail(ErrorCode::syntax, node, fmt::format("<{}> has no attribute {}", node.name(), attribute));
    const std::optional<long> read = to_integer(found.value());
    if (!read)
      return fail(ErrorCode::syntax, node, fmt::format("{} should be a whole number", attribute), found.value());
    value = *read;
    return true;
  }

  bool geometry(pugi::xml_node node) {
    const std::string_view type = node.attribute("type").value();
    const std::string_view id = node.attribute("id").value();
    if (!id.empty() && !ids_.insert(std::string(id)).second)
      return fail(ErrorCode::bad_reference, node, "two geometries with the same id", id);
    const bool is_curve = type == "BSpline" || type == "Nurbs", rational = type == "Nurbs" || type == "TensorNurbs2";
    if (!is_curve && !rational && type != "TensorBSpline2")
      return fail(ErrorCode::unsupported, node,
                  "only geometries of type BSpline, Nurbs, TensorBSpline2 and TensorNurbs2 are read", type);

    RawSpline spline;
    spline.directions = is_curve ? 1 : 2;
    spline.name = id;
    spline.at = view(node);
    spline.u_fastest = !is_curve;
    spline.has_knots = true;
    pugi::xml_node basis = node.child("Basis");
    if (rational) {
      const pugi::xml_node weights = basis.child("weights");
      if (!weights) return fail(ErrorCode::syntax, basis ? basis : node, fmt::format("a {} without <weights>", type));
      spline.weights = words(weights);
      spline.weight_form = Weights::separate;
      basis = basis.child("Basis");
    }
    if (!basis) return fail(ErrorCode::syntax, node, "a <Geometry> without <Basis>");
    if (is_curve ? !knots(basis, spline, 0) : !tensor_knots(basis, spline)) return false;

    const pugi::xml_node coefficients = node.child("coefs");
    if (!coefficients) return fail(ErrorCode::syntax, node, "a <Geometry> without <coefs>");
    long dimension;
    if (!integer(coefficients, "geoDim", dimension)) return false;
    if (is_curve && dimension == 1) return ++functions_, true;
    if (dimension != 2 && dimension != 3)
      return fail(ErrorCode::unsupported, coefficients, "only geoDim 2 and 3 are read", std::to_string(dimension));
    spline.per_point = static_cast<int>(dimension);
    spline.coordinates = words(coefficients);
    error_ = sink_.add(spline);
    return !error_;
  }

  // <KnotVector degree="…"> inside a basis of one direction.
  bool knots(pugi::xml_node basis, RawSpline& spline, int direction) {
    const pugi::xml_node knots = basis.child("KnotVector");
    if (!knots) return fail(ErrorCode::syntax, basis, "a <Basis> without <KnotVector>");
    long& degree = spline.degree[direction];
    if (!integer(knots, "degree", degree)) return false;
    spline.knots[direction] = words(knots);
    // Control points are not counted in this format: knots and degree say how many there must be.
    spline.count[direction] = 1;
    if (degree >= 0 && degree <= kMaxDegree)  // others are refused by the builder
      spline.count[direction] = static_cast<long>(spline.knots[direction].size()) - degree - 1;
    return true;
  }

  // The two <Basis type="BSplineBasis" index="…"> inside a tensor basis.
  bool tensor_knots(pugi::xml_node tensor, RawSpline& patch) {
    std::array<bool, 2> seen{};
    int position = 0;
    for (const pugi::xml_node basis : tensor.children("Basis")) {
      long index = position++;
      if (basis.attribute("index") && !integer(basis, "index", index)) return false;
      if (index < 0 || index > 1 || seen[index])
        return fail(ErrorCode::syntax, basis, "a tensor basis has the indices 0 and 1, once each",
                    std::to_string(index));
      seen[index] = true;
      if (!knots(basis, patch, static_cast<int>(index))) return false;
    }
    if (seen[0] && seen[1]) return true;
    return fail(ErrorCode::syntax, tensor, "a tensor basis needs two <Basis> elements");
  }

  // Every patch that a <MultiPatch> names must exist.
  bool multi_patch(pugi::xml_node node) {
    interfaces_ = interfaces_ || !words(node.child("interfaces")).empty();
    const pugi::xml_node patches = node.child("patches");
    const std::vector<std::string_view> texts = words(patches);
    std::vector<long> named;
    for (const std::string_view text : texts) {
      const std::optional<long> value = to_integer(text);
      if (!value) return fail(ErrorCode::syntax, patches, "an id should be a whole number", text);
      named.push_back(*value);
    }
    if (std::string_view(patches.attribute("type").value()) == "id_range") {
      if (named.size() != 2 || named[0] > named[1])
        return fail(ErrorCode::syntax, patches, "an id_range needs its first and its last id");
      const long first = named[0], last = named[1];
      named.clear();
      // One id more than there are geometries is enough to find a missing one.
      for (long id = first; id <= last && named.size() <= ids_.size(); ++id) named.push_back(id);
    }
    for (const long id : named)
      if (!ids_.contains(std::to_string(id)))
        return fail(ErrorCode::bad_reference, patches, "the multipatch names a geometry that is not there",
                    std::to_string(id));
    return true;
  }

  const SourceFile& source_;
  ModelSink& sink_;
  pugi::xml_document document_;
  std::optional<Error> error_;
  std::set<std::string> ids_;
  long functions_ = 0;
  bool interfaces_ = false;
};

}  // namespace

std::optional<Error> read_gismo(const SourceFile& source, ModelSink& sink) { return GismoReader(source, sink).read(); }

}  // namespace patchproof
