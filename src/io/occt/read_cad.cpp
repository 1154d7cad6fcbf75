// SPDX-License-Identifier: Apache-2.0
// STEP, IGES and BREP through Open CASCADE.
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dConvert.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
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
#include <cmath>
#include <optional>

#include "../source_file.h"
#include "converted.h"
#include "load.h"
#include "patchproof/io/cad.h"
#include "patchproof/patch/denominator.h"
#include "patchproof/spline/bezier_extraction.h"
#include "patchproof/spline/reparametrize.h"

namespace patchproof::occt {
namespace {

using SurfaceHandle = opencascade::handle<Geom_BSplineSurface>;
using CurveHandle = opencascade::handle<Geom2d_BSplineCurve>;

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

std::optional<Rational> exact(double x) {
  if (!std::isfinite(x)) return std::nullopt;
  return from_double(x);
}

template <class Knots, class Multiplicities>
Result<KnotVector<Rational>> knots_of(int degree, const Knots& knots, const Multiplicities& multiplicities) {
  std::vector<Rational> all;
  for (int i = knots.Lower(); i <= knots.Upper(); ++i) {
    const auto t = exact(knots(i));
    if (!t) return Error{ErrorCode::bad_number, "", "a knot is not finite", ""};
    all.insert(all.end(), multiplicities(i), *t);
  }
  return KnotVector<Rational>::make(degree, std::move(all));
}

// The B-spline of a converted face; what is wrong with it when there is none.
Result<BsplinePatch<Rational, 4>> surface_of(const TopoDS_Face& face) {
  const auto bad = [](ErrorCode code, std::string message) { return Error{code, "", std::move(message), ""}; };
  auto any = BRep_Tool::Surface(face);
  if (any.IsNull()) return bad(ErrorCode::unsupported, "it has no surface");
  while (any->IsKind(STANDARD_TYPE(Geom_RectangularTrimmedSurface)))
    any = opencascade::handle<Geom_RectangularTrimmedSurface>::DownCast(any)->BasisSurface();
  const SurfaceHandle given = SurfaceHandle::DownCast(any);
  if (given.IsNull()) return bad(ErrorCode::unsupported, "Open CASCADE's conversion to B-splines left another surface");
  const SurfaceHandle s = SurfaceHandle::DownCast(given->Copy());
  if (s->IsUPeriodic()) s->SetUNotPeriodic();
  if (s->IsVPeriodic()) s->SetVNotPeriodic();
  auto u = knots_of(s->UDegree(), s->UKnots(), s->UMultiplicities());
  auto v = knots_of(s->VDegree(), s->VKnots(), s->VMultiplicities());
  if (!u) return bad(u.error().code, "its knots along u: " + u.error().message);
  if (!v) return bad(v.error().code, "its knots along v: " + v.error().message);
  std::vector<Vec<Rational, 4>> net;
  for (int i = 1; i <= s->NbUPoles(); ++i)
    for (int j = 1; j <= s->NbVPoles(); ++j) {
      const gp_Pnt p = s->Pole(i, j);
      const auto x = exact(p.X()), y = exact(p.Y()), z = exact(p.Z()), w = exact(s->Weight(i, j));
      if (!x || !y || !z || !w)
        return bad(ErrorCode::bad_number, fmt::format("control point ({}, {}) of its surface is not finite", i, j));
      net.push_back(to_homogeneous(Vec<Rational, 3>{{*x, *y, *z}}, *w));
    }
  Result<BsplinePatch<Rational, 4>> patch = BsplinePatch<Rational, 4>::make(*u, *v, std::move(net));
  if (!patch) return bad(patch.error().code, patch.error().message);
  if (!certify_denominator(*patch).is_nonzero())
    return bad(ErrorCode::vanishing_weight, "the denominator of its surface has a zero, or none could be excluded");
  return patch;
}

// The parameter curve of an edge on a face over [first, last].
Result<BsplineCurve<Rational, 3>> parameters_of(const TopoDS_Edge& edge, const TopoDS_Face& face) {
  const auto bad = [](std::string message) { return Error{ErrorCode::unsupported, "", std::move(message), ""}; };
  double first = 0, last = 0;
  const auto any = BRep_Tool::CurveOnSurface(edge, face, first, last);
  if (any.IsNull()) return bad("it has no parameter curve on a face");
  const auto begin = exact(first), end = exact(last);
  if (!begin || !end || !(*begin < *end)) return bad("its range is empty or infinite");
  CurveHandle curve = CurveHandle::DownCast(any);
  if (curve.IsNull()) curve = Geom2dConvert::CurveToBSplineCurve(new Geom2d_TrimmedCurve(any, first, last));
  if (curve.IsNull()) return bad("its parameter curve is no B-spline");
  curve = CurveHandle::DownCast(curve->Copy());
  if (curve->IsPeriodic()) curve->SetNotPeriodic();
  const auto knots = knots_of(curve->Degree(), curve->Knots(), curve->Multiplicities());
  if (!knots) return bad("the knots of its parameter curve: " + knots.error().message);
  std::vector<Vec<Rational, 3>> points;
  for (int i = 1; i <= curve->NbPoles(); ++i) {
    const gp_Pnt2d p = curve->Pole(i);
    const auto u = exact(p.X()), v = exact(p.Y()), w = exact(curve->Weight(i));
    if (!u || !v || !w) return bad("a control point of its parameter curve is not finite");
    if (!(Rational(0) < *w)) return bad("its parameter curve has a weight that is not positive");
    points.push_back(to_homogeneous(Vec<Rational, 2>{{*u, *v}}, *w));
  }
  Result<BsplineCurve<Rational, 3>> made = BsplineCurve<Rational, 3>::make(*knots, std::move(points));
  if (!made) return bad(made.error().message);
  // The last digits of the range and of the knots may differ.
  const Rational from = std::max(*begin, knots->domain_begin()), to = std::min(*end, knots->domain_end());
  const Rational slack = (*end - *begin) / Rational(1000000);
  if (from - *begin > slack || *end - to > slack || !(from < to))
    return bad("its parameter curve does not cover its range");
  const BsplineCurve<Rational, 3> part = restrict(*made, from, to);
  // Both curves of a join run over the same numbers: a range that was cut by rounding is stretched back.
  return from == *begin && to == *end ? part : map_domain(part, *begin, *end);
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

class Reader {
 public:
  Reader(CadModel& model, const Loaded& loaded) : model_(model), loaded_(loaded) {}

  // The converted shape. ERRORS those of the first face that is not usable, when such faces are refused.
  Result<TopoDS_Shape> read(UnusableFaces unusable) {
    model_.left_out = loaded_.missing;
    if (const auto error = refused(unusable)) return *error;
    if (loaded_.shape.IsNull()) return loaded_.shape;
    BRepBuilderAPI_NurbsConvert convert(loaded_.shape, true);
    if (!convert.IsDone()) throw Standard_Failure("conversion to B-splines failed");
    const TopoDS_Shape shape = convert.Shape();
    TopTools_IndexedMapOfShape before, faces;
    TopExp::MapShapes(loaded_.shape, TopAbs_FACE, before);
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    const bool in_step = before.Extent() == faces.Extent();
    if (!in_step) model_.notes.push_back("the conversion to B-splines changed the number of faces: labels are indices");
    for (int i = 1; i <= faces.Extent(); ++i)
      add_face(TopoDS::Face(faces(i)), in_step ? kind_of(TopoDS::Face(before(i))) : "bspline",
               in_step ? loaded_.face_labels[i - 1] : plain_label("face", i),
               in_step ? loaded_.face_faults[i - 1] : "");
    if (const auto error = refused(unusable)) return *error;
    TopTools_IndexedDataMapOfShapeListOfShape edges;
    TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, edges);
    const bool edges_in_step = static_cast<int>(loaded_.edge_labels.size()) == edges.Extent();
    for (int i = 1; i <= edges.Extent(); ++i)
      add_edge(TopoDS::Edge(edges.FindKey(i)), edges(i), faces,
               edges_in_step ? loaded_.edge_labels[i - 1] : plain_label("edge", i));
    return shape;
  }

 private:
  std::optional<Error> refused(UnusableFaces unusable) const {
    if (unusable == UnusableFaces::leave_out || model_.left_out.empty()) return std::nullopt;
    const LeftOutFace& face = model_.left_out.front();
    std::string more;
    if (const std::size_t others = model_.left_out.size() - 1; others > 0)
      more = fmt::format("; {} more {} not usable either", others, others == 1 ? "face is" : "faces are");
    return Error{face.code, model_.path + " at " + face.label, "the face is not usable: " + face.reason + more, ""};
  }

  void add_face(const TopoDS_Face& face, const std::string& kind, const std::string& label, const std::string& fault) {
    place_.push_back(-1);
    if (!fault.empty()) {
      model_.left_out.push_back({label, ErrorCode::syntax, fault});
      return;
    }
    Result<BsplinePatch<Rational, 4>> surface = surface_of(face);
    if (!surface) {
      model_.left_out.push_back({label, surface.error().code, surface.error().message});
      return;
    }
    place_.back() = static_cast<int>(model_.faces.size());
    if (kind == "offset" || kind == "other")
      model_.notes.push_back("face " + label + ": its " + kind + " surface is approximated by a B-spline");
    model_.faces.push_back({label, kind, std::move(*surface)});
  }

  void add_edge(const TopoDS_Edge& edge, const TopTools_ListOfShape& ancestors, const TopTools_IndexedMapOfShape& faces,
                const std::string& label) {
    CadEdge out{label, CadEdgeKind::unusable, {}, BRep_Tool::Tolerance(edge), ""};
    std::vector<int> indices;
    for (const TopoDS_Shape& face : ancestors) {
      const int index = faces.FindIndex(face);
      if (std::find(indices.begin(), indices.end(), index) == indices.end()) indices.push_back(index);
    }
    const auto finish = [&](CadEdgeKind kind, std::string note = "") {
      out.kind = kind;
      if (!note.empty()) out.note = std::move(note);
      model_.edges.push_back(std::move(out));
    };
    if (BRep_Tool::Degenerated(edge)) return finish(CadEdgeKind::degenerate);
    if (!BRep_Tool::SameRange(edge) || !BRep_Tool::SameParameter(edge))
      return finish(CadEdgeKind::unusable, "the file says that its curves do not share one parameter");
    for (const int index : indices) {
      const TopoDS_Face& face = TopoDS::Face(faces(index));
      if (place_[index - 1] < 0) return finish(CadEdgeKind::unusable, "one of its faces is not usable");
      const TopoDS_Face natural = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
      // A seam is met twice, once in each direction; so is an edge that runs into its face and back.
      for (TopExp_Explorer e(natural, TopAbs_EDGE); e.More(); e.Next()) {
        if (!e.Current().IsSame(edge)) continue;
        Result<BsplineCurve<Rational, 3>> parameters = parameters_of(TopoDS::Edge(e.Current()), natural);
        if (!parameters) return finish(CadEdgeKind::unusable, parameters.error().message);
        const double away = sampled_distance(TopoDS::Edge(e.Current()), natural);
        if (away > out.tolerance)
          out.note +=
              fmt::format("{}its parameter curve on face {} is {:.3g} away from its curve in space, tolerance {:.3g}",
                          out.note.empty() ? "" : "; ", model_.faces[place_[index - 1]].label, away, out.tolerance);
        out.uses.push_back({place_[index - 1], e.Current().Orientation() == TopAbs_FORWARD, std::move(*parameters)});
      }
    }
    if (out.uses.empty()) return finish(CadEdgeKind::unusable, "no face uses it");
    finish(out.uses.size() == 1  ? CadEdgeKind::free
           : out.uses.size() > 2 ? CadEdgeKind::non_manifold
           : indices.size() == 1 ? CadEdgeKind::seam
                                 : CadEdgeKind::shared);
  }

  CadModel& model_;
  const Loaded& loaded_;
  std::vector<int> place_;  // of each face of the shape in model_.faces, −1 when left out
};

// Open CASCADE speaks to the user through printers; its words are not ours.
class Silence {
 public:
  Silence() : printers_(Message::DefaultMessenger()->Printers()) {
    Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  }
  ~Silence() {
    for (const auto& printer : printers_) Message::DefaultMessenger()->AddPrinter(printer);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  const Message_SequenceOfPrinters printers_;
};

}  // namespace

Result<Converted> read_converted(const std::string& path, UnusableFaces unusable) {
  const Result<std::string> bytes = load_file(path);
  if (!bytes) return bytes.error();
  if (bytes->empty()) return Error{ErrorCode::empty_input, path, "the file is empty", ""};
  Converted out;
  CadModel& model = out.model;
  model.path = path;
  model.sha256 = sha256_of(*bytes);
  model.format = format_of(*bytes);
  const Silence silence;
  const auto failed = [&](const char* what) {
    return Error{ErrorCode::syntax, path, std::string("Open CASCADE failed ") + what, ""};
  };
  Loaded loaded;
  try {
    Result<Loaded> result = load(path, model.format);
    if (!result) return result.error();
    loaded = std::move(*result);
  } catch (const Standard_Failure&) {
    return failed("to read the file");
  }
  model.units = loaded.units;
  try {
    Result<TopoDS_Shape> shape = Reader(model, loaded).read(unusable);
    if (!shape) return shape.error();
    out.shape = *shape;
  } catch (const Standard_Failure&) {
    return failed("to convert the file's shape to B-splines");
  }
  if (!model.faces.empty()) return out;
  if (model.left_out.empty()) return Error{ErrorCode::wrong_count, path, "the file holds no face", ""};
  return Error{ErrorCode::wrong_count, path,
               "no face of the file is usable, for example " + model.left_out.front().label + ": " +
                   model.left_out.front().reason,
               ""};
}

}  // namespace patchproof::occt

namespace patchproof {

Result<CadModel> read_cad_model(const std::string& path, UnusableFaces unusable) {
  Result<occt::Converted> converted = occt::read_converted(path, unusable);
  if (!converted) return converted.error();
  return std::move(converted->model);
}

}  // namespace patchproof
