// SPDX-License-Identifier: Apache-2.0
// The plug-in interface: a kernel, anybody's, that is held against the exact values and timed.
//
// A peer prepares a surface or a curve once, in any way it likes, and evaluates it at many parameters. It writes results
// where it likes in the room it is given, in the order that suits it best, and says where they lie: nothing is copied
// while time is taken. What it cannot do it refuses by answering nothing; that is counted, not held against it.
//
// To add your own: derive from Peer, and either
//   - build a shared object with   extern "C" patchproof::peers::Peer* patchproof_peer()   (example_plugin.cpp) and name
//     it:  patchproof_peers --plugin ./mine.so,  or  PATCHPROOF_PLUGINS=./mine.so ./dev bench;
//   - or list the source in the CMake variable PATCHPROOF_MORE_PEERS and call register_peer from it.
//
// REQUIRES  (of a peer) results do not depend on anything but the data and the parameters; the room is not kept.
// NEIGHBOURS corpus/truth.h (the exact values), peers_main.cpp (the comparison), ../bench/kernels_bench.cpp (the race).
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "patchproof/patch/evaluate_batch.h"

namespace patchproof::peers {

// What is asked for of each item, as vectors of three coordinates in this order:
//              surfaces                      curves
//   points     S                             C
//   first      S S_u S_v                     C C'
//   normals    S S_u S_v n, |n| = 1          -
//   second     S S_u S_v S_uu S_uv S_vv      C C' C''
enum class Quantities { points, first, normals, second };

constexpr int surface_vectors(Quantities q) {
  return q == Quantities::points ? 1 : q == Quantities::first ? 3 : q == Quantities::normals ? 4 : 6;
}
constexpr int curve_vectors(Quantities q) {
  return q == Quantities::points ? 1 : q == Quantities::first ? 2 : q == Quantities::normals ? 0 : 3;
}

// Where results lie: coordinate c of vector k of item i at first[i·item + k·vector + c·coordinate].
struct Placed {
  const double* first = nullptr;
  std::ptrdiff_t item = 0, vector = 0, coordinate = 1;
  bool u_fastest = false;  // grids: item (i, j) is the (j·count_u + i)-th; otherwise the (i·count_v + j)-th

  const double& at(std::ptrdiff_t i, int k, int c) const { return first[i * item + k * vector + c * coordinate]; }

  static Placed records(const double* first, int vectors) { return {first, 3 * vectors, 3, 1}; }
  static Placed planar(const double* first, std::ptrdiff_t items) { return {first, 3, 3 * items, 1}; }
  static Placed separate(const double* first, std::ptrdiff_t items) { return {first, 1, 3 * items, items}; }
};

class PreparedSurface {
 public:
  virtual ~PreparedSurface() = default;

  // Item i at (u[i], v[i]). `room` holds 18 doubles for each item, aligned to 64 bytes.
  virtual std::optional<Placed> evaluate(std::span<const double> u, std::span<const double> v, Quantities what,
                                         std::span<double> room) = 0;
  // All (u[i], v[j]), both increasing.
  virtual std::optional<Placed> evaluate_grid(std::span<const double>, std::span<const double>, Quantities,
                                              std::span<double>) {
    return {};
  }
  // The control points x y z of the surface with these knots added, j (along v) fastest. Empty room: computed, not copied.
  virtual bool refine(std::span<const double> /*u*/, std::span<const double> /*v*/, std::span<double>) { return false; }
  // The control points of all Bézier patches: patch (0,0), (0,1), …, each as in refine. Empty room: not copied.
  virtual bool extract_bezier(std::span<double>) { return false; }
};

class PreparedCurve {
 public:
  virtual ~PreparedCurve() = default;
  // Item i at t[i]. `sorted`: the parameters increase.
  virtual std::optional<Placed> evaluate(std::span<const double> t, bool sorted, Quantities what,
                                         std::span<double> room) = 0;
};

class Peer {
 public:
  virtual ~Peer() = default;
  virtual std::string name() const = 0;
  // Ways in which it can be asked: its interfaces, layouts, instruction sets. `variant` below is an index into these.
  virtual std::vector<std::string> variants() const = 0;
  // Empty when it refuses the data, or has no such thing. The data outlives what is prepared.
  virtual std::unique_ptr<PreparedSurface> prepare(const SurfaceData&, int /*variant*/) const { return nullptr; }
  virtual std::unique_ptr<PreparedCurve> prepare(const CurveData&, int /*variant*/) const { return nullptr; }
};

// The peers that were compiled in, each once, sorted by name.
std::vector<const Peer*> registered_peers();
// Called by a file-scope object: `const bool registered = register_peer(std::make_unique<Mine>());`
bool register_peer(std::unique_ptr<Peer> peer);
// Loads a shared object. ERRORS cannot_open: there is no such file, or no patchproof_peer in it.
Result<const Peer*> load_peer(const std::string& path);

}  // namespace patchproof::peers
