// SPDX-License-Identifier: Apache-2.0
// STEP, IGES and BREP through Open CASCADE.
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRep_Tool.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "../report_text.h"
#include "../source_file.h"
#include "approximation.h"
#include "converted.h"
#include "load.h"
#include "patchproof/io/cad.h"
#include "rehearsal.h"
#include "silence.h"
#include "splines.h"

namespace patchproof::occt {
namespace {

const char* kind_of(const TopoDS_Face& face) {
  TopLoc_Location location;
  const auto& surface = BRep_Tool::Surface(face, location);
  if (surface.IsNull()) return "none";
  switch (GeomAdaptor_Surface(surface).GetType()) {
    case GeomAbs_Plane: return "plane";
    case GeomAbs_Cylinder: return "cylinder";
    case GeomAbs_Cone: return "cone";
    case GeomAbs_Sphere: return "sphere";
    case GeomAbs_Torus: return "torus";
    case GeomAbs_BezierSurface: return "bezier";
    case GeomAbs_BSplineSurface: return "bspline";
    case GeomAbs_SurfaceOfRevolution: return "revolution";
    case GeomAbs_SurfaceOfExtrusion: return "extrusion";
    case GeomAbs_OffsetSurface: return "offset";
    default: return "other";
  }
}

// The largest distance between an edge's curve in space and a parameter curve's image, at 33 parameters: sampled, and only
// said in a note.
double sampled_distance(const TopoDS_Edge& edge, const TopoDS_Face& face) {
  double first = 0, last = 0, largest = 0;
  const auto curve = BRep_Tool::Curve(edge, first, last);
  const auto parameters = BRep_Tool::CurveOnSurface(edge, face, first, last);
  const auto surface = BRep_Tool::Surface(face);
  if (curve.IsNull() || parameters.IsNull() || surface.IsNull()) return 0;
  for (int i = 0; i <= 32; ++i) {
    const double t = first + (last - first) * i / 32;
    const gp_Pnt2d at = parameters->Value(t);
    largest = std::max(largest, curve->Value(t).Distance(surface->Value(at.X(), at.Y())));
  }
  return largest;
}

using EdgeMap = TopTools_IndexedDataMapOfShapeListOfShape;

// A shape, its faces, and its edges with the indices of their faces.
struct Topology {
  TopoDS_Shape shape;
  TopTools_IndexedMapOfShape faces;
  EdgeMap edges;

  explicit Topology(const TopoDS_Shape& s) : shape(s) {
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, edges);
  }
  TopoDS_Edge edge(int i) const { return TopoDS::Edge(edges.FindKey(i)); }
  TopoDS_Face face(int i) const { return TopoDS::Face(faces(i)); }
  std::vector<int> faces_of(int edge) const {
    std::vector<int> out;
    for (const TopoDS_Shape& face : edges(edge)) {
      const int index = faces.FindIndex(face);
      if (std::find(out.begin(), out.end(), index) == out.end()) out.push_back(index);
    }
    return out;
  }
};

TopoDS_Shape converted(const TopoDS_Shape& shape) {
  BRepBuilderAPI_NurbsConvert convert(shape, true);
  if (!convert.IsDone()) throw Standard_Failure("conversion to B-splines failed");
  return convert.Shape();
}

// The error about the first face that is not usable, when such faces are refused.
std::optional<Error> refused(const CadModel& model, UnusableFaces unusable) {
  if (unusable == UnusableFaces::leave_out || model.left_out.empty()) return std::nullopt;
  return about_faces(model.path, model.left_out);
}

class Reader {
 public:
  Reader(Converted& out, const Loaded& loaded)
      : out_(out),
        model_(out.model),
        loaded_(loaded),
        before_(loaded.shape),
        after_(before_.faces.IsEmpty() ? loaded.shape : converted(loaded.shape)) {}

