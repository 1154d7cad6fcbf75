// SPDX-License-Identifier: Apache-2.0
// Spheres, tori and cylinders that are exactly what their names say, over Q and over Q(√2).
//
// A quarter of the unit circle as a homogeneous quadratic (x, y, w):
//     over Q(√2):  (1, 0, 1)  (√2/2, √2/2, √2/2)  (0, 1, 1)      the usual symmetric arc
//     over Q:      (1, 0, 1)  (1, 1, 1)           (0, 2, 2)      (1−t², 2t, 1+t²): twice as fast at its beginning
// A surface of revolution with profile (r, z, w) turned by (c, s, e):  (r c, r s, z e, w e).
#include "models.h"
#include "patchproof/io/write.h"

namespace patchproof::examples {
namespace {

template <class T>
using Curve = std::vector<Vec<T, 3>>;  // homogeneous control points (x, y, w) in a plane

Curve<Quadratic> quarter(const Quadratic*) {
  const Quadratic zero(0), one(1), h(0_q, 0.5_q, 2);
  return {{{one, zero, one}}, {{h, h, h}}, {{zero, one, one}}};
}
Curve<Rational> quarter(const Rational*) { return {{{1_q, 0_q, 1_q}}, {{1_q, 1_q, 1_q}}, {{0_q, 2_q, 2_q}}}; }

template <class T>
Curve<T> quarter() {
  return quarter(static_cast<const T*>(nullptr));
}

// The arc turned by `turns` right angles.
template <class T>
Curve<T> turned(Curve<T> arc, int turns) {
  for (Vec<T, 3>& p : arc)
    for (int k = 0; k < turns; ++k) p = {{-p[1], p[0], p[2]}};
  return arc;
}

// The arc in the quadrant with these signs, by reflections.
template <class T>
Curve<T> mirrored(Curve<T> arc, int x, int y) {
  for (Vec<T, 3>& p : arc) p = {{T(x) * p[0], T(y) * p[1], p[2]}};
  return arc;
}

// Four quarters as one B-spline with double knots 1, 2, 3. REQUIRES arcs whose ends have equal weights.
template <class T>
Curve<T> full_circle() {
  Curve<T> circle = quarter<T>();
  for (int k = 1; k < 4; ++k) {
    const Curve<T> next = turned(quarter<T>(), k);
    circle.insert(circle.end(), next.begin() + 1, next.end());
  }
  return circle;
}

template <class T>
KnotVector<T> circle_knots() {
  std::vector<T> knots;
  for (const int t : {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}) knots.push_back(T(t));
  return *KnotVector<T>::make(2, std::move(knots));
}

// u along the profile, v around.
template <class T>
ModelPatch<T> revolved(std::string name, KnotVector<T> u, const Curve<T>& profile, KnotVector<T> v,
                       const Curve<T>& turn) {
  std::vector<Vec<T, 4>> net;
  for (const Vec<T, 3>& p : profile)
    for (const Vec<T, 3>& c : turn) net.push_back({{p[0] * c[0], p[0] * c[1], p[1] * c[2], p[2] * c[2]}});
  return {std::move(name), BsplinePatch<T, 4>(std::move(u), std::move(v), std::move(net)), true};
}
template <class T>
ModelPatch<T> revolved(std::string name, const Curve<T>& profile, const Curve<T>& turn) {
  return revolved(std::move(name), KnotVector<T>::bezier(static_cast<int>(profile.size()) - 1), profile,
                  KnotVector<T>::bezier(static_cast<int>(turn.size()) - 1), turn);
}

// A circle in the plane → the profile of a tube of radius r at distance R from the axis.
template <class T>
Curve<T> tube(Curve<T> circle, int R, int r) {
  for (Vec<T, 3>& p : circle) p = {{T(R) * p[2] + T(r) * p[0], T(r) * p[1], p[2]}};
  return circle;
}

// x² + y² + z² = 1: eight octants, each the mirror image of its neighbours; poles at z = ±1.
template <class T>
Model<T> sphere() {
  Model<T> model;
  for (const int z : {1, -1})
    for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}})
      model.patches.push_back(revolved("octant" + std::to_string(model.patches.size() + 1),
                                       mirrored(quarter<T>(), 1, z), mirrored(quarter<T>(), x, y)));
  return model;
}

// (√(x² + y²) − 3)² + z² = 1: one B-spline patch, closed in both directions.
Model<Quadratic> torus() {
  const KnotVector<Quadratic> knots = circle_knots<Quadratic>();
  const Curve<Quadratic> circle = full_circle<Quadratic>();
  Model<Quadratic> model;
  model.patches.push_back(revolved("torus", knots, tube(circle, 3, 1), knots, circle));
  return model;
}

// The same torus in sixteen patches over Q. Every quarter is the one before, turned: twice as fast where it begins.
Model<Rational> torus_q() {
  Model<Rational> model;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      model.patches.push_back(revolved("torus" + std::to_string(i + 1) + std::to_string(j + 1),
                                       tube(turned(quarter<Rational>(), i), 3, 1), turned(quarter<Rational>(), j)));
  return model;
}

// x² + y² = 9 between z = 0 and z = 5.
template <class T>
Curve<T> ruling() {
  return {{{T(3), T(0), T(1)}}, {{T(3), T(5), T(1)}}};
}

Model<Quadratic> cylinder() {
  Model<Quadratic> model;
  model.patches.push_back(revolved("cylinder", KnotVector<Quadratic>::bezier(1), ruling<Quadratic>(),
                                   circle_knots<Quadratic>(), full_circle<Quadratic>()));
  return model;
}

Model<Rational> cylinder_q() {
  Model<Rational> model;
  for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}})
    model.patches.push_back(revolved("quarter" + std::to_string(model.patches.size() + 1), ruling<Rational>(),
                                     mirrored(quarter<Rational>(), x, y)));
  return model;
}

}  // namespace

std::vector<NamedModel> quadrics() {
  return {{"sphere_octants.json", write_model_json(sphere<Quadratic>())},
          {"sphere_q.json", write_model_json(sphere<Rational>())},
          {"torus.json", write_model_json(torus())},
          {"torus_q.json", write_model_json(torus_q())},
          {"cylinder.json", write_model_json(cylinder())},
          {"cylinder_q.json", write_model_json(cylinder_q())}};
}

}  // namespace patchproof::examples
