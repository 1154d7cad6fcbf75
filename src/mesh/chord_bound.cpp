// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/chord_bound.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bernstein_bounds.h"
#include "patchproof/patch/boundary.h"
#include "patchproof/patch/tensor_form.h"
#include "patchproof/scalar/quadratic.h"

namespace patchproof {
namespace {

using Net = SurfacePieces::Net;
using Piece = SurfacePieces::Piece;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class R>
using Form = TensorForm<R>;
template <class R>
using Form3 = std::array<Form<R>, 3>;

template <class R>
Form3<R> operator*(const Form<R>& f, const Form3<R>& a) {
  return {f * a[0], f * a[1], f * a[2]};
}
template <class R>
Form3<R> operator-(const Form3<R>& a, const Form3<R>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class R>
Form3<R> cross_of(const Form3<R>& a, const Form3<R>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Interval enclosed(const Interval& x) { return x; }
template <class T>
Interval enclosed(const T& x) {
  return enclose(x);
}

template <class R>
Net net_of(const Form3<R>& f) {
  int m = 0, n = 0;
  for (const Form<R>& x : f) {
    m = std::max(m, x.is_empty() ? 0 : x.degree_u());
    n = std::max(n, x.is_empty() ? 0 : x.degree_v());
  }
  Net out{m, n, std::vector<Bounds>((m + 1) * static_cast<std::size_t>(n + 1))};
  for (std::size_t c = 0; c < 3; ++c) {
    if (f[c].is_empty()) continue;
    const std::vector<R> b = f[c].elevated(m, n).bernstein();
    for (std::size_t k = 0; k < b.size(); ++k) put(out.points[k], c, enclosed(b[k]));
  }
  return out;
}

struct LocalBox {
  Interval u0, u1, v0, v1;
};

Net restricted(Net net, const LocalBox& box) {
  const int rows = net.degree_u + 1, columns = net.degree_v + 1;
  if (columns > 1)
    for (int i = 0; i < rows; ++i)
      restrict_line(&net.points[static_cast<std::size_t>(i) * columns], columns, 1, box.v0, box.v1);
  if (rows > 1)
    for (int j = 0; j < columns; ++j) restrict_line(&net.points[j], rows, columns, box.u0, box.u1);
  return net;
}

Interval length_of(const Vec<Interval, 3>& p) { return sqrt(square(p[0]) + square(p[1]) + square(p[2])); }

double largest(const Net& net) {
  double out = 0;
  for (const Bounds& p : net.points) out = std::max(out, length_of(intervals(p)).sup());
  return out;
}

// A and w and what is made of them, as polynomials over R.
template <class R>
struct Homogeneous {
  Form3<R> a;
  Form<R> w;
};

template <class R, class T>
Homogeneous<R> forms(const BezierPatch<T, 4>& patch) {
  std::vector<Vec<R, 4>> net;
  for (const Vec<T, 4>& p : patch.net())
    net.push_back({{embed<R>(p[0]), embed<R>(p[1]), embed<R>(p[2]), embed<R>(p[3])}});
  const BezierPatch<R, 4> b(patch.degree(Direction::u), patch.degree(Direction::v), std::move(net));
  return {{Form<R>::from_bernstein(b, 0), Form<R>::from_bernstein(b, 1), Form<R>::from_bernstein(b, 2)},
          Form<R>::from_bernstein(b, 3)};
}

// A bicubic whose weights are not 1 has products of 81 coefficients: in intervals, unless zeros of the normal must stay zeros.
template <class R, class T>
void fill_piece(const BezierPatch<T, 4>& b, Piece& out) {
  const BezierPatch<T, 4> bu = derivative_patch(b, Direction::u), bv = derivative_patch(b, Direction::v);
  const auto f = forms<R>(b), fu = forms<R>(bu), fv = forms<R>(bv), fuu = forms<R>(derivative_patch(bu, Direction::u)),
             fuv = forms<R>(derivative_patch(bu, Direction::v)), fvv = forms<R>(derivative_patch(bv, Direction::v));
  out.position = net_of(f.a);
  if (!out.rational) {
    out.u = net_of(fu.a);
    out.v = net_of(fv.a);
    out.uu = net_of(fuu.a);
    out.uv = net_of(fuv.a);
    out.vv = net_of(fvv.a);
    out.normal = net_of(cross_of(fu.a, fv.a));
    return;
  }
  out.weight = net_of(Form3<R>{f.w, Form<R>(), Form<R>()});
  const Form<R> two = Form<R>::constant(R(2));
  const Form3<R> u = f.w * fu.a - fu.w * f.a, v = f.w * fv.a - fv.w * f.a;
  out.u = net_of(u);
  out.v = net_of(v);
  out.uu = net_of(f.w * (f.w * fuu.a - fuu.w * f.a) - two * fu.w * u);
  out.uv = net_of(f.w * (f.w * fuv.a - fuv.w * f.a) - fu.w * v - fv.w * u);
  out.vv = net_of(f.w * (f.w * fvv.a - fvv.w * f.a) - two * fv.w * v);
  out.normal = net_of(f.w * cross_of(fu.a, fv.a) - fu.w * cross_of(f.a, fv.a) - fv.w * cross_of(fu.a, f.a));
}

// Homogeneous points of an edge that are all on one ray.
template <class T>
bool has_collapsed_edge(const BezierPatch<T, 4>& b) {
  const int m = b.degree(Direction::u), n = b.degree(Direction::v);
  const auto same = [](const Vec<T, 4>& p, const Vec<T, 4>& q) {
    return p[0] * q[3] == q[0] * p[3] && p[1] * q[3] == q[1] * p[3] && p[2] * q[3] == q[2] * p[3];
  };
  bool edges[4] = {true, true, true, true};
  for (int i = 0; i <= m; ++i) {
    edges[0] = edges[0] && same(b.point(0, 0), b.point(i, 0));
    edges[1] = edges[1] && same(b.point(0, n), b.point(i, n));
  }
  for (int j = 0; j <= n; ++j) {
    edges[2] = edges[2] && same(b.point(0, 0), b.point(0, j));
    edges[3] = edges[3] && same(b.point(m, 0), b.point(m, j));
  }
  return edges[0] || edges[1] || edges[2] || edges[3];
}

template <class T>
BezierPatch<T, 4> prepared(const BezierPatch<T, 4>& b, const Vec<T, 3>& centre, bool& rational) {
  const T first = b.point(0, 0)[3];  // the value at a corner, not zero
  rational = false;
  for (const Vec<T, 4>& p : b.net()) rational = rational || !(p[3] == first);
  std::vector<Vec<T, 4>> net;
  for (Vec<T, 4> p : b.net()) {
    if (!rational) p = (T(1) / first) * p;
    if (rational && first < T(0)) p = -p;
    for (std::size_t c = 0; c < 3; ++c) p[c] = p[c] - p[3] * centre[c];
    net.push_back(p);
  }
  return BezierPatch<T, 4>(b.degree(Direction::u), b.degree(Direction::v), std::move(net));
}

// The derivatives along d at the end and at the begin of two neighbours, by the sizes of their spans, and the line between them.
template <class T>
Net jump_between(const BezierPatch<T, 4>& before, const BezierPatch<T, 4>& after, Direction d, const T& size_before,
                 const T& size_after) {
  const int along = before.degree(other(d)), across = before.degree(d);
  const auto at = [&](const BezierPatch<T, 4>& b, int i, int j) {
    return d == Direction::u ? b.point(i, j) : b.point(j, i);
  };
  std::vector<Vec<T, 4>> difference, line;
  for (int j = 0; j <= along; ++j) {
    line.push_back(at(after, 0, j));
    difference.push_back(T(across) * ((T(1) / size_after) * (at(after, 1, j) - at(after, 0, j)) -
                                      (T(1) / size_before) * (at(before, across, j) - at(before, across - 1, j))));
  }
  const auto as_patch = [&](std::vector<Vec<T, 4>> points) {
    return d == Direction::u ? BezierPatch<T, 4>(0, along, std::move(points))
                             : BezierPatch<T, 4>(along, 0, std::move(points));
  };
  const auto f = forms<Interval>(as_patch(line)), g = forms<Interval>(as_patch(difference));
  return net_of(f.w * g.a - g.w * f.a);
}

}  // namespace

double SurfaceHull::chord(double size_u, double size_v) const {
  return 0.125 * (uu * size_u * size_u + 2 * uv * size_u * size_v + vv * size_v * size_v) +
         0.5 * (jump_u * size_u + jump_v * size_v);
}

double angle_bound(const SurfaceHull& hull, const Vec<Interval, 3>& normal) {
  double steepest = 0;
  bool any = false;
  for (const auto& p : hull.normals) {
    const Vec<Interval, 3> n{{Interval(p[0][0], p[0][1]), Interval(p[1][0], p[1][1]), Interval(p[2][0], p[2][1])}};
    const Interval along = dot(n, normal);
    if (!(along.inf() > 0)) return 180;
    const Interval tangent = length_of(cross(n, normal)) / Interval(along.inf());
    if (!(tangent.sup() < kInfinity)) return 180;
    steepest = std::max(steepest, tangent.sup());
    any = true;
  }
  if (!any) return 180;
  return std::atan(steepest) * (180 / std::numbers::pi) * (1 + 0x1p-44);  // more than what atan may be wrong by
}

template <ExactField T>
SurfacePieces SurfacePieces::of(const BsplinePatch<T, 4>& patch, PieceParameters parameters) {
  const RoundingGuard guard;
  SurfacePieces out;
  const auto breaks_u = patch.knots(Direction::u).breaks(), breaks_v = patch.knots(Direction::v).breaks();
  const auto enter = [&](const std::vector<T>& breaks, std::vector<Interval>& to) {
    for (std::size_t i = 0; i < breaks.size(); ++i)
      to.push_back(parameters == PieceParameters::spans ? Interval(static_cast<double>(i)) : enclose(breaks[i]));
  };
  enter(breaks_u, out.u_);
  enter(breaks_v, out.v_);
  const auto pieces = extract_bezier(patch);
  const Vec<T, 4>& corner = pieces.front().bezier.point(0, 0);
  const Vec<T, 4>& opposite = pieces.back().bezier.net().back();
  Vec<T, 3> centre;
  for (std::size_t c = 0; c < 3; ++c) {
    out.centre_[c] = nearest_double(T((corner[c] / corner[3] + opposite[c] / opposite[3]) / T(2)));
    centre[c] = embed<T>(from_double(out.centre_[c]));
  }
  std::vector<BezierPatch<T, 4>> ready;
  for (const auto& piece : pieces) {
    out.pieces_.emplace_back();
    Piece& p = out.pieces_.back();
    ready.push_back(prepared(piece.bezier, centre, p.rational));
    if (p.rational && has_collapsed_edge(ready.back()))
      fill_piece<T>(ready.back(), p);
    else
      fill_piece<Interval>(ready.back(), p);
  }
  const int columns = static_cast<int>(breaks_v.size()) - 1;
  const bool own = parameters == PieceParameters::knots;
  for (std::size_t i = 0; i + 1 < breaks_u.size(); ++i)
    for (int j = 0; j < columns; ++j) {
      const std::size_t k = i * columns + j;
      Piece& p = out.pieces_[k];
      const auto size = [&](const std::vector<T>& breaks, std::size_t at) {
        return own ? T(breaks[at + 1] - breaks[at]) : T(1);
      };
      const auto look = [&](Direction d, std::size_t at, std::size_t before, const std::vector<T>& breaks, Net& jump,
                            bool& torn) {
        if (at == 0) return;
        const int multiplicity = patch.knots(d).multiplicity(breaks[at]), degree = patch.degree(d);
        torn = !own || multiplicity > degree;  // by spans, nothing joins across the lines
        if (!torn && multiplicity == degree)
          jump = jump_between(ready[before], ready[k], d, size(breaks, at - 1), size(breaks, at));
      };
      look(Direction::u, i, k - (i > 0 ? columns : 0), breaks_u, p.jump_u, p.torn_u);
      look(Direction::v, j, k - (j > 0 ? 1 : 0), breaks_v, p.jump_v, p.torn_v);
    }
  return out;
}
template SurfacePieces SurfacePieces::of<Rational>(const BsplinePatch<Rational, 4>&, PieceParameters);
template SurfacePieces SurfacePieces::of<Quadratic>(const BsplinePatch<Quadratic, 4>&, PieceParameters);

ParameterBox<double> SurfacePieces::domain() const {
  const auto middle = [](const Interval& x) { return x.is_point() ? x.inf() : 0.5 * (x.inf() + x.sup()); };
  return {middle(u_.front()), middle(u_.back()), middle(v_.front()), middle(v_.back())};
}

std::vector<double> SurfacePieces::breaks(Direction d) const {
  std::vector<double> out;
  for (const Interval& x : d == Direction::u ? u_ : v_)
    out.push_back(x.is_point() ? x.inf() : 0.5 * (x.inf() + x.sup()));
  return out;
}

SurfacePieces::Range SurfacePieces::touched(const std::vector<Interval>& breaks, double begin, double end) const {
  const int pieces = static_cast<int>(breaks.size()) - 1;
  int first = 0, last = pieces - 1;
  while (first < last && !(begin < breaks[first + 1].sup())) ++first;
  while (last > first && !(end > breaks[last].inf())) --last;
  return {first, last};
}

Vec<Interval, 3> SurfacePieces::point(double u, double v) const {
  const int i = touched(u_, u, u).first, j = touched(v_, v, v).first;
  const Piece& piece = pieces_[static_cast<std::size_t>(i) * count(Direction::v) + j];
  const auto local = [](const std::vector<Interval>& breaks, int k, double x) {
    return (Interval(x) - breaks[k]) / (breaks[k + 1] - breaks[k]);
  };
  const Interval s = local(u_, i, u), t = local(v_, j, v);
  const auto at = [&](Net net) {
    const int rows = net.degree_u + 1, columns = net.degree_v + 1;
    const auto run = [](Bounds* p, int count, int step, const Interval& x) {
      const Average average(x);
      for (int r = 1; r < count; ++r)
        for (int k = 0; k + r < count; ++k) average(p[k * step], p[k * step], p[(k + 1) * step]);
    };
    for (int k = 0; k < rows; ++k) run(&net.points[static_cast<std::size_t>(k) * columns], columns, 1, t);
    run(&net.points[0], rows, columns, s);
    return intervals(net.points[0]);
  };
  Vec<Interval, 3> p = at(piece.position);
  const Interval w = piece.rational ? at(piece.weight)[0] : Interval(1);
  for (std::size_t c = 0; c < 3; ++c) p[c] = (piece.rational ? p[c] / w : p[c]) + Interval(centre_[c]);
  return p;
}

SurfaceHull SurfacePieces::bound(const ParameterBox<double>& box) const {
  SurfaceHull out;
  const Range over_u = touched(u_, box.u_begin, box.u_end), over_v = touched(v_, box.v_begin, box.v_end);
  const int columns = count(Direction::v);
  // Across one line the jumps of the pieces along it do not add up: the largest does.
  std::vector<double> lines_u(over_u.last - over_u.first + 1), lines_v(over_v.last - over_v.first + 1);
  for (int i = over_u.first; i <= over_u.last; ++i)
    for (int j = over_v.first; j <= over_v.last; ++j) {
      const Piece& piece = pieces_[static_cast<std::size_t>(i) * columns + j];
      const Interval size_u = u_[i + 1] - u_[i], size_v = v_[j + 1] - v_[j];
      const auto local = [](const Interval& begin, const Interval& size, double at, bool cut, double to) {
        return cut ? Interval(to) : (Interval(at) - begin) / size;
      };
      const LocalBox part{local(u_[i], size_u, box.u_begin, i > over_u.first || box.u_begin == u_[i].inf(), 0),
                          local(u_[i], size_u, box.u_end, i < over_u.last || box.u_end == u_[i + 1].sup(), 1),
                          local(v_[j], size_v, box.v_begin, j > over_v.first || box.v_begin == v_[j].inf(), 0),
                          local(v_[j], size_v, box.v_end, j < over_v.last || box.v_end == v_[j + 1].sup(), 1)};
      Interval over_first(1), over_second(1), least(1);
      if (piece.rational) {
        double smallest = kInfinity;
        for (const auto& w : restricted(piece.weight, part).points) smallest = std::min(smallest, -w[0]);
        if (!(smallest > 0)) {
          out.uu = out.uv = out.vv = out.u = out.v = kInfinity;
          out.normals.push_back({});
          continue;
        }
        least = Interval(smallest);
        over_first = Interval(1) / (least * least);
        over_second = over_first / least;
      }
      const auto take = [&](double& to, const Net& net, const Interval& scale) {
        const double size = largest(restricted(net, part));
        to = std::max(to, size == 0 ? 0 : (Interval(0, size) * scale).sup());
      };
      take(out.u, piece.u, over_first / size_u);
      take(out.v, piece.v, over_first / size_v);
      take(out.uu, piece.uu, over_second / (size_u * size_u));
      take(out.uv, piece.uv, over_second / (size_u * size_v));
      take(out.vv, piece.vv, over_second / (size_v * size_v));
      const auto crossed = [&](double& to, const Net& jump, bool torn) {
        if (torn)
          to = kInfinity;
        else if (!jump.points.empty())
          take(to, jump, over_first);
      };
      if (i > over_u.first) crossed(lines_u[i - over_u.first], piece.jump_u, piece.torn_u);
      if (j > over_v.first) crossed(lines_v[j - over_v.first], piece.jump_v, piece.torn_v);
      for (const Bounds& n : restricted(piece.normal, part).points) {
        if (std::all_of(n.begin(), n.end(), [](double x) { return x == 0; }))
          continue;  // takes nothing away from the cone
        out.normals.push_back({{{-n[0], n[1]}, {-n[2], n[3]}, {-n[4], n[5]}}});
      }
    }
  for (const double jump : lines_u) out.jump_u += jump;
  for (const double jump : lines_v) out.jump_v += jump;
  return out;
}

}  // namespace patchproof