  // ERRORS those of the first face that is not usable, when such faces are refused.
  std::optional<Error> read(UnusableFaces unusable) {
    in_step_ = before_.faces.Extent() == after_.faces.Extent() && before_.edges.Extent() == after_.edges.Extent();
    for (int i = 1; in_step_ && i <= after_.edges.Extent(); ++i) in_step_ = before_.faces_of(i) == after_.faces_of(i);
    if (!in_step_) model_.notes.push_back("the conversion to B-splines changed faces or edges: labels are indices");
    for (int i = 1; i <= after_.faces.Extent(); ++i)
      add_face(i, in_step_ ? kind_of(before_.face(i)) : "bspline",
               in_step_ ? loaded_.face_labels[i - 1] : plain_label("face", i),
               in_step_ ? loaded_.face_faults[i - 1] : std::nullopt);
    if (auto error = refused(model_, unusable)) return error;
    for (int i = 1; i <= after_.edges.Extent(); ++i)
      if (!after_.faces_of(i).empty()) add_edge(i, in_step_ ? loaded_.edge_labels[i - 1] : plain_label("edge", i));
    for (int i = 1; i <= before_.edges.Extent(); ++i)
      if (before_.faces_of(i).empty()) add_curve(i, loaded_.edge_labels[i - 1]);
    return std::nullopt;
  }

 private:
  void add_face(int index, const std::string& kind, const std::string& label, const std::optional<Damage>& fault) {
    place_.push_back(-1);
    figure_.push_back(0);
    as_read_.push_back(in_step_ && same_spline(before_.face(index), after_.face(index)));
    if (fault) {
      model_.left_out.push_back({label, fault->code, fault->reason});
      return;
    }
    Result<BsplinePatch<Rational, 4>> surface = surface_of(as_read_.back() ? before_.face(index) : after_.face(index));
    if (!surface) {
      model_.left_out.push_back({label, surface.error().code, surface.error().message});
      return;
    }
    place_.back() = static_cast<int>(model_.faces.size());
    CadFace face{label, kind, std::move(*surface), {}};
    if (kind == "offset" || kind == "other") {
      const SurfaceApproximation by = approximation_of(before_.face(index), after_.face(index));
      face.approximation = by.whole;
      figure_.back() = by.figure;
      model_.notes.push_back(
          fmt::format("{}: its {} surface is approximated by a B-spline, about {:.2g} and {:.2g} degrees from it by "
                      "samples and Open CASCADE's figure",
                      named("face", label), kind, by.whole.length, by.whole.degrees));
    }
    model_.faces.push_back(std::move(face));
  }

  // A B-spline surface that the conversion left as it is.
  static bool same_spline(const TopoDS_Face& before, const TopoDS_Face& after) {
    const auto a = opencascade::handle<Geom_BSplineSurface>::DownCast(BRep_Tool::Surface(before));
    const auto b = opencascade::handle<Geom_BSplineSurface>::DownCast(BRep_Tool::Surface(after));
    if (a.IsNull() || b.IsNull() || a->NbUPoles() != b->NbUPoles() || a->NbVPoles() != b->NbVPoles()) return false;
    double p[4], q[4];
    a->Bounds(p[0], p[1], p[2], p[3]);
    b->Bounds(q[0], q[1], q[2], q[3]);
    return std::equal(p, p + 4, q);
  }

