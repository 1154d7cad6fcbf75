// SPDX-License-Identifier: Apache-2.0
// Models in which edges were once lost, or judged by a pairing that was a guess. Every one is a small bilinear or quadratic
// set whose true joins are obvious.
#include <gtest/gtest.h>

#include "patchproof/io/read.h"
#include "patchproof/io/report.h"

namespace patchproof {
namespace {

// The patch o + u·du + v·dv; coordinates are number texts.
std::string square(const std::array<Rational, 3>& o, const std::array<Rational, 3>& du,
                   const std::array<Rational, 3>& dv) {
  const auto point = [&](int i, int j) {
    std::string text = "[";
    for (int c = 0; c < 3; ++c) text += (c ? ",\"" : "\"") + to_text(Rational(o[c] + i * du[c] + j * dv[c])) + "\"";
    return text + "]";
  };
  return R"({"degree":[1,1],"control_points":[[)" + point(0, 0) + "," + point(0, 1) + "],[" + point(1, 0) + "," +
         point(1, 1) + "]]}";
}

Report certify_text(const std::vector<std::string>& patches, const CertifyOptions& options = {}) {
  std::string text = R"({"format":"patchproof-model","version":1,"patches":[)";
  for (std::size_t i = 0; i < patches.size(); ++i) text += (i ? "," : "") + patches[i];
  const Result<ModelFile> file = read_model_text(text + "]}", "hard.json");
  EXPECT_TRUE(file.has_value()) << (file ? "" : file.error().text());
  return certify_model(file.value(), options);
}

Rational power_of_ten(int n) {
  Rational x(1);
  for (int i = 0; i < std::abs(n); ++i) x = x * Rational(10);
  return n < 0 ? Rational(1) / x : x;
}

// A right-angled fold along one edge, of size `size`, with its corner at (at, at, at).
std::vector<std::string> fold(const Rational& size, const Rational& at) {
  const Rational z(0);
  return {square({at, at, at}, {size, z, z}, {z, size, z}), square({at + size, at, at}, {z, z, size}, {z, size, z})};
}

TEST(HardModels, PlaceAndSizeLoseNoJoin) {
  for (const auto& [size, at] : {std::pair{0, 0}, {-200, -190}, {150, 0}, {250, 251}, {0, 17}, {-9, 12}, {0, 100}}) {
    const Report r = certify_text(fold(power_of_ten(size), power_of_ten(at)));
    ASSERT_EQ(r.joins.size(), 1u) << "size 1e" << size << " at 1e" << at;
    EXPECT_EQ(r.joins[0].certificate.c0.verdict, Verdict::proven);
    EXPECT_LE(r.joins[0].certificate.angle.lower, 90);
    EXPECT_GE(r.joins[0].certificate.angle.upper, 90);
    EXPECT_EQ(r.unmatched.size(), 6u);
    EXPECT_TRUE(r.collapsed.empty());
  }
}

TEST(HardModels, SmallFacesBesideLargeOnes) {
  for (const int n : {-6, -7, -9, -10}) {
    const Rational s = power_of_ten(n), z(0), one(1);
    std::vector<std::string> patches = fold(s, Rational(5));
    patches.push_back(square({z, z, z}, {one, z, z}, {z, one, z}));
    const Report r = certify_text(patches);
    ASSERT_EQ(r.joins.size(), 1u) << n;
    EXPECT_EQ(r.joins[0].certificate.g1.verdict, Verdict::refuted);
  }
}

TEST(HardModels, AnEdgeIsJoinedListedOrCollapsed) {
  const Rational z(0), one(1), small = power_of_ten(-5);
  const Report r =
      certify_text({square({z, z, z}, {one, z, z}, {z, one, z}), square({one, z, z}, {z, z, one}, {z, small, z})});
  for (int patch : {0, 1})
    for (const char* edge : {"u_min", "u_max", "v_min", "v_max"}) {
      const bool joined = std::any_of(r.joins.begin(), r.joins.end(), [&](const ReportedJoin& j) {
        return (j.a.patch == patch && j.a.edge == edge) || (j.b.patch == patch && j.b.edge == edge);
      });
      const bool free = std::any_of(r.unmatched.begin(), r.unmatched.end(), [&](const EdgeRange& e) {
        return e.patch == patch && std::string(to_string(e.edge)) == edge;
      });
      EXPECT_TRUE(joined || free) << patch << "." << edge;
    }
}

TEST(HardModels, KnotsBeyondTheResolutionOfDoubles) {
  const std::string knots = R"("knots":[[0,0,1,1],["1e20","1e20","100000000000000000001","100000000000000000001"]],)";
  std::vector<std::string> patches = fold(Rational(1), Rational(0));
  for (std::string& p : patches) p.insert(p.find("\"control_points\""), knots);
  EXPECT_EQ(certify_text(patches).joins.size(), 1u);
}

TEST(HardModels, TJunctionsAtAnyFractionAreExact) {
  const Rational z(0), one(1);
  for (const char* text : {"1/4500", "1/16807", "12345/99991", "0.123456789", "1/3", "7/16384"}) {
    const Rational t = *parse_scalar<Rational>(text);
    const Report r =
        certify_text({square({z, z, z}, {one, z, z}, {z, one, z}), square({one, z, z}, {one, z, z}, {z, t, z}),
                      square({one, t, z}, {one, z, z}, {z, one - t, z})});
    ASSERT_EQ(r.joins.size(), 3u) << text;
    for (const ReportedJoin& j : r.joins) EXPECT_EQ(j.certificate.g1.verdict, Verdict::proven) << text;
  }
}

// A closed square tube, and walls on top of it that each cover one of its four sides.
TEST(HardModels, AClosedEdgeMeetsItsPartnersOnBothSidesOfItsSeam) {
  const std::string tube = R"({"degree":[1,1],"knots":[[0,0,1,1],[0,0,1,2,3,4,4]],"control_points":)"
                           R"([[[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,0,0]],[[0,0,1],[1,0,1],[1,1,1],[0,1,1],[0,0,1]]]})";
  const Rational z(0), one(1);
  const std::vector<std::string> walls{
      square({z, z, one}, {z, z, one}, {one, z, z}), square({one, z, one}, {z, z, one}, {z, one, z}),
      square({one, one, one}, {z, z, one}, {-one, z, z}), square({z, one, one}, {z, z, one}, {z, -one, z})};
  std::vector<std::string> patches{tube};
  patches.insert(patches.end(), walls.begin(), walls.end());
  const Report r = certify_text(patches);
  int on_tube = 0;
  for (const ReportedJoin& j : r.joins)
    if (j.kind == JoinKind::t_junction) {
      ++on_tube;
      EXPECT_EQ(j.certificate.g1.verdict, Verdict::proven);
    }
  EXPECT_EQ(on_tube, 4);
}

TEST(HardModels, ANumericalPairingRefutesNothing) {
  const Report r = certify_text(
      {square({Rational(0), Rational(0), Rational(0)}, {Rational(1), Rational(0), Rational(0)},
              {Rational(0), Rational(1), Rational(0)}),
       R"({"degree":[1,2],"control_points":[[[1,0,0],[1,"1/3",0],[1,1,0]],[[2,0,0],[2,"1/3",0],[2,1,0]]]})"});
  ASSERT_EQ(r.joins.size(), 1u);
  EXPECT_EQ(r.joins[0].pairing, PairingKind::piecewise_linear);
  EXPECT_EQ(r.joins[0].certificate.c0.verdict, Verdict::undecided);
  EXPECT_EQ(r.joins[0].certificate.gap.lower, 0);
  EXPECT_LT(r.joins[0].certificate.gap.upper, 1e-6);
}

TEST(HardModels, AWideMatchTakesTheBetterDirection) {
  const Rational z(0), one(1), width = Rational(1) / Rational(20);
  CertifyOptions options;
  options.match_length = 0.1;
  const Report r = certify_text(
      {square({z, z, z}, {one, z, z}, {z, width, z}), square({one, width, z}, {one, z, z}, {z, -width, z})}, options);
  const auto join = std::find_if(r.joins.begin(), r.joins.end(), [](const ReportedJoin& j) {
    return j.a.edge == "u_max" && j.b.edge == "u_min" && j.a.patch == 0 && j.b.patch == 1;
  });
  ASSERT_NE(join, r.joins.end());
  EXPECT_TRUE(join->reversed);
  EXPECT_EQ(join->certificate.g1.verdict, Verdict::proven);
}

TEST(HardModels, NothingToJudgeIsNoPass) {
  const Rational z(0), one(1);
  CertifyOptions options;
  options.request.require = Continuity::c0;
  const Report r = certify_text(
      {square({z, z, z}, {one, z, z}, {z, one, z}), square({Rational(2), z, z}, {one, z, z}, {z, one, z})}, options);
  EXPECT_TRUE(r.joins.empty());
  EXPECT_EQ(r.outcome(), Outcome::undecided);
}

TEST(HardModels, AToleranceNearTheValueIsDecided) {
  // Largest gap 0.15396007: an edge (1, j, 0) against one that bulges by 0.34641016 · B_1.
  const std::string flat =
      R"({"degree":[1,3],"control_points":[[[0,0,0],[0,1,0],[0,2,0],[0,3,0]],[[1,0,0],[1,1,0],[1,2,0],[1,3,0]]]})";
  const std::string bulging =
      R"({"degree":[1,3],"control_points":[[[1,0,0],[1,1,"0.34641016"],[1,2,0],[1,3,0]],[[2,0,0],[2,1,0],[2,2,0],[2,3,0]]]})";
  for (const auto& [tolerance, expected] :
       {std::pair{0.15404, Outcome::pass}, {0.1539, Outcome::fail}, {0.15396, Outcome::fail}}) {
    CertifyOptions options;
    options.match_length = 0.3;
    options.request.gap_tolerance = tolerance;
    const Report r = certify_text({flat, bulging}, options);
    const auto join = std::find_if(r.joins.begin(), r.joins.end(), [](const ReportedJoin& j) {
      return j.a.edge == "u_max" && j.b.edge == "u_min" && j.a.patch == 0;
    });
    ASSERT_NE(join, r.joins.end());
    EXPECT_EQ(join->judgement.outcome, expected) << tolerance;
  }
}

}  // namespace
}  // namespace patchproof
