// SPDX-License-Identifier: Apache-2.0
#include "validation/verdicts/occt.h"

#include <BRepLib.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_BSplineSurface.hxx>
#include <LocalAnalysis_SurfaceContinuity.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <Standard_Version.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Shell.hxx>

#include <unistd.h>

#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "patchproof/io/cad.h"

namespace patchproof::verdicts {
namespace {

using Surface = opencascade::handle<Geom_BSplineSurface>;

struct Knots {
  TColStd_Array1OfReal values;
  TColStd_Array1OfInteger multiplicities;
};

Knots knots_of(const KnotVector<Rational>& given) {
  std::vector<std::pair<double, int>> distinct;
  for (const Rational& t : given.knots()) {
    const double value = nearest_double(t);
    if (distinct.empty() || distinct.back().first != value) distinct.emplace_back(value, 0);
    ++distinct.back().second;
  }
  const int count = static_cast<int>(distinct.size());
  Knots out{TColStd_Array1OfReal(1, count), TColStd_Array1OfInteger(1, count)};
  for (int i = 0; i < count; ++i) {
    out.values(i + 1) = distinct[i].first;
    out.multiplicities(i + 1) = distinct[i].second;
  }
  return out;
}

Surface surface_of(const BsplinePatch<Rational, 4>& patch) {
  const int rows = patch.count(Direction::u), columns = patch.count(Direction::v);
  TColgp_Array2OfPnt poles(1, rows, 1, columns);
  TColStd_Array2OfReal weights(1, rows, 1, columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const auto& p = patch.point(i, j);
      const auto coordinate = [&](int c) { return nearest_double(p[c] / p[3]); };
      poles(i + 1, j + 1) = gp_Pnt(coordinate(0), coordinate(1), coordinate(2));
      weights(i + 1, j + 1) = nearest_double(p[3]);
    }
  const Knots u = knots_of(patch.knots(Direction::u)), v = knots_of(patch.knots(Direction::v));
  return new Geom_BSplineSurface(poles, weights, u.values, v.values, u.multiplicities, v.multiplicities,
                                 patch.degree(Direction::u), patch.degree(Direction::v));
}

struct Bounds {
  double u0, u1, v0, v1;
  explicit Bounds(const Surface& s) { s->Bounds(u0, u1, v0, v1); }
};

const double kTolerance = Precision::Confusion();

// A face over the whole domain; its edges at u_min and u_max may be given.
class FaceMaker {
 public:
  FaceMaker(const Surface& surface, double vertex_tolerance)
      : surface_(surface), bounds_(surface), vertex_tolerance_(vertex_tolerance) {
    builder_.MakeFace(face_, surface, kTolerance);
  }

  // The edge along u = `u`, from v_begin to v_end, with new vertices.
  TopoDS_Edge edge_along_v(double u, double tolerance) {
    TopoDS_Edge edge;
    builder_.MakeEdge(edge, surface_->UIso(u), tolerance);
    add_ends(edge, vertex(u, bounds_.v0), vertex(u, bounds_.v1), bounds_.v0, bounds_.v1);
    put_along_v(edge, u, tolerance);
    return edge;
  }
  void put_along_v(const TopoDS_Edge& edge, double u, double tolerance) {
    builder_.UpdateEdge(edge, new Geom2d_Line(gp_Pnt2d(u, 0), gp_Dir2d(0, 1)), face_, tolerance);
  }

  TopoDS_Face finish(const TopoDS_Edge& u_min, const TopoDS_Edge& u_max) {
    TopoDS_Wire wire;
    builder_.MakeWire(wire);
    const TopoDS_Edge v_min = edge_along_u(bounds_.v0, u_min, u_max, true);
    const TopoDS_Edge v_max = edge_along_u(bounds_.v1, u_min, u_max, false);
    builder_.Add(wire, v_min.Oriented(TopAbs_FORWARD));
    builder_.Add(wire, u_max.Oriented(TopAbs_FORWARD));
    builder_.Add(wire, v_max.Oriented(TopAbs_REVERSED));
    builder_.Add(wire, u_min.Oriented(TopAbs_REVERSED));
    builder_.Add(face_, wire);
    return face_;
  }

 private:
  TopoDS_Vertex vertex(double u, double v) {
    TopoDS_Vertex out;
    builder_.MakeVertex(out, surface_->Value(u, v), vertex_tolerance_);
    return out;
  }
  void add_ends(TopoDS_Edge& edge, const TopoDS_Vertex& begin, const TopoDS_Vertex& end, double t0, double t1) {
    builder_.Add(edge, begin.Oriented(TopAbs_FORWARD));
    builder_.Add(edge, end.Oriented(TopAbs_REVERSED));
    builder_.Range(edge, t0, t1);
  }
  static TopoDS_Vertex end_of(const TopoDS_Edge& edge, bool first) {
    for (TopoDS_Iterator i(edge.Oriented(TopAbs_FORWARD)); i.More(); i.Next())
      if ((i.Value().Orientation() == TopAbs_FORWARD) == first) return TopoDS::Vertex(i.Value());
    throw Standard_Failure("an edge without ends");
  }
  TopoDS_Edge edge_along_u(double v, const TopoDS_Edge& u_min, const TopoDS_Edge& u_max, bool first) {
    TopoDS_Edge edge;
    builder_.MakeEdge(edge, surface_->VIso(v), kTolerance);
    add_ends(edge, end_of(u_min, first), end_of(u_max, first), bounds_.u0, bounds_.u1);
    builder_.UpdateEdge(edge, new Geom2d_Line(gp_Pnt2d(0, v), gp_Dir2d(1, 0)), face_, kTolerance);
    return edge;
  }

