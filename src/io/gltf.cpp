// SPDX-License-Identifier: Apache-2.0
// glTF 2.0 binary: a header, a JSON chunk padded with spaces, a binary chunk padded with zeros.
#include <algorithm>
#include <cfloat>
#include <nlohmann/json.hpp>

#include "io/mesh_parts.h"

namespace patchproof {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126, kUnsigned = 5125;              // component types
constexpr int kVertexBuffer = 34962, kIndexBuffer = 34963;  // targets
constexpr int kLines = 1, kTriangles = 4;                   // primitive modes
constexpr std::uint32_t kMagic = 0x46546c67, kJson = 0x4e4f534a, kBinary = 0x004e4942;

class Document {
 public:
  Document() {
    json_["asset"] = {{"version", "2.0"}, {"generator", "patchproof"}};
    json_["scene"] = 0;
    // glTF's y points up; a turn about the x axis brings z there.
    json_["nodes"] = Json::array({{{"name", "z up"},
                                   {"rotation", {-0.70710678118654752, 0.0, 0.0, 0.70710678118654752}},
                                   {"children", Json::array()}}});
    json_["scenes"] = Json::array({{{"nodes", {0}}}});
    json_["materials"] = Json::array(
        {{{"pbrMetallicRoughness",
           {{"baseColorFactor", {0.55, 0.65, 0.78, 1.0}}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.7}}},
          {"doubleSided", true}}});
  }

  void add(const MeshPart& part) {
    Json attributes;
    attributes["POSITION"] = vectors(part.mesh.vertices, true);
    if (has_all_normals(part)) {
      std::vector<Vec<double, 3>> normals;
      for (const auto& n : part.normals) normals.push_back(*n);
      attributes["NORMAL"] = vectors(normals, false);
    }
    const std::size_t begin = data_.size();
    for (const int v : part.mesh.corners) put_bytes(data_, static_cast<std::uint32_t>(v));
    const int indices = accessor(
        begin, kIndexBuffer, {{"componentType", kUnsigned}, {"count", part.mesh.corners.size()}, {"type", "SCALAR"}});
    const int mesh = static_cast<int>(json_["meshes"].size());
    const std::string name = part.name.empty() ? "part" : printable(part.name);
    json_["meshes"].push_back(
        {{"name", name},
         {"primitives", Json::array({{{"attributes", attributes},
                                      {"indices", indices},
                                      {"material", 0},
                                      {"mode", part.mesh.dimension == 1 ? kLines : kTriangles}}})}});
    json_["nodes"][0]["children"].push_back(json_["nodes"].size());
    json_["nodes"].push_back({{"name", name}, {"mesh", mesh}});
  }

  bool empty() const { return data_.empty(); }

  std::string bytes() {
    json_["buffers"] = Json::array({{{"byteLength", data_.size()}}});
    std::string text = json_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string out;
    put_bytes(out, kMagic);
    put_bytes(out, 2);
    put_bytes(out, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + data_.size()));
    put_bytes(out, static_cast<std::uint32_t>(text.size()));
    put_bytes(out, kJson);
    out += text;
    put_bytes(out, static_cast<std::uint32_t>(data_.size()));
    put_bytes(out, kBinary);
    return out + data_;
  }

  std::size_t size() const { return data_.size(); }

 private:
  // The accessor of what was appended to the data since `begin`.
  int accessor(std::size_t begin, int target, Json description) {
    json_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", data_.size() - begin}, {"target", target}});
    description["bufferView"] = json_["bufferViews"].size() - 1;
    json_["accessors"].push_back(std::move(description));
    return static_cast<int>(json_["accessors"].size()) - 1;
  }

  int vectors(const std::vector<Vec<double, 3>>& values, bool with_range) {
    const std::size_t begin = data_.size();
    std::array<float, 3> low, high;
    low.fill(FLT_MAX);
    high.fill(-FLT_MAX);
    for (const Vec<double, 3>& p : values)
      for (std::size_t i = 0; i < 3; ++i) {
        put_float(data_, p[i]);
        low[i] = std::min(low[i], static_cast<float>(p[i]));
        high[i] = std::max(high[i], static_cast<float>(p[i]));
      }
    Json description{{"componentType", kFloat}, {"count", values.size()}, {"type", "VEC3"}};
    if (with_range) {
      description["min"] = low;
      description["max"] = high;
    }
    return accessor(begin, kVertexBuffer, std::move(description));
  }

  Json json_;
  std::string data_;
};

}  // namespace

Result<std::string> write_glb(const std::vector<MeshPart>& parts) {
  Document document;
  for (const MeshPart& given : parts) {
    const MeshPart part = triangulated(visible(given));
    if (part.mesh.cell_count() == 0) continue;
    if (auto error = beyond_single_precision(part)) return *error;
    document.add(part);
    if (document.size() > (std::size_t{1} << 31))
      return Error{ErrorCode::usage, "glTF", "the file would be larger than 2 GiB; ask for fewer cells", ""};
  }
  if (document.empty()) return Error{ErrorCode::usage, "glTF", "there is nothing to write", ""};
  return document.bytes();
}

}  // namespace patchproof
