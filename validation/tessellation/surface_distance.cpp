// SPDX-License-Identifier: Apache-2.0
#include "validation/tessellation/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace patchproof::tessellation {
namespace {

constexpr int kGrid = 24;    // cells of the grid along each parameter
constexpr int kTenths = 10;  // of barycentric coordinates
constexpr int kAtPole = 16;  // steps between the parameters that are tried of a corner at a pole

struct Triangle {
  std::array<gp_XYZ, 3> corners;

  gp_XYZ at(double a, double b) const { return corners[0] * a + corners[1] * b + corners[2] * (1 - a - b); }

  double distance(const gp_XYZ& point) const {
    const gp_XYZ &o = corners[0], e = corners[1] - o, f = corners[2] - o, normal = e.Crossed(f), r = point - o;
    const double square = normal.SquareModulus();
    if (square > 0) {
      const double b = r.Crossed(f).Dot(normal) / square, c = e.Crossed(r).Dot(normal) / square;
      if (b >= 0 && c >= 0 && b + c <= 1) return std::abs(r.Dot(normal)) / std::sqrt(square);
    }
    double out = INFINITY;
    for (int k = 0; k < 3; ++k) out = std::min(out, to_side(point, corners[k], corners[(k + 1) % 3]));
    return out;
  }

 private:
  static double to_side(const gp_XYZ& point, const gp_XYZ& a, const gp_XYZ& b) {
    const gp_XYZ along = b - a;
    const double square = along.SquareModulus(),
                 t = square > 0 ? std::clamp((point - a).Dot(along) / square, 0.0, 1.0) : 0;
    return (point - a - along * t).Modulus();
  }
};

// The 66 samples of a triangle.
template <class Visit>
void at_samples(Visit visit) {
  for (int i = 0; i <= kTenths; ++i)
    for (int j = 0; i + j <= kTenths; ++j) visit(i / static_cast<double>(kTenths), j / static_cast<double>(kTenths));
}

// The parameters of a triangle's corners.
struct Corners {
  std::array<Foot, 3> feet;

  std::array<double, 2> at(double a, double b) const {
    const double c = 1 - a - b;
    return {a * feet[0].u + b * feet[1].u + c * feet[2].u, a * feet[0].v + b * feet[1].v + c * feet[2].v};
  }
  double parametric(const FaceSurface& surface, const Triangle& triangle) const {
    double out = 0;
    at_samples([&](double a, double b) {
      const auto [u, v] = at(a, b);
      out = std::max(out, surface.at(u, v).Distance(gp_Pnt(triangle.at(a, b))));
    });
    return out;
  }
};

// Whether some triangle is as near as that; else the nearest one's distance.
double to_triangles(const std::vector<Triangle>& triangles, const gp_XYZ& point, double near_enough) {
  double out = INFINITY;
  for (const Triangle& t : triangles) {
    out = std::min(out, t.distance(point));
    if (out <= near_enough) break;
  }
  return out;
}

}  // namespace

FaceSurface::FaceSurface(const TopoDS_Face& face) : surface_(std::make_shared<BRepAdaptor_Surface>(face)) {
  begin_[0] = surface_->FirstUParameter(), end_[0] = surface_->LastUParameter();
  begin_[1] = surface_->FirstVParameter(), end_[1] = surface_->LastVParameter();
  for (int i = 0; i <= kGrid; ++i)
    for (int j = 0; j <= kGrid; ++j) {
      const double u = begin_[0] + (end_[0] - begin_[0]) * i / kGrid, v = begin_[1] + (end_[1] - begin_[1]) * j / kGrid;
      grid_.push_back({u, v, at(u, v)});
    }
  for (int k = 0; k < 2; ++k)
    for (int side = 0; side < 2; ++side) {
      const auto node = [&](int i) {
        const int fixed = side * kGrid;
        return grid_[k == 0 ? fixed * (kGrid + 1) + i : i * (kGrid + 1) + fixed].at;
      };
      collapsed_[k][side] = true;
      for (int i = 1; i <= kGrid; ++i)
        collapsed_[k][side] = collapsed_[k][side] && node(i).Distance(node(0)) < 1e-7 * (1 + node(0).XYZ().Modulus());
    }
}

std::vector<Foot> FaceSurface::alternatives(const Foot& foot) const {
  std::vector<Foot> out{foot};
  const double x[2] = {foot.u, foot.v};
  for (int k = 0; k < 2; ++k)
    for (int side = 0; side < 2; ++side) {
      const double border = side == 0 ? begin_[k] : end_[k];
      if (!collapsed_[k][side] || std::abs(x[k] - border) > 1e-6 * (end_[k] - begin_[k])) continue;
      for (int i = 0; i <= kAtPole; ++i) {
        const double along = begin_[1 - k] + (end_[1 - k] - begin_[1 - k]) * i / kAtPole;
        out.push_back(k == 0 ? Foot{border, along, foot.distance} : Foot{along, border, foot.distance});
      }
    }
  return out;
}

