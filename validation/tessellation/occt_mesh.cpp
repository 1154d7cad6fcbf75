// SPDX-License-Identifier: Apache-2.0
#include "validation/tessellation/occt_mesh.h"

#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Version.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>

#include <array>
#include <ctime>
#include <map>
#include <sstream>

namespace patchproof::tessellation {
namespace {

// Equal positions are one vertex.
class Collector {
 public:
  explicit Collector(CertifiedMesh& mesh) : mesh_(mesh) {}
  int vertex(const gp_Pnt& p) {
    const auto [it, is_new] = numbers_.try_emplace({p.X(), p.Y(), p.Z()}, static_cast<int>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back({{p.X(), p.Y(), p.Z()}});
    return it->second;
  }

 private:
  CertifiedMesh& mesh_;
  std::map<std::array<double, 3>, int> numbers_;
};

}  // namespace

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) / 1e9;
}

std::optional<TopoDS_Shape> read_step(const std::string& path) {
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  STEPControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) return std::nullopt;
  reader.TransferRoots();
  return reader.OneShape();
}

std::optional<TopoDS_Shape> read_brep(const std::string& bytes) {
  std::istringstream in(bytes);
  TopoDS_Shape out;
  BRepTools::Read(out, in, BRep_Builder());
  if (out.IsNull()) return std::nullopt;
  return out;
}

TopoDS_Shape sewn(const TopoDS_Shape& shape, double tolerance) {
  BRepBuilderAPI_Sewing sewing(tolerance);
  sewing.Add(shape);
  sewing.Perform();
  return sewing.SewedShape();
}

bool write_brep(const TopoDS_Shape& shape, const std::string& path) { return BRepTools::Write(shape, path.c_str()); }

std::vector<FaceSurface> surfaces_of(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  std::vector<FaceSurface> out;
  for (int f = 1; f <= faces.Extent(); ++f) out.emplace_back(TopoDS::Face(faces(f)));
  return out;
}

OcctMesh mesh_by_occt(const TopoDS_Shape& shape, double deflection, double radians) {
  OcctMesh out;
  BRepTools::Clean(shape);
  const double begin = processor_seconds();
  BRepMesh_IncrementalMesh(shape, deflection, false, radians, false);
  out.seconds = processor_seconds() - begin;

  Collector collector(out.mesh);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  for (int f = 1; f <= faces.Extent(); ++f) {
    const TopoDS_Face face = TopoDS::Face(faces(f));
    TopLoc_Location place;
    const auto triangles = BRep_Tool::Triangulation(face, place);
    if (triangles.IsNull() || triangles->NbTriangles() == 0) {
      ++out.faces_without;
      continue;
    }
    for (int t = 1; t <= triangles->NbTriangles(); ++t) {
      int n[3];
      triangles->Triangle(t).Get(n[0], n[1], n[2]);
      if (face.Orientation() == TopAbs_REVERSED) std::swap(n[1], n[2]);
      std::array<int, 3> v;
      for (int k = 0; k < 3; ++k) v[k] = collector.vertex(triangles->Node(n[k]).Transformed(place));
      if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
        ++out.mesh.collapsed;
        continue;
      }
      out.mesh.triangles.push_back(v);
      out.mesh.faces.push_back(f - 1);
    }
  }
  TopTools_IndexedDataMapOfShapeListOfShape edges;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, edges);
  for (int e = 1; e <= edges.Extent(); ++e) {
    const TopoDS_Edge edge = TopoDS::Edge(edges.FindKey(e));
    if (edges(e).Extent() != 1 || BRep_Tool::Degenerated(edge)) continue;
    TopLoc_Location place;
    const auto triangles = BRep_Tool::Triangulation(TopoDS::Face(edges(e).First()), place);
    if (triangles.IsNull()) continue;
    const auto polygon = BRep_Tool::PolygonOnTriangulation(edge, triangles, place);
    if (polygon.IsNull()) continue;
    for (int i = 1; i < polygon->NbNodes(); ++i)
      out.mesh.free.push_back({collector.vertex(triangles->Node(polygon->Node(i)).Transformed(place)),
                               collector.vertex(triangles->Node(polygon->Node(i + 1)).Transformed(place))});
  }
  return out;
}

std::string occt_version() { return OCC_VERSION_COMPLETE; }

}  // namespace patchproof::tessellation
