// SPDX-License-Identifier: Apache-2.0
#include "validation/shell/egg_crate.h"

#include <BRepBuilderAPI_Transform.hxx>
#include <BRep_Builder.hxx>
#include <Geom2d_Circle.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPControl_Writer.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Circ.hxx>

#include <algorithm>
#include <cmath>
#include <map>

namespace patchproof::shell {
namespace {

constexpr double kTolerance = 1e-7, kCell = 3;
constexpr double kRim = 1, kFillet = 0.25, kDepth = 2;  // of holes

int phase(int line) { return ((line % 6) + 6) % 6; }

// Half the kink: 2⁻¹ … 2⁻¹⁶, 53° to 0.002°.
double kink(int line) { return std::ldexp(1.0, -1 - 3 * ((line / 6) % 6)); }

// B-spline coefficients on the knots 0, 0, 0, 0, 1/2, 1, 1, 1, 1 of the cubic with these Bernstein coefficients.
std::array<double, 5> two_spans(const std::array<double, 4>& b) {
  return {b[0], (b[0] + b[1]) / 2, (b[1] + b[2]) / 2, (b[2] + b[3]) / 2, b[3]};
}
std::array<double, 4> bernstein(const Profile& profile, int cell) {
  const double begin = profile.value(cell), end = profile.value(cell + 1);
  return {begin, begin + profile.slope(cell, true), end - profile.slope(cell + 1, false), end};
}

// Knots of a cell, twice halved exactly.
struct Knots {
  TColStd_Array1OfReal values{1, 3};
  TColStd_Array1OfInteger multiplicities{1, 3};
  explicit Knots(int cell) {
    for (int i = 0; i < 3; ++i) {
      values(i + 1) = kCell * cell + kCell * i / 2;
      multiplicities(i + 1) = i == 1 ? 1 : 4;
    }
  }
};

class Builder {
 public:
  explicit Builder(const EggCrate& crate) : crate_(crate) { build_.MakeShell(shell_); }

  TopoDS_Shell shell() {
    for (int i = 0; i < crate_.columns; ++i)
      for (int j = 0; j < crate_.rows; ++j) add_cell(i, j);
    return shell_;
  }

 private:
  using Surface = opencascade::handle<Geom_Surface>;
  using Line2d = opencascade::handle<Geom2d_Curve>;

  TopoDS_Vertex vertex(const gp_Pnt& point) {
    TopoDS_Vertex out;
    build_.MakeVertex(out, point, kTolerance);
    return out;
  }
  const TopoDS_Vertex& corner(int i, int j) {
    TopoDS_Vertex& out = corners_[{i, j}];
    if (out.IsNull()) out = vertex({kCell * i, kCell * j, profile_.value(i) + profile_.value(j)});
    return out;
  }
  TopoDS_Edge edge(const opencascade::handle<Geom_Curve>& curve, const TopoDS_Vertex& from, const TopoDS_Vertex& to,
                   double first, double last) {
    TopoDS_Edge out;
    build_.MakeEdge(out, curve, kTolerance);
    build_.Add(out, from.Oriented(TopAbs_FORWARD));
    build_.Add(out, to.Oriented(TopAbs_REVERSED));
    build_.Range(out, first, last);
    return out;
  }

  // The side of the cell (i, j) that runs along u (or v) from its corner.
  const TopoDS_Edge& side(int i, int j, bool along_u) {
    TopoDS_Edge& out = sides_[{i, j, along_u}];
    if (!out.IsNull()) return out;
    const int cell = along_u ? i : j;
    const std::array<double, 5> heights = two_spans(bernstein(profile_, cell));
    TColgp_Array1OfPnt points(1, 5);
    for (int k = 0; k < 5; ++k) {
      const double run = kCell * cell + greville(k);
      points(k + 1) = along_u ? gp_Pnt(run, kCell * j, heights[k] + profile_.value(j))
                              : gp_Pnt(kCell * i, run, profile_.value(i) + heights[k]);
    }
    const Knots knots(cell);
    out = edge(new Geom_BSplineCurve(points, knots.values, knots.multiplicities, 3), corner(i, j),
               along_u ? corner(i + 1, j) : corner(i, j + 1), kCell * cell, kCell * (cell + 1));
    return out;
  }
  static double greville(int k) { return two_spans({0, 1, 2, 3})[k]; }

