// SPDX-License-Identifier: Apache-2.0
// BREP files: the text is checked first, then Open CASCADE reads what is left when damaged entities are replaced.
#include <BRepTools_ShapeSet.hxx>
#include <BRep_Builder.hxx>
#include <GeomTools_Curve2dSet.hxx>
#include <GeomTools_CurveSet.hxx>
#include <GeomTools_SurfaceSet.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>

#include <fmt/format.h>

#include <map>
#include <sstream>

#include "load.h"

namespace patchproof::occt {
namespace {

// What Open CASCADE refuses to build from numbers that are fine by themselves: it would leave a hole in its table, and the
// entities after it would move up.
template <class ReadOne>
void build(std::vector<BrepEntity>& entities, std::string_view bytes, const char* what, ReadOne read) {
  for (std::size_t i = 0; i < entities.size(); ++i) {
    BrepEntity& entity = entities[i];
    if (entity.damage) continue;
    std::istringstream in(std::string(bytes.substr(entity.begin, entity.end - entity.begin)) + "\n");
    bool built = false;
    try {
      built = !read(in).IsNull();
    } catch (const Standard_Failure&) {
    }
    if (!built)
      entity.damage = Damage{ErrorCode::unsupported, fmt::format("{} {} (line {}): Open CASCADE builds none from it",
                                                                 what, i + 1, entity.line)};
  }
}

// Of the shapes that the file is about, by what they share in all their places.
using DamageOf = std::map<const TopoDS_TShape*, const Damage*>;

std::optional<Damage> found(const DamageOf& damages, const TopoDS_Shape& shape) {
  const auto it = damages.find(shape.TShape().get());
  return it == damages.end() ? std::nullopt : std::optional<Damage>(*it->second);
}

}  // namespace

Result<Loaded> load_brep(const std::string& path, std::string_view bytes, UnusableFaces unusable) {
  Result<BrepText> text = check_brep_text(path, bytes);
  if (!text) return text.error();
  build(text->curves2d, bytes, "parameter curve",
        [](std::istream& in) { return GeomTools_Curve2dSet::ReadCurve2d(in); });
  build(text->curves, bytes, "curve", [](std::istream& in) { return GeomTools_CurveSet::ReadCurve(in); });
  build(text->surfaces, bytes, "surface", [](std::istream& in) { return GeomTools_SurfaceSet::ReadSurface(in); });
  std::istringstream in(text->mended(bytes));
  BRepTools_ShapeSet set{BRep_Builder()};
  set.Read(in);
  Loaded loaded;
  if (set.NbShapes() == static_cast<int>(text->shapes.size()) && set.NbShapes() > 0) set.Read(loaded.shape, in);
  if (loaded.shape.IsNull()) return Error{ErrorCode::syntax, path, "Open CASCADE cannot read the BREP file", ""};
  const Damages damages = text->damages();
  DamageOf damage_of;
  for (int i = 0; i < set.NbShapes(); ++i)
    if (damages[i]) damage_of[set.Shape(i + 1).TShape().get()] = &*damages[i];
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(loaded.shape, TopAbs_FACE, faces);
  std::vector<LeftOutFace> damaged;
  for (int i = 1; i <= faces.Extent(); ++i) {
    loaded.face_labels.push_back(plain_label("face", i));
    loaded.face_faults.push_back(found(damage_of, faces(i)));
    if (const auto& fault = loaded.face_faults.back())
      damaged.push_back({loaded.face_labels.back(), fault->code, fault->reason});
  }
  TopTools_IndexedDataMapOfShapeListOfShape edges;
  TopExp::MapShapesAndAncestors(loaded.shape, TopAbs_EDGE, TopAbs_FACE, edges);
  std::optional<Error> no_face;
  for (int i = 1; i <= edges.Extent(); ++i) {
    loaded.edge_labels.push_back(plain_label("edge", i));
    loaded.edge_faults.push_back(found(damage_of, edges.FindKey(i)));
    if (const auto& fault = loaded.edge_faults.back(); fault && edges(i).IsEmpty() && !no_face)
      no_face =
          Error{fault->code, path + " at " + loaded.edge_labels.back(), "the edge is not usable: " + fault->reason, ""};
  }
  if (unusable == UnusableFaces::leave_out) return loaded;
  if (!damaged.empty()) return about_faces(path, damaged);
  if (no_face) return *no_face;
  return loaded;
}

}  // namespace patchproof::occt