// Gauss–Newton in the box; where a step does not lead nearer, it is damped.
Foot FaceSurface::descend(const gp_Pnt& point, double u, double v) const {
  std::array<double, 2> x{std::clamp(u, begin_[0], end_[0]), std::clamp(v, begin_[1], end_[1])};
  double distance = at(x[0], x[1]).Distance(point), damping = 0;
  for (int step = 0; step < 40; ++step) {
    gp_Pnt s;
    std::array<gp_Vec, 2> d;
    surface_->D1(x[0], x[1], s, d[0], d[1]);
    const gp_Vec r(s, point);
    std::array<double, 2> slope{r.Dot(d[0]), r.Dot(d[1])};
    double uu = d[0].Dot(d[0]), uv = d[0].Dot(d[1]), vv = d[1].Dot(d[1]);
    for (int k = 0; k < 2; ++k)  // along the border, where the way on leads out of the box
      if ((x[k] <= begin_[k] && slope[k] < 0) || (x[k] >= end_[k] && slope[k] > 0)) slope[k] = 0, uv = 0;
    const double a = uu * (1 + damping), c = vv * (1 + damping), det = a * c - uv * uv;
    std::array<double, 2> by{};
    if (det > 1e-14 * a * c) {
      by = {(c * slope[0] - uv * slope[1]) / det, (a * slope[1] - uv * slope[0]) / det};
    } else {
      by = {a > 0 ? slope[0] / a : 0, c > 0 ? slope[1] / c : 0};
    }
    std::array<double, 2> y;
    for (int k = 0; k < 2; ++k) y[k] = std::clamp(x[k] + by[k], begin_[k], end_[k]);
    const double nearer = at(y[0], y[1]).Distance(point);
    if (nearer >= distance) {
      if (damping > 1e6 || nearer == distance) break;
      damping = damping > 0 ? 10 * damping : 1e-2;
      continue;
    }
    const bool done = distance - nearer <= 1e-9 * distance;
    x = y, distance = nearer, damping *= 0.1;
    if (done) break;
  }
  return {x[0], x[1], distance};
}

Foot FaceSurface::nearest(const gp_Pnt& point) const {
  std::array<const Node*, 3> best{};
  std::array<double, 3> squares;
  squares.fill(INFINITY);
  for (const Node& node : grid_) {
    const double square = node.at.SquareDistance(point);
    for (std::size_t k = 0; k < best.size(); ++k)
      if (square < squares[k]) {
        for (std::size_t l = best.size() - 1; l > k; --l) best[l] = best[l - 1], squares[l] = squares[l - 1];
        best[k] = &node, squares[k] = square;
        break;
      }
  }
  Foot out{0, 0, INFINITY};
  for (const Node* node : best) {
    const Foot foot = descend(point, node->u, node->v);
    if (foot.distance < out.distance) out = foot;
  }
  return out;
}

Measured measure(const CertifiedMesh& mesh, const std::vector<FaceSurface>& surfaces) {
  Measured out;
  std::vector<Triangle> triangles;
  for (const auto& t : mesh.triangles) {
    triangles.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const auto& p = mesh.vertices[t[k]];
      triangles.back().corners[k] = gp_XYZ(p[0], p[1], p[2]);
    }
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const FaceSurface& surface = surfaces[mesh.faces[t]];
    const Triangle& triangle = triangles[t];
    const Foot centre = surface.nearest(gp_Pnt(triangle.at(1.0 / 3, 1.0 / 3)));
    Corners corners;
    for (int k = 0; k < 3; ++k) {
      const gp_Pnt point(triangle.corners[k]);
      corners.feet[k] = surface.descend(point, centre.u, centre.v);
      if (corners.feet[k].distance > out.corners) {  // once more, for that start may have been a bad one
        const Foot again = surface.nearest(point);
        if (again.distance < 0.5 * corners.feet[k].distance) corners.feet[k] = again;
      }
      out.corners = std::max(out.corners, corners.feet[k].distance);
    }
    double parametric = corners.parametric(surface, triangle);
    for (int k = 0; k < 3; ++k)
      for (const Foot& foot : surface.alternatives(corners.feet[k])) {
        Corners other = corners;
        other.feet[k] = foot;
        if (foot.u == corners.feet[k].u && foot.v == corners.feet[k].v) continue;
        if (const double distance = other.parametric(surface, triangle); distance < parametric)
          parametric = distance, corners = other;
      }
    out.parametric = std::max(out.parametric, parametric);
    if (parametric <= std::min(out.to_surface, out.to_mesh)) continue;
    at_samples([&](double a, double b) {
      const gp_Pnt point(triangle.at(a, b));
      const auto [u, v] = corners.at(a, b);
      const gp_Pnt partner = surface.at(u, v);
      const double distance = partner.Distance(point);
      if (distance > out.to_surface) {
        double nearest = surface.descend(point, u, v).distance;
        if (nearest > out.to_surface) nearest = std::min(nearest, surface.nearest(point).distance);
        out.to_surface = std::max(out.to_surface, nearest);
      }
      if (distance > out.to_mesh && triangle.distance(partner.XYZ()) > out.to_mesh)
        out.to_mesh = std::max(out.to_mesh, to_triangles(triangles, partner.XYZ(), out.to_mesh));
    });
  }
  return out;
}

}  // namespace patchproof::tessellation
