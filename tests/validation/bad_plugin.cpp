// SPDX-License-Identifier: Apache-2.0
// A peer that misbehaves where peers_test.py looks: it aborts on knots of multiplicity above the degree, never ends at
// degree 15, is wrong by 2^-30 for huge coordinates, writes nothing for tiny ones, refuses weights; elsewhere it is the
// template in double.
#include <cmath>
#include <cstdlib>

#include "patchproof/patch/rational_patch.h"
#include "validation/peers/peer.h"

namespace patchproof::peers {
namespace {

class BadSurface : public PreparedSurface {
 public:
  explicit BadSurface(const SurfaceData& d)
      : knots_u_(KnotVector<double>::make(d.degree_u, {d.knots_u.begin(), d.knots_u.end()}).value()),
        knots_v_(KnotVector<double>::make(d.degree_v, {d.knots_v.begin(), d.knots_v.end()}).value()) {
    for (std::size_t i = 0; i < d.points.size(); i += 3)
      net_.push_back({{d.points[i], d.points[i + 1], d.points[i + 2]}});
  }

  std::optional<Placed> evaluate(std::span<const double> u, std::span<const double> v, Quantities what,
                                 std::span<double> room) override {
    if (what != Quantities::points) return {};
    const int p = knots_u_.degree();
    for (const double t : knots_u_.breaks())
      if (t != knots_u_.domain_begin() && t != knots_u_.domain_end() && knots_u_.multiplicity(t) > p) std::abort();
    volatile bool forever = p == 15;
    while (forever) {
    }
    const BsplinePatch<double, 3> patch(knots_u_, knots_v_, net_);
    const double size = std::abs(net_.back()[0]);
    for (std::size_t i = 0; i < u.size() && size > 1e-140; ++i) {
      const Vec<double, 3> s = patchproof::evaluate(patch, u[i], v[i]);
      for (std::size_t c = 0; c < 3; ++c) room[3 * i + c] = size > 1e140 ? s[c] * (1 + 0x1p-30) : s[c];
    }
    return Placed::records(room.data(), 1);
  }

 private:
  KnotVector<double> knots_u_, knots_v_;
  std::vector<Vec<double, 3>> net_;
};

class Bad : public Peer {
 public:
  std::string name() const override { return "bad"; }
  std::vector<std::string> variants() const override { return {"only"}; }
  std::unique_ptr<PreparedSurface> prepare(const SurfaceData& d, int) const override {
    if (!d.weights.empty()) return nullptr;
    return std::make_unique<BadSurface>(d);
  }
};

}  // namespace
}  // namespace patchproof::peers

extern "C" patchproof::peers::Peer* patchproof_peer() { return new patchproof::peers::Bad; }
