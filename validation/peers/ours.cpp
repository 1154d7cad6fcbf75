// SPDX-License-Identifier: Apache-2.0
// patchproof's own kernels as a peer: each instruction set that this machine has, each layout of the output.
#include "validation/peers/peer.h"

namespace patchproof::peers {
namespace {

// planar: xyzxyz… of each vector by itself;  separate: one array for each coordinate;  records: all vectors of an item.
enum class Layout { planar, separate, records };

struct Variant {
  InstructionSet set;
  Layout layout;
};

// All layouts for the two widest sets, one for the others.
std::vector<Variant> all_variants() {
  std::vector<Variant> out;
  for (const InstructionSet set : available_instruction_sets()) {
    out.push_back({set, Layout::separate});
    if (set == InstructionSet::avx2 || set == InstructionSet::avx512 || set == InstructionSet::neon) {
      out.push_back({set, Layout::planar});
      out.push_back({set, Layout::records});
    }
  }
  return out;
}

// Where the vectors of `items` items go.
struct Places {
  Placed placed;
  std::vector<VectorArray> arrays;
};

Places places(Layout layout, std::ptrdiff_t items, int vectors, double* room) {
  Places out;
  for (int k = 0; k < vectors; ++k) {
    double* const from = room + 3 * items * k;
    switch (layout) {
      case Layout::planar: out.arrays.push_back(VectorArray::interleaved(from)); break;
      case Layout::separate: out.arrays.push_back(VectorArray::separate(from, from + items, from + 2 * items)); break;
      case Layout::records: out.arrays.push_back(VectorArray::records(room + 3 * k, 3 * vectors)); break;
    }
  }
  out.placed = layout == Layout::planar     ? Placed::planar(room, items)
               : layout == Layout::separate ? Placed::separate(room, items)
                                            : Placed::records(room, vectors);
  return out;
}

SurfaceOutput surface_output(Quantities what, const std::vector<VectorArray>& a) {
  SurfaceOutput out;
  out.point = a[0];
  if (what == Quantities::points) return out;
  out.du = a[1];
  out.dv = a[2];
  if (what == Quantities::normals) out.normal = a[3];
  if (what == Quantities::second) {
    out.duu = a[3];
    out.duv = a[4];
    out.dvv = a[5];
  }
  return out;
}

class OurSurface : public PreparedSurface {
 public:
  OurSurface(BatchSurface surface, const Variant& variant) : surface_(std::move(surface)), layout_(variant.layout) {
    options_.instructions = variant.set;
  }

  std::optional<Placed> evaluate(std::span<const double> u, std::span<const double> v, Quantities what,
                                 std::span<double> room) override {
    const Places to = places(layout_, static_cast<std::ptrdiff_t>(u.size()), surface_vectors(what), room.data());
    if (!surface_.evaluate(u, v, surface_output(what, to.arrays), options_)) return {};
    return to.placed;
  }

  std::optional<Placed> evaluate_grid(std::span<const double> u, std::span<const double> v, Quantities what,
                                      std::span<double> room) override {
    const Places to =
        places(layout_, static_cast<std::ptrdiff_t>(u.size() * v.size()), surface_vectors(what), room.data());
    if (!surface_.evaluate_grid(u, v, surface_output(what, to.arrays), options_)) return {};
    return to.placed;
  }

 private:
  BatchSurface surface_;
  Layout layout_;
  SurfaceBatchOptions options_;
};

class OurCurve : public PreparedCurve {
 public:
  OurCurve(BatchCurve curve, const Variant& variant) : curve_(std::move(curve)), layout_(variant.layout) {
    options_.instructions = variant.set;
  }

  std::optional<Placed> evaluate(std::span<const double> t, bool, Quantities what, std::span<double> room) override {
    const int vectors = curve_vectors(what);
    const Places to = places(layout_, static_cast<std::ptrdiff_t>(t.size()), vectors, room.data());
    CurveOutput out;
    out.point = to.arrays[0];
    if (vectors > 1) out.first = to.arrays[1];
    if (vectors > 2) out.second = to.arrays[2];
    if (!curve_.evaluate(t, out, options_)) return {};
    return to.placed;
  }

 private:
  BatchCurve curve_;
  Layout layout_;
  CurveBatchOptions options_;
};

class Ours : public Peer {
 public:
  std::string name() const override { return "patchproof"; }
  std::vector<std::string> variants() const override {
    std::vector<std::string> out;
    for (const Variant& v : all_variants())
      out.push_back(std::string(to_string(v.set)) + (v.layout == Layout::planar     ? " planar"
                                                     : v.layout == Layout::separate ? " separate"
                                                                                    : " records"));
    return out;
  }
  std::unique_ptr<PreparedSurface> prepare(const SurfaceData& d, int variant) const override {
    Result<BatchSurface> made = BatchSurface::make(d);
    if (!made) return nullptr;
    return std::make_unique<OurSurface>(std::move(made).value(), all_variants()[variant]);
  }
  std::unique_ptr<PreparedCurve> prepare(const CurveData& d, int variant) const override {
    Result<BatchCurve> made = BatchCurve::make(d);
    if (!made) return nullptr;
    return std::make_unique<OurCurve>(std::move(made).value(), all_variants()[variant]);
  }
};

const bool kRegistered = register_peer(std::make_unique<Ours>());

}  // namespace
}  // namespace patchproof::peers