  void add_edge(int i, const std::string& label) {
    const std::vector<int> indices = after_.faces_of(i);
    // The conversion exchanges u and v in some seams of B-splines: where it is not needed, the edge is taken as it was.
    const bool as_read =
        std::all_of(indices.begin(), indices.end(), [&](int index) { return bool(as_read_[index - 1]); });
    const Topology& topology = as_read && !indices.empty() ? before_ : after_;
    const TopoDS_Edge edge = topology.edge(i);
    // The conversion raises the tolerance to what it finds, and may replace parameter curves: the file's own are asked.
    CadEdge out{label, CadEdgeKind::unusable, {}, BRep_Tool::Tolerance(in_step_ ? before_.edge(i) : edge), ""};
    Sources sources;
    const auto finish = [&](CadEdgeKind kind, std::string note = "") {
      out.kind = kind;
      if (!note.empty()) out.note = std::move(note);
      model_.edges.push_back(std::move(out));
      out_.sources.push_back(std::move(sources));
    };
    if (BRep_Tool::Degenerated(edge)) return finish(CadEdgeKind::degenerate);
    if (!BRep_Tool::SameRange(edge) || !BRep_Tool::SameParameter(edge))
      return finish(CadEdgeKind::unusable, "the file says that its curves do not share one parameter");
    for (const int index : indices) {
      if (place_[index - 1] < 0) return finish(CadEdgeKind::unusable, "one of its faces is not usable");
      const TopoDS_Face natural = TopoDS::Face(topology.face(index).Oriented(TopAbs_FORWARD));
      // A seam is met twice, once in each direction; so is an edge that runs into its face and back.
      for (TopExp_Explorer e(natural, TopAbs_EDGE); e.More(); e.Next()) {
        if (!e.Current().IsSame(edge)) continue;
        const TopoDS_Edge use = TopoDS::Edge(e.Current());
        Result<BsplineCurve<Rational, 3>> parameters = parameters_of(use, natural);
        if (!parameters) return finish(CadEdgeKind::unusable, parameters.error().message);
        // Those of STEP and IGES files are Open CASCADE's own, before the conversion and after it.
        const bool in_file = in_step_ && model_.format == "brep";
        const double now = sampled_distance(use, natural),
                     away = std::max(now, in_file ? distance_in_file(i, index) : 0);
        if (away > out.tolerance && now < away / 2)
          return finish(
              CadEdgeKind::unusable,
              fmt::format("its parameter curve on {} is {:.3g} away from its curve in space, tolerance {:.3g}, "
                          "and the conversion to B-splines replaces it",
                          named("face", model_.faces[place_[index - 1]].label), away, out.tolerance));
        if (away > out.tolerance)
          out.note += fmt::format(
              "{}its parameter curve on {} is {:.3g} away from its curve in space, tolerance {:.3g}",
              out.note.empty() ? "" : "; ", named("face", model_.faces[place_[index - 1]].label), away, out.tolerance);
        CadUse made{place_[index - 1], use.Orientation() == TopAbs_FORWARD, std::move(*parameters), {}};
        if (model_.faces[made.face].approximation.length > 0)
          made.approximation = approximation_along(use, before_.face(index), natural, figure_[index - 1]);
        out.uses.push_back(std::move(made));
        sources.push_back({use, natural});
      }
    }
    if (out.uses.empty()) return finish(CadEdgeKind::unusable, "no face uses it");
    const auto same_range = [&](const CadUse& use) {
      const KnotVector<Rational>&k = use.parameters.knots(), &first = out.uses.front().parameters.knots();
      return k.domain_begin() == first.domain_begin() && k.domain_end() == first.domain_end();
    };
    if (!std::all_of(out.uses.begin(), out.uses.end(), same_range))
      return finish(CadEdgeKind::unusable, "its parameter curves run over different ranges");
    finish(out.uses.size() == 1  ? CadEdgeKind::free
           : out.uses.size() > 2 ? CadEdgeKind::non_manifold
           : indices.size() == 1 ? CadEdgeKind::seam
                                 : CadEdgeKind::shared);
  }

  // As the file has them: how far the parameter curves of an edge on a face are from its curve in space.
  double distance_in_file(int edge, int face) const {
    double largest = 0;
    const TopoDS_Face natural = TopoDS::Face(before_.face(face).Oriented(TopAbs_FORWARD));
    for (TopExp_Explorer e(natural, TopAbs_EDGE); e.More(); e.Next())
      if (e.Current().IsSame(before_.edge(edge)))
        largest = std::max(largest, sampled_distance(TopoDS::Edge(e.Current()), natural));
    return largest;
  }

  // An edge of no face.
  void add_curve(int index, const std::string& label) {
    const TopoDS_Edge edge = before_.edge(index);
    const auto unusable = [&](CadEdgeKind kind, const std::string& note) {
      model_.edges.push_back({label, kind, {}, BRep_Tool::Tolerance(edge), note});
      out_.sources.emplace_back();
    };
    if (BRep_Tool::Degenerated(edge)) return unusable(CadEdgeKind::degenerate, "");
    if (!loaded_.edge_faults.empty() && loaded_.edge_faults[index - 1])
      return unusable(CadEdgeKind::unusable, loaded_.edge_faults[index - 1]->reason);
    Result<SpaceCurve> curve = curve_of(edge);
    if (!curve) return unusable(CadEdgeKind::unusable, curve.error().message);
    if (curve->converted)
      model_.notes.push_back(
          named("edge", label) + ": its " + curve->kind +
          " is a B-spline as Open CASCADE converts it: derivatives are that of the B-spline's parameter");
    CadCurve out{label, curve->kind, std::move(curve->curve), {}};
    const auto forward = TopoDS::Edge(edge.Oriented(TopAbs_FORWARD));
    const TopoDS_Vertex vertices[2] = {TopExp::FirstVertex(forward), TopExp::LastVertex(forward)};
    for (int i = 0; i < 2; ++i)
      if (!vertices[i].IsNull())
        if (const double t = BRep_Tool::Tolerance(vertices[i]); t > 0) out.tolerance[i] = std::min(t, 1e100);
    model_.curves.push_back(std::move(out));
  }