  Surface surface(int i, int j) const {
    const std::array<double, 5> p = two_spans(bernstein(profile_, i)), q = two_spans(bernstein(profile_, j));
    TColgp_Array2OfPnt points(1, 5, 1, 5);
    for (int k = 0; k < 5; ++k)
      for (int l = 0; l < 5; ++l)
        points(k + 1, l + 1) = gp_Pnt(kCell * i + greville(k), kCell * j + greville(l), p[k] + q[l]);
    const Knots u(i), v(j);
    return new Geom_BSplineSurface(points, u.values, v.values, u.multiplicities, v.multiplicities, 3, 3);
  }

  TopoDS_Face face(const Surface& surface) {
    TopoDS_Face out;
    build_.MakeFace(out, surface, kTolerance);
    return out;
  }
  void run(const TopoDS_Edge& edge, const TopoDS_Face& face, const Line2d& curve) {
    build_.UpdateEdge(edge, curve, face, kTolerance);
  }
  static Line2d line(double u, double v, double du, double dv) {
    return new Geom2d_Line(gp_Pnt2d(u, v), gp_Dir2d(du, dv));
  }
  TopoDS_Wire wire(const std::vector<TopoDS_Shape>& edges) {
    TopoDS_Wire out;
    build_.MakeWire(out);
    for (const TopoDS_Shape& e : edges) build_.Add(out, e);
    out.Closed(true);
    return out;
  }

  void add_cell(int i, int j) {
    TopoDS_Face cell = face(surface(i, j));
    const TopoDS_Edge south = side(i, j, true), north = side(i, j + 1, true), west = side(i, j, false),
                      east = side(i + 1, j, false);
    run(south, cell, line(0, kCell * j, 1, 0));
    run(north, cell, line(0, kCell * (j + 1), 1, 0));
    run(west, cell, line(kCell * i, 0, 0, 1));
    run(east, cell, line(kCell * (i + 1), 0, 0, 1));
    build_.Add(cell, wire({south, east, north.Reversed(), west.Reversed()}));
    if (profile_.is_constant(i) && profile_.is_constant(j)) add_hole(cell, i, j);
    build_.Add(shell_, cell);
  }

  TopoDS_Edge circle(const gp_Pnt& centre, double radius) {
    const TopoDS_Vertex start = vertex(centre.Translated(gp_Vec(radius, 0, 0)));
    return edge(new Geom_Circle(gp_Circ(gp_Ax2(centre, gp_Dir(0, 0, 1), gp_Dir(1, 0, 0)), radius)), start, start, 0,
                2 * M_PI);
  }
  static TopoDS_Vertex start_of(const TopoDS_Edge& circle) { return TopoDS::Vertex(TopoDS_Iterator(circle).Value()); }

  // A face of revolution between two circles, from v = low to v = high, with its seam.
  TopoDS_Face around(const Surface& surface, const TopoDS_Edge& bottom, const TopoDS_Edge& top, double low, double high,
                     const opencascade::handle<Geom_Curve>& meridian) {
    TopoDS_Face out = face(surface);
    run(bottom, out, line(0, low, 1, 0));
    run(top, out, line(0, high, 1, 0));
    const TopoDS_Edge seam = edge(meridian, start_of(bottom), start_of(top), low, high);
    build_.UpdateEdge(seam, line(2 * M_PI, 0, 0, 1), line(0, 0, 0, 1), out, kTolerance);
    build_.Add(out, wire({bottom, seam, top.Reversed(), seam.Reversed()}));
    return out;
  }

