// SPDX-License-Identifier: Apache-2.0
// Eigen's unsupported Splines module: curves only. It has no rational curves: the quotient of its homogeneous ones is
// formed here.
#include <unsupported/Eigen/Splines>

#include "validation/peers/peer.h"

namespace patchproof::peers {
namespace {

// Degrees up to this are template parameters, as Eigen is fastest; others are found at run time.
template <int Dimension, int Degree>
class EigenCurve : public PreparedCurve {
 public:
  using Spline = Eigen::Spline<double, Dimension, Degree>;

  explicit EigenCurve(const CurveData& d) {
    const int count = static_cast<int>(d.points.size() / 3);
    typename Spline::KnotVectorType knots(1, static_cast<int>(d.knots.size()));
    for (std::size_t i = 0; i < d.knots.size(); ++i) knots(static_cast<int>(i)) = d.knots[i];
    typename Spline::ControlPointVectorType points(Dimension, count);
    for (int i = 0; i < count; ++i) {
      const double w = d.weights.empty() ? 1 : d.weights[i];
      for (int c = 0; c < 3; ++c) points(c, i) = w * d.points[3 * i + c];
      if constexpr (Dimension == 4) points(3, i) = w;
    }
    spline_ = Spline(knots, points);
  }

  std::optional<Placed> evaluate(std::span<const double> t, bool, Quantities what, std::span<double> room) override {
    double* to = room.data();
    for (const double x : t) {
      if (what == Quantities::points) {
        to = put(spline_(x), 1, to);
      } else if (what == Quantities::first) {
        to = put(spline_.template derivatives<1>(x), 2, to);
      } else {
        to = put(spline_.template derivatives<2>(x), 3, to);
      }
    }
    return Placed::records(room.data(), curve_vectors(what));
  }

 private:
  template <class Derivatives>
  static double* put(const Derivatives& d, int count, double* to) {
    double* const point = to;
    for (int k = 0; k < count; ++k, to += 3)
      for (int c = 0; c < 3; ++c) {
        double x = value(d, c, k);
        if constexpr (Dimension == 4) {
          if (k == 1) x -= value(d, 3, 1) * point[c];
          if (k == 2) x -= 2 * value(d, 3, 1) * point[3 + c] + value(d, 3, 2) * point[c];
          x /= value(d, 3, 0);
        }
        to[c] = x;
      }
    return to;
  }

  // Derivatives beyond the degree are left out by Eigen: they are 0.
  template <class Derivatives>
  static double value(const Derivatives& d, int c, int k) {
    return k < d.cols() ? d(c, k) : 0;
  }

  Spline spline_;
};

class EigenSplines : public Peer {
 public:
  std::string name() const override {
    return "Eigen " + std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
           std::to_string(EIGEN_MINOR_VERSION);
  }
  std::vector<std::string> variants() const override { return {"Spline"}; }
  std::unique_ptr<PreparedCurve> prepare(const CurveData& d, int) const override {
    return d.weights.empty() ? make<3>(d) : make<4>(d);
  }

 private:
  template <int Dimension>
  static std::unique_ptr<PreparedCurve> make(const CurveData& d) {
    if (d.degree == 3) return std::make_unique<EigenCurve<Dimension, 3>>(d);
    return std::make_unique<EigenCurve<Dimension, Eigen::Dynamic>>(d);
  }
};

const bool kRegistered = register_peer(std::make_unique<EigenSplines>());

}  // namespace
}  // namespace patchproof::peers