  Converted& out_;
  CadModel& model_;
  const Loaded& loaded_;
  const Topology before_, after_;  // the conversion
  bool in_step_ = false;           // the same faces and edges in the same order
  std::vector<int> place_;         // of each face of the shape in model_.faces, −1 when left out
  std::vector<double> figure_;     // Open CASCADE's, of its approximation of the face's surface; else 0
  std::vector<char> as_read_;      // faces that the conversion left as they are
};

}  // namespace

namespace {

Result<Converted> read_here(const std::string& path, std::string_view bytes, const std::string& sha256,
                            const std::string& format, UnusableFaces unusable) {
  Converted out;
  CadModel& model = out.model;
  model.path = path;
  model.sha256 = sha256;
  model.format = format;
  const auto failed = [&](const char* what) {
    return Error{ErrorCode::syntax, path, std::string("Open CASCADE failed ") + what, ""};
  };
  Loaded loaded;
  try {
    Result<Loaded> result = load(path, bytes, model.format, unusable);
    if (!result) return result.error();
    loaded = std::move(*result);
  } catch (const Standard_Failure&) {
    return failed("to read the file");
  }
  model.units = loaded.units;
  model.notes = loaded.notes;
  model.left_out = std::move(loaded.missing);
  if (const auto error = refused(model, unusable)) return *error;
  try {
    if (!loaded.shape.IsNull())
      if (const auto error = Reader(out, loaded).read(unusable)) return *error;
  } catch (const Standard_Failure&) {
    return failed("to convert the file's shape to B-splines");
  }
  if (!model.faces.empty() || !model.curves.empty()) return out;
  if (model.left_out.empty() && !model.edges.empty())
    return Error{ErrorCode::wrong_count, path,
                 "the file holds no face, and no edge that is usable, for example " + model.edges.front().label + ": " +
                     model.edges.front().note,
                 ""};
  if (model.left_out.empty()) return Error{ErrorCode::wrong_count, path, "the file holds neither faces nor edges", ""};
  const LeftOutFace& first = model.left_out.front();
  return Error{ErrorCode::wrong_count, path,
               "no face of the file is usable, for example " + first.label + ": " + first.reason, ""};
}

}  // namespace

Result<Converted> read_converted(const std::string& path, UnusableFaces unusable) {
  const Result<std::string> bytes = load_file(path);
  if (!bytes) return bytes.error();
  if (bytes->empty()) return Error{ErrorCode::empty_input, path, "the file is empty", ""};
  const std::string format = format_of(*bytes);
  const Silence silence;
  const auto megabytes = static_cast<unsigned>(bytes->size() >> 20);
  const auto gave_up = [&](const char* what) { return Error{ErrorCode::syntax, path, what, ""}; };
  switch (rehearse([&] { (void)read_here(path, *bytes, "", format, unusable); }, 10 + 60 * megabytes)) {
    case Rehearsal::crashed: return gave_up("the file is damaged: Open CASCADE breaks down on it");
    case Rehearsal::too_long: return gave_up("the file is damaged: Open CASCADE does not come to an end with it");
    case Rehearsal::fine: break;
  }
  return read_here(path, *bytes, sha256_of(*bytes), format, unusable);
}

}  // namespace patchproof::occt

namespace patchproof {

Result<CadModel> read_cad_model(const std::string& path, UnusableFaces unusable) {
  Result<occt::Converted> converted = occt::read_converted(path, unusable);
  if (!converted) return converted.error();
  return std::move(converted->model);
}

}  // namespace patchproof
