// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <pugixml.hpp>
#include <sstream>

#include "io/mesh_parts.h"

namespace patchproof {
namespace {

// VTK's numbers of cell types.
int cell_type(const CellComplex<double, 3>& mesh) {
  const bool simplex = mesh.kind == CellKind::simplex;
  switch (mesh.dimension) {
    case 1: return 3;
    case 2: return simplex ? 5 : 9;
    default: return simplex ? 10 : 12;
  }
}

// VTK goes round the bottom of a hexahedron, then round its top.
std::vector<int> corners_of(const CellComplex<double, 3>& mesh, std::size_t c, bool is_mirrored) {
  if (mesh.dimension < 3) return polygon(mesh, c);
  const auto v = mesh.cell(c);
  if (mesh.kind == CellKind::simplex) return {v[0], v[1], v[is_mirrored ? 3 : 2], v[is_mirrored ? 2 : 3]};
  if (is_mirrored) return {v[4], v[5], v[7], v[6], v[0], v[1], v[3], v[2]};
  return {v[0], v[1], v[3], v[2], v[4], v[5], v[7], v[6]};
}

class Grid {
 public:
  explicit Grid(const std::vector<MeshPart>& parts) : parts_(parts) {}

  Result<std::string> write() {
    std::size_t points = 0, cells = 0;
    for (const MeshPart& part : parts_) {
      points += part.mesh.vertices.size();
      cells += part.mesh.cell_count();
    }
    if (cells == 0) return Error{ErrorCode::usage, "VTU", "there is nothing to write", ""};
    pugi::xml_document document;
    pugi::xml_node declaration = document.append_child(pugi::node_declaration);
    declaration.append_attribute("version") = "1.0";
    pugi::xml_node file = document.append_child("VTKFile");
    file.append_attribute("type") = "UnstructuredGrid";
    file.append_attribute("version") = "0.1";
    file.append_attribute("byte_order") = "LittleEndian";
    pugi::xml_node piece = file.append_child("UnstructuredGrid").append_child("Piece");
    piece.append_attribute("NumberOfPoints") = static_cast<unsigned long long>(points);
    piece.append_attribute("NumberOfCells") = static_cast<unsigned long long>(cells);
    point_data(piece.append_child("PointData"));
    array(piece.append_child("CellData"), "Int32", "part", 1, [&](auto& out) {
      for (std::size_t k = 0; k < parts_.size(); ++k)
        for (std::size_t c = 0; c < parts_[k].mesh.cell_count(); ++c) put(out, "{}\n", k);
    });
    array(piece.append_child("Points"), "Float64", "Points", 3, [&](auto& out) {
      for (const MeshPart& part : parts_)
        for (const Vec<double, 3>& p : part.mesh.vertices) put(out, "{} {} {}\n", p[0], p[1], p[2]);
    });
    cell_arrays(piece.append_child("Cells"));
    std::ostringstream text;
    text.exceptions(std::ios::badbit);  // or a text would end where memory did
    text.imbue(std::locale::classic());
    document.save(text, " ", pugi::format_default, pugi::encoding_utf8);
    return text.str();
  }

 private:
  using Buffer = fmt::memory_buffer;
  template <class... Arguments>
  static void put(Buffer& out, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(out), format, std::forward<Arguments>(arguments)...);
  }

  static void array(pugi::xml_node parent, const char* type, const char* name, int components,
                    const std::function<void(Buffer&)>& fill) {
    pugi::xml_node node = parent.append_child("DataArray");
    node.append_attribute("type") = type;
    node.append_attribute("Name") = name;
    if (components > 1) node.append_attribute("NumberOfComponents") = components;
    node.append_attribute("format") = "ascii";
    Buffer out;
    put(out, "\n");
    fill(out);
    node.append_child(pugi::node_pcdata).set_value(fmt::to_string(out).c_str());
  }

  void point_data(pugi::xml_node node) const {
    if (std::all_of(parts_.begin(), parts_.end(), has_all_normals)) {
      node.append_attribute("Normals") = "Normals";
      array(node, "Float64", "Normals", 3, [&](auto& out) {
        for (const MeshPart& part : parts_)
          for (const auto& n : part.normals) put(out, "{} {} {}\n", (*n)[0], (*n)[1], (*n)[2]);
      });
    }
    for (const std::size_t i : {0, 1, 2}) {
      const auto has = [&](const MeshPart& part) { return part.parameters[i].size() == part.mesh.vertices.size(); };
      if (!std::all_of(parts_.begin(), parts_.end(), has)) continue;
      array(node, "Float64", std::array{"u", "v", "w"}[i], 1, [&](auto& out) {
        for (const MeshPart& part : parts_)
          for (const double x : part.parameters[i]) put(out, "{}\n", x);
      });
    }
  }

  void cell_arrays(pugi::xml_node node) const {
    array(node, "Int64", "connectivity", 1, [&](auto& out) {
      std::size_t first = 0;
      for (const MeshPart& part : parts_) {
        const bool is_mirrored = is_inside_out(part.mesh);
        for (std::size_t c = 0; c < part.mesh.cell_count(); ++c) {
          for (const int v : corners_of(part.mesh, c, is_mirrored)) put(out, "{} ", first + v);
          put(out, "\n");
        }
        first += part.mesh.vertices.size();
      }
    });
    array(node, "Int64", "offsets", 1, [&](auto& out) {
      std::size_t end = 0;
      for (const MeshPart& part : parts_)
        for (std::size_t c = 0; c < part.mesh.cell_count(); ++c) put(out, "{}\n", end += part.mesh.corners_per_cell());
    });
    array(node, "UInt8", "types", 1, [&](auto& out) {
      for (const MeshPart& part : parts_)
        for (std::size_t c = 0; c < part.mesh.cell_count(); ++c) put(out, "{}\n", cell_type(part.mesh));
    });
  }

  const std::vector<MeshPart>& parts_;
};

}  // namespace

Result<std::string> write_vtu(const std::vector<MeshPart>& parts) { return Grid(parts).write(); }

}  // namespace patchproof
