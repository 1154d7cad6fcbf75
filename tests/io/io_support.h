// SPDX-License-Identifier: Apache-2.0
// What the tests of readers and writers share: the good files of tests/data, tiny models as text, exact comparison.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "patchproof/io/read.h"

namespace patchproof::test {

inline Rational exact(const std::string& text) { return parse_scalar<Rational>(text).value(); }

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

inline std::vector<std::filesystem::path> data_files(const std::string& prefix) {
  std::vector<std::filesystem::path> out;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::filesystem::path(PATCHPROOF_SOURCE_DIR) / "tests/data"))
    if (entry.is_regular_file() && entry.path().filename().string().rfind(prefix, 0) == 0) out.push_back(entry.path());
  std::sort(out.begin(), out.end());
  if (out.size() < 7) throw std::runtime_error("tests/data lacks files that begin with " + prefix);
  return out;
}
inline std::vector<std::filesystem::path> good_files() { return data_files("good_"); }

// Throws with the error's text.
inline ModelFile read_good(const std::string& bytes, const std::string& path, Decimals decimals = Decimals::exact) {
  Result<ModelFile> file = read_model_text(bytes, path, decimals);
  if (!file) throw std::runtime_error(file.error().text());
  return std::move(file).value();
}

inline const Model<Rational>& rational_model(const ModelFile& file) { return std::get<Model<Rational>>(file.model); }

template <class T>
bool same(const Model<T>& a, const Model<T>& b) {
  const auto same_patch = [](const ModelPatch<T>& p, const ModelPatch<T>& q) {
    return p.name == q.name && p.is_rational == q.is_rational && p.surface.net() == q.surface.net() &&
           p.surface.knots(Direction::u) == q.surface.knots(Direction::u) &&
           p.surface.knots(Direction::v) == q.surface.knots(Direction::v);
  };
  const auto same_curve = [](const ModelCurve<T>& p, const ModelCurve<T>& q) {
    return p.name == q.name && p.is_rational == q.is_rational && p.dimension == q.dimension &&
           p.curve.points() == q.curve.points() && p.curve.knots() == q.curve.knots();
  };
  const auto same_join = [](const DeclaredJoin& p, const DeclaredJoin& q) {
    return p.patch_a == q.patch_a && p.patch_b == q.patch_b && p.edge_a == q.edge_a && p.edge_b == q.edge_b &&
           p.reversed == q.reversed;
  };
  return a.units == b.units &&
         std::equal(a.curves.begin(), a.curves.end(), b.curves.begin(), b.curves.end(), same_curve) &&
         std::equal(a.patches.begin(), a.patches.end(), b.patches.begin(), b.patches.end(), same_patch) &&
         std::equal(a.joins.begin(), a.joins.end(), b.joins.begin(), b.joins.end(), same_join);
}

using AnyModel = std::variant<Model<Rational>, Model<Quadratic>>;
inline bool same_model(const AnyModel& a, const AnyModel& b) {
  if (a.index() != b.index()) return false;
  return a.index() == 0 ? same(std::get<0>(a), std::get<0>(b)) : same(std::get<1>(a), std::get<1>(b));
}
// Curves and patches.
inline std::size_t spline_count(const AnyModel& model) {
  return std::visit([](const auto& m) { return m.curves.size() + m.patches.size(); }, model);
}

// A model of one patch in our JSON; `more` is appended inside the patch.
inline std::string json_patch(const std::string& net, const std::string& more = "",
                              const std::string& degree = "[1,1]") {
  return "{\"format\":\"patchproof-model\",\"version\":1,\n\"patches\":[\n{\"degree\":" + degree +
         ",\n\"control_points\":" + net + more + "\n}\n]}";
}
inline const std::string kSquare = "[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]]]";

// A model of one curve in our JSON, in the plane unless `points` say otherwise.
inline std::string json_curve(const std::string& points, const std::string& more = "",
                              const std::string& degree = "2") {
  return "{\"format\":\"patchproof-model\",\"version\":1,\n\"curves\":[\n{\"degree\":" + degree +
         ",\n\"control_points\":" + points + more + "\n}\n]}";
}
inline const std::string kArc = "[[0,0],[1,1],[2,0]]";

// One bilinear G+Smo patch, rational when weights are given.
inline std::string gismo_patch(const std::string& coefficients, const std::string& weights = "",
                               const std::string& knots = "0 0 1 1", const std::string& dimension = "3") {
  std::string basis =
      "<Basis type=\"TensorBSplineBasis2\">\n<Basis type=\"BSplineBasis\" index=\"0\">\n<KnotVector degree=\"1\">" +
      knots + "</KnotVector></Basis>\n<Basis type=\"BSplineBasis\" index=\"1\"><KnotVector degree=\"1\">0 0 1 1" +
      "</KnotVector></Basis>\n</Basis>\n";
  if (!weights.empty()) basis = "<Basis>" + basis + "<weights>" + weights + "</weights></Basis>\n";
  return "<?xml version=\"1.0\"?>\n<xml>\n<Geometry type=\"" +
         std::string(weights.empty() ? "TensorBSpline2" : "TensorNurbs2") + "\" id=\"0\">\n" + basis +
         "<coefs geoDim=\"" + dimension + "\">" + coefficients + "</coefs>\n</Geometry>\n</xml>\n";
}

}  // namespace patchproof::test
