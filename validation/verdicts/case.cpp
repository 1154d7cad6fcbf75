// SPDX-License-Identifier: Apache-2.0
#include "validation/verdicts/case.h"

#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "patchproof/scalar/parse_scalar.h"

namespace patchproof::verdicts {
namespace {

using nlohmann::json;

Rational number(const json& text) { return parse_scalar<Rational>(text.get<std::string>()).value(); }

std::array<Rational, 2> range(const json& given) {
  return given.is_array() ? std::array<Rational, 2>{number(given.at(0)), number(given.at(1))}
                          : std::array<Rational, 2>{number(given), number(given)};
}

Truth truth_of(const json& given) {
  Truth truth;
  for (const char* name : {"C0", "C1", "C2", "G1"}) {
    truth.classes[name] = given.at(name).get<std::string>();
    if (truth.classes[name] != "proven" && truth.classes[name] != "refuted")
      throw std::invalid_argument(std::string(name) + " is neither proven nor refuted");
  }
  truth.orientation = given.value("orientation", "");
  truth.one_polynomial = given.value("one_polynomial", false);
  truth.gap = range(given.at("gap"));
  truth.angle = range(given.at("angle"));
  if (given.contains("rounded_angle_below")) truth.rounded_angle_below = given["rounded_angle_below"].get<double>();
  return truth;
}

Result<Case> case_of(const json& given, const std::filesystem::path& root, const CaseOptions& options) {
  Case out;
  out.id = given.at("id");
  out.title = given.at("title");
  out.state = given.at("state");
  out.note = given.value("note", "");
  out.truth = truth_of(given.at("true"));
  const json& occt = given.at("occt");
  out.edge_tolerance = occt.value("edge_tolerance", 1e-7);
  for (const json& name : occt.at("wrong"))
    out.wrong.at(name == "BRepLib" ? 0 : name == "LocalAnalysis" ? 1 : 2) = true;
  const CaseOptions usual;
  if (given.contains("model") || (options.seed == usual.seed && options.count == usual.count)) {
    const json& recorded = occt.at("7.6");
    out.recorded =
        Answers{recorded.at("ContinuityOfFaces"), recorded.at("EncodeRegularity"), recorded.at("LocalAnalysis")};
  }
  if (given.contains("model")) {
    Result<Shape> shape = read_shape((root / given["model"].get<std::string>()).string());
    if (!shape) return shape.error();
    out.shapes.push_back(std::move(*shape));
    return out;
  }
  const json& splits = given.at("random_splits");
  out.shapes = random_splits(options.seed, options.count, number(splits.at("scale")), number(splits.at("offset")));
  return out;
}

}  // namespace

Result<std::vector<Case>> read_cases(const std::string& path, const CaseOptions& options) {
  std::ifstream in(path);
  if (!in) return Error{ErrorCode::cannot_open, path, "the cases cannot be read", ""};
  // Models are named from the root of the repository: <root>/validation/verdicts/cases.json.
  const std::filesystem::path root = std::filesystem::absolute(path).parent_path().parent_path().parent_path();
  std::vector<Case> cases;
  std::string at = "the document";
  try {
    const json document = json::parse(in);
    for (const json& given : document.at("cases")) {
      at = given.value("id", "a case without an id");
      Result<Case> c = case_of(given, root, options);
      if (!c) return c.error();
      cases.push_back(std::move(*c));
    }
  } catch (const std::exception& e) {
    return Error{ErrorCode::syntax, path + " at " + at, e.what(), ""};
  }
  if (cases.empty()) return Error{ErrorCode::wrong_count, path, "there is no case", ""};
  return cases;
}

}  // namespace patchproof::verdicts