  void add_hole(TopoDS_Face& cell, int i, int j) {
    const double height = profile_.value(i) + profile_.value(j);
    const gp_Pnt top(kCell * i + kCell / 2, kCell * j + kCell / 2, height),
        middle = top.Translated({0, 0, -kFillet}), bottom = top.Translated({0, 0, -kFillet - kDepth});
    const TopoDS_Edge rim = circle(top, kRim), neck = circle(middle, kRim - kFillet),
                      foot = circle(bottom, kRim - kFillet);
    run(rim, cell, new Geom2d_Circle(gp_Ax22d(gp_Pnt2d(top.X(), top.Y()), gp_Dir2d(1, 0), gp_Dir2d(0, 1)), kRim));
    build_.Add(cell, wire({rim.Reversed()}));
    const gp_Ax3 axes(middle, gp_Dir(0, 0, 1), gp_Dir(1, 0, 0));
    const gp_Circ meridian(gp_Ax2(middle.Translated({kRim, 0, 0}), gp_Dir(0, -1, 0), gp_Dir(1, 0, 0)), kFillet);
    build_.Add(shell_, around(new Geom_ToroidalSurface(axes, kRim, kFillet), rim, neck, M_PI / 2, M_PI,
                              new Geom_Circle(meridian)));
    build_.Add(shell_, around(new Geom_CylindricalSurface(axes, kRim - kFillet), foot, neck, -kDepth, 0,
                              new Geom_Line(middle.Translated({kRim - kFillet, 0, 0}), gp_Dir(0, 0, 1)))
                           .Reversed());
  }

  const EggCrate& crate_;
  const Profile profile_{};
  BRep_Builder build_;
  TopoDS_Shell shell_;
  std::map<std::array<int, 2>, TopoDS_Vertex> corners_;
  std::map<std::array<int, 3>, TopoDS_Edge> sides_;
};

gp_Trsf turn() {
  gp_Trsf out;
  out.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(1, 2, 3)), 0.7);
  return out;
}

}  // namespace

double Profile::value(int line) const {
  constexpr std::array<double, 6> kValues{0, 0.75, 0.5, 1, 1, 0.25};
  return kValues[phase(line)];
}

double Profile::slope(int line, bool right) const {
  if (phase(line) == 0) return right ? kink(line) : -kink(line);
  constexpr std::array<double, 6> kSlopes{0, 0.25, -0.125, 0, 0, -0.5};
  return kSlopes[phase(line)];
}

bool Profile::is_constant(int cell) const { return phase(cell) == 3; }

double Profile::least_slope(int cell) const {
  const std::array<double, 4> b = bernstein(*this, cell);
  const double d[3] = {b[1] - b[0], b[2] - b[1], b[3] - b[2]};
  double low = std::min(d[0], d[2]), high = std::max(d[0], d[2]);
  const double bend = d[0] - 2 * d[1] + d[2], at = bend == 0 ? 0 : (d[0] - d[1]) / bend;
  if (0 < at && at < 1) {
    const double turning = (1 - at) * d[0] + at * d[1];  // where the slope's own slope is zero
    low = std::min(low, turning), high = std::max(high, turning);
  }
  return low <= 0 && high >= 0 ? 0 : std::min(std::fabs(low), std::fabs(high));
}

int EggCrate::holes() const {
  const auto constant = [](int cells) { return (cells + 2) / 6; };
  return constant(columns) * constant(rows);
}

TopoDS_Shape EggCrate::shape() const {
  const TopoDS_Shape flat = Builder(*this).shell();
  return turned ? BRepBuilderAPI_Transform(flat, turn(), true).Shape() : flat;
}

bool EggCrate::write_step(const std::string& path) const {
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  STEPControl_Writer writer;
  return writer.Transfer(shape(), STEPControl_AsIs) == IFSelect_RetDone &&
         writer.Write(path.c_str()) == IFSelect_RetDone;
}

std::array<int, 2> EggCrate::cell_of(const CadFace& face) const {
  if (face.kind != "bspline") return {-1, -1};
  const auto& corner = face.surface.net().front();
  gp_Pnt at(nearest_double(corner[0]), nearest_double(corner[1]), nearest_double(corner[2]));
  if (turned) at.Transform(turn().Inverted());
  return {static_cast<int>(std::lround(at.X() / kCell)), static_cast<int>(std::lround(at.Y() / kCell))};
}

double EggCrate::angle_of(const CadModel& model, const ReportedJoin& join) const {
  const std::array<int, 2> a = cell_of(model.faces[join.a.patch]), b = cell_of(model.faces[join.b.patch]);
  if (a[0] < 0 || b[0] < 0) return 0;
  const bool along_v = a[0] != b[0];
  const int line = along_v ? std::max(a[0], b[0]) : std::max(a[1], b[1]);
  if (phase(line) != 0) return 0;
  const double least = Profile{}.least_slope(along_v ? a[1] : a[0]);
  return 2 * std::atan(kink(line) / std::sqrt(1 + least * least)) * 180 / M_PI;
}

}  // namespace patchproof::shell
