// SPDX-License-Identifier: Apache-2.0
// What regularity is proved with: on every box that is looked at, the enclosures of S_u and S_v contain the exact derivatives.
#include "join/gregory_regularity.h"

#include <gtest/gtest.h>

#include "support/gregory_reference.h"

namespace patchproof {
namespace {

using namespace gregory_reference;

bool contains(const Interval& x, const Rational& value) {
  return (!std::isfinite(x.inf()) || from_double(x.inf()) <= value) &&
         (!std::isfinite(x.sup()) || value <= from_double(x.sup()));
}

// Places of a box, crowded where β turns fastest: at its corners, and on rays out of them.
std::vector<Rational> places(const Rational& begin, const Rational& end) {
  std::vector<Rational> out;
  for (const Rational& share : {Rational(0), Rational(1, 100), Rational(1, 3), Rational(1)})
    out.push_back(begin + share * (end - begin));
  return out;
}

using Prove = RegularityResult (*)(const GregoryPatch<Rational>&, int, const BoxInspector&);

// How many boxes were looked at.
int check_boxes(const GregoryPatch<Rational>& patch, Prove prove, int max_boxes) {
  int boxes = 0, corners = 0;
  std::vector<std::tuple<ParameterBox<Rational>, Vec<Interval, 3>, Vec<Interval, 3>>> seen;
  {
    const RoundingGuard guard;
    prove(patch, max_boxes,
          [&](const ParameterBox<Rational>& box, const auto& du, const auto& dv) { seen.emplace_back(box, du, dv); });
  }
  for (const auto& [box, du, dv] : seen) {
    ++boxes;
    corners += (box.u_begin == 0 || box.u_end == 1) && (box.v_begin == 0 || box.v_end == 1);
    for (const Rational& u : places(box.u_begin, box.u_end))
      for (const Rational& v : places(box.v_begin, box.v_end)) {
        const SurfaceFrame<Rational> s = frame(patch, u, v, u == box.u_begin ? Side::right : Side::left,
                                               v == box.v_begin ? Side::right : Side::left);
        for (std::size_t c = 0; c < 3; ++c)
          if (!contains(du[c], s.du[c]) || !contains(dv[c], s.dv[c])) {
            ADD_FAILURE() << "component " << c << " at (" << to_text(u) << ", " << to_text(v) << ")";
            return boxes;
          }
      }
  }
  EXPECT_GE(corners, 2);  // of boxes at the corners of the square
  return boxes;
}

std::vector<GregoryPatch<Rational>> patches_of(const std::string& id) {
  const Json& one = find_case(id);
  const CurveMesh mesh = mesh_of(one.at("mesh"));
  return fill_faces<Rational>(mesh, analyse(mesh).value(), options_of(one)).value().patches;
}

TEST(GregoryRegularity, PolynomialBoxesContainTheDerivatives) {
  for (const char* id : {"A", "E3"})
    for (const GregoryPatch<Rational>& patch : patches_of(id))
      EXPECT_GE(check_boxes(patch, prove_regular_polynomial, 100), 1) << id;
}

TEST(GregoryRegularity, RationalBoxesContainTheDerivatives) {
  for (const GregoryPatch<Rational>& patch : patches_of("D"))
    EXPECT_GE(check_boxes(patch, prove_regular_rational, 60), 50);
  // Both methods speak of the same derivatives.
  EXPECT_GE(check_boxes(patches_of("A")[0], prove_regular_rational, 60), 4);
}

}  // namespace
}  // namespace patchproof