  BRep_Builder builder_;
  Surface surface_;
  Bounds bounds_;
  double vertex_tolerance_;
  TopoDS_Face face_;
};

struct Joined {
  Surface a, b;
  TopoDS_Edge edge;
  TopoDS_Face face_a, face_b;

  Joined(const Shape& shape, double tolerance) : a(surface_of(shape.a)), b(surface_of(shape.b)) {
    const Bounds of_a(a), of_b(b);
    FaceMaker make_a(a, tolerance), make_b(b, tolerance);
    edge = make_a.edge_along_v(of_a.u1, tolerance);
    make_b.put_along_v(edge, of_b.u0, tolerance);
    face_a = make_a.finish(make_a.edge_along_v(of_a.u0, kTolerance), edge);
    face_b = make_b.finish(edge, make_b.edge_along_v(of_b.u1, kTolerance));
  }
};

const char* name_of(GeomAbs_Shape shape) {
  switch (shape) {
    case GeomAbs_C0: return "C0";
    case GeomAbs_G1: return "G1";
    case GeomAbs_C1: return "C1";
    case GeomAbs_G2: return "G2";
    case GeomAbs_C2: return "C2";
    case GeomAbs_C3: return "C3";
    default: return "CN";
  }
}

std::string local_analysis(const Joined& j) {
  const Bounds a(j.a), b(j.b);
  const double v = (a.v0 + a.v1) / 2;
  const LocalAnalysis_SurfaceContinuity there(j.a, a.u1, v, j.b, b.u0, v, GeomAbs_G2);
  if (!there.IsDone()) return "not done";
  std::string answer;
  for (const auto& [holds, name] : {std::pair{there.IsC0(), "IsC0"}, {there.IsG1(), "IsG1"}, {there.IsG2(), "IsG2"}})
    if (holds) answer += std::string(answer.empty() ? "" : ", ") + name;
  return answer.empty() ? "none" : answer;
}

using Tally = std::map<std::string, int>;

std::string counted(const Tally& tally) {
  if (tally.size() == 1 && tally.begin()->second == 1) return tally.begin()->first;
  std::string text;
  for (const auto& [answer, times] : tally) text += fmt::format("{}{} ×{}", text.empty() ? "" : "; ", answer, times);
  return text;
}

// A file that is removed again.
struct TemporaryFile {
  std::string path = (std::filesystem::temp_directory_path() / "patchproof-verdicts-XXXXXX").string();
  bool exists = false;

  TemporaryFile() {
    const int file = mkstemp(path.data());
    exists = file >= 0;
    if (exists) close(file);
  }
  ~TemporaryFile() {
    std::error_code ignored;
    if (exists) std::filesystem::remove(path, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
};

Error refused(const Case& c, const Standard_Failure& failure) {
  return {ErrorCode::unsupported, c.id, std::string("Open CASCADE refuses the shape: ") + failure.GetMessageString(),
          ""};
}

}  // namespace

std::optional<std::string> occt_version() { return OCC_VERSION_COMPLETE; }

Result<Answers> ask_occt(const Case& c) try {
  Tally faces, encoded, local;
  for (const Shape& shape : c.shapes) {
    Joined j(shape, c.edge_tolerance);
    ++faces[name_of(BRepLib::ContinuityOfFaces(j.edge, j.face_a, j.face_b, 1e-10))];
    BRepLib::EncodeRegularity(j.edge, j.face_a, j.face_b);
    ++encoded[name_of(BRep_Tool::Continuity(j.edge, j.face_a, j.face_b))];
    ++local[local_analysis(j)];
  }
  return Answers{counted(faces), counted(encoded), counted(local)};
} catch (const Standard_Failure& failure) {
  return refused(c, failure);
}

Result<std::vector<Certificate>> certify_as_cad(const Case& c) try {
  BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  for (const Shape& shape : c.shapes) {
    const Joined j(shape, c.edge_tolerance);
    TopoDS_Shell shell;
    builder.MakeShell(shell);
    builder.Add(shell, j.face_a);
    builder.Add(shell, j.face_b);
    builder.Add(all, shell);
  }
  const TemporaryFile file;
  if (!file.exists || !BRepTools::Write(all, file.path.c_str()))
    return Error{ErrorCode::cannot_open, file.path, "the BREP file cannot be written", ""};
  const Result<CadModel> model = read_cad_model(file.path);
  if (!model) return model.error();
  std::vector<Certificate> out;
  for (const ReportedJoin& join : certify_cad(*model).joins) out.push_back(join.certificate);
  return out;
} catch (const Standard_Failure& failure) {
  return refused(c, failure);
}

}  // namespace patchproof::verdicts
