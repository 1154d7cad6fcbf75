// SPDX-License-Identifier: Apache-2.0
// Reports about models made by hand: no Open CASCADE here (tests/io/occt/ has the files).
#include "patchproof/io/cad.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/io_support.h"

namespace patchproof::test {
namespace {

using Patch = BsplinePatch<Rational, 4>;
using Curve = BsplineCurve<Rational, 3>;
using Point = std::array<int, 3>;

Rational q(int n, int d = 1) { return Rational(n) / Rational(d); }

// The bilinear patch with these corners, those along v first.
Patch bilinear(const std::array<Point, 4>& corners) {
  const auto k = KnotVector<Rational>::bezier(1);
  std::vector<Vec<Rational, 4>> net;
  for (const Point& p : corners) net.push_back({{q(p[0]), q(p[1]), q(p[2]), q(1)}});
  return Patch(k, k, net);
}

Curve line(const std::array<Rational, 2>& from, const std::array<Rational, 2>& to) {
  return Curve::bezier({{{from[0], from[1], q(1)}}, {{to[0], to[1], q(1)}}});
}
const Curve kUMin = line({q(0), q(0)}, {q(0), q(1)}), kUMax = line({q(1), q(0)}, {q(1), q(1)});

CadEdge edge(std::string label, CadEdgeKind kind, std::vector<CadUse> uses, std::string note = "") {
  return {std::move(label), kind, std::move(uses), 0, std::move(note)};
}

// Floor, wall and a step beyond the wall, all along x = 1; a tube that closes on itself; edges of the other kinds.
CadModel workshop() {
  CadModel model;
  model.path = "workshop.step";
  model.format = "step";
  model.sha256 = std::string(64, '0');
  model.units = "mm";
  model.notes = {"a note"};
  const auto k = KnotVector<Rational>::make(1, {q(0), q(0), q(1, 3), q(2, 3), q(1), q(1)}).value();
  std::vector<Vec<Rational, 4>> tube;
  for (const Point& p : {Point{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 0, 0}})
    for (int j = 0; j < 2; ++j) tube.push_back({{q(p[0]), q(p[1]), q(j), q(1)}});
  model.faces = {{"#1 'floor'", "plane", bilinear({{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}}})},
                 {"#2", "plane", bilinear({{{1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {1, 1, 1}}})},
                 {"#3", "plane", bilinear({{{1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}}})},
                 {"#4", "bspline", Patch(k, KnotVector<Rational>::bezier(1), tube)}};
  const CadUse floor{0, true, kUMax}, wall{1, false, kUMin}, step{2, false, kUMin};
  model.edges = {edge("#11", CadEdgeKind::shared, {floor, wall}),
                 edge("#12", CadEdgeKind::shared, {floor, step}),
                 edge("#13", CadEdgeKind::non_manifold, {wall, floor, step}),
                 edge("#14", CadEdgeKind::seam, {{3, false, kUMin}, {3, true, kUMax}}),
                 edge("#15", CadEdgeKind::free, {{0, false, kUMin}}),
                 edge("#16", CadEdgeKind::degenerate, {}),
                 edge("#17", CadEdgeKind::unusable, {}, "it has no parameter curve on a face")};
  return model;
}

std::string json_of(const Report& report) {
  std::ostringstream out;
  write_json(out, report);
  return out.str();
}

TEST(Cad, Law1_EveryKindOfEdgeIsReported) {
  const Report report = certify_cad(workshop());
  EXPECT_EQ(report.file, "workshop.step");
  EXPECT_EQ(report.units, "mm");
  EXPECT_EQ(report.decimals, Decimals::binary64);
  EXPECT_EQ(report.patch_names, (std::vector<std::string>{"#1 'floor'", "#2", "#3", "#4"}));
  ASSERT_EQ(report.joins.size(), 5u);  // of three faces: two pairs of neighbours
  const std::array<const char*, 5> edges{"#11", "#12", "#13", "#13", "#14"};
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(report.joins[i].id, i + 1);
    EXPECT_EQ(report.joins[i].a.edge, edges[i]);
    EXPECT_EQ(report.joins[i].kind, i == 4 ? JoinKind::seam : JoinKind::trimmed);
    EXPECT_EQ(report.joins[i].certificate.c0.verdict, Verdict::proven);
    EXPECT_EQ(report.joins[i].certificate.gap.upper, 0);
  }
  EXPECT_EQ(report.joins[3].a.patch, 0);
  EXPECT_EQ(report.joins[3].b.patch, 2);
  const auto holds = [&](const std::string& text) {
    return std::any_of(report.notes.begin(), report.notes.end(),
                       [&](const std::string& note) { return note.find(text) != std::string::npos; });
  };
  EXPECT_TRUE(holds("a note"));
  EXPECT_TRUE(holds("#17") && holds("it has no parameter curve on a face"));
}

TEST(Cad, AnglesLieBetweenTheFacesAsTheyAreUsed) {
  const Report report = certify_cad(workshop());
  const std::array<double, 5> angles{90, 0, 90, 0, 135};  // the tube turns from (-1, -1) to (1, 0)
  for (int i = 0; i < 5; ++i) {
    EXPECT_LE(report.joins[i].certificate.angle.lower, angles[i] + 1e-12);
    EXPECT_GE(report.joins[i].certificate.angle.upper, angles[i] - 1e-12);
    EXPECT_LE(report.joins[i].certificate.angle.upper, angles[i] * 1.01);
  }
  // A face on the other side of its edge folds back on its neighbour.
  CadModel folded = workshop();
  const Curve inside = line({q(1, 2), q(0)}, {q(1, 2), q(1)});
  folded.edges = {edge("#11", CadEdgeKind::shared, {{0, true, inside}, {0, true, inside}}),
                  edge("#12", CadEdgeKind::shared, {{0, true, inside}, {0, false, inside}})};
  const Report two = certify_cad(folded);
  EXPECT_GE(two.joins[0].certificate.angle.lower, 180 - 1e-9);
  EXPECT_LE(two.joins[1].certificate.angle.upper, 1e-9);
}

TEST(Cad, EdgesAreClassified) {
  const auto classes = [](const CadModel& model, double smooth_below) {
    CertifyOptions options;
    options.smooth_below = smooth_below;
    std::vector<EdgeClass> out;
    for (const ReportedJoin& join : certify_cad(model, options).joins) out.push_back(join.edge_class.value());
    return out;
  };
  using C = EdgeClass;
  CadModel model = workshop();
  EXPECT_EQ(classes(model, 5), (std::vector<C>{C::sharp, C::smooth, C::sharp, C::smooth, C::sharp}));
  EXPECT_EQ(classes(model, 120), (std::vector<C>{C::kinked, C::smooth, C::kinked, C::smooth, C::sharp}));
  EXPECT_EQ(classes(model, 90)[0], C::kinked);  // not above
  EXPECT_EQ(classes(model, 180), (std::vector<C>{C::kinked, C::smooth, C::kinked, C::smooth, C::kinked}));
  // The step twists from the floor's plane at one end to 45° at the other: it is no sharp edge, whatever its largest angle.
  model.faces[2].surface = bilinear({{{1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 1}}});
  EXPECT_EQ(classes(model, 5)[1], C::mixed);
  EXPECT_EQ(classes(model, 50)[1], C::kinked);
  // From 45° to 63°: sharp, and neither below nor above 50°.
  model.faces[2].surface = bilinear({{{1, 0, 0}, {1, 1, 0}, {2, 0, 1}, {2, 1, 2}}});
  EXPECT_EQ(classes(model, 5)[1], C::sharp);
  EXPECT_EQ(classes(model, 50)[1], C::mixed);
}

TEST(Cad, OfSharpEdgesNoTangentsAreAsked) {
  CadModel model = workshop();
  model.edges = {model.edges[0], model.edges[1]};
  CertifyOptions options;
  options.request.require = Continuity::g1;
  options.request.angle_tolerance = 1;
  EXPECT_EQ(certify_cad(model, options).outcome(), Outcome::pass);
  options.smooth_below = 180;  // nothing is meant to be sharp
  const Report strict = certify_cad(model, options);
  EXPECT_EQ(strict.joins[0].judgement.outcome, Outcome::fail);
  EXPECT_EQ(strict.joins[1].judgement.outcome, Outcome::pass);
  // A sharp edge must still be closed.
  options.smooth_below = 5;
  model.faces[1].surface = bilinear({{{1, 0, 0}, {1, 1, 1}, {1, 0, 1}, {1, 1, 2}}});
  EXPECT_EQ(certify_cad(model, options).joins[0].judgement.outcome, Outcome::fail);
  // An edge that is sharp in one part only is judged by its tangents.
  model.faces[2].surface = bilinear({{{1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 1}}});
  EXPECT_EQ(certify_cad(model, options).joins[1].judgement.outcome, Outcome::fail);
}

TEST(Cad, WhatCannotBeLookedAtIsNoPass) {
  CadModel model = workshop();
  CertifyOptions options;
  EXPECT_EQ(certify_cad(model, options).outcome(), Outcome::pass);  // nothing is asked
  options.request.gap_tolerance = 1;
  EXPECT_EQ(certify_cad(model, options).outcome(), Outcome::undecided);  // edge #17
  model.edges.pop_back();
  EXPECT_EQ(certify_cad(model, options).outcome(), Outcome::pass);
  model.left_out.push_back({"#5", ErrorCode::vanishing_weight, "the denominator of its surface has a zero"});
  const Report report = certify_cad(model, options);
  EXPECT_EQ(report.outcome(), Outcome::undecided);
  const auto document = nlohmann::json::parse(json_of(report));
  EXPECT_EQ(document["left_out_faces"][0]["face"], "#5");
  EXPECT_EQ(document["other_edges"].size(), 2u);
  EXPECT_EQ(document["other_edges"][0], (nlohmann::json{{"edge", "#15"}, {"kind", "free"}, {"note", ""}}));
  EXPECT_EQ(document["summary"]["edge_classes"]["sharp"], 3);
  EXPECT_EQ(document["request"]["smooth_below_degrees"], 5);
  EXPECT_EQ(document["joins"][0]["edge_class"], "sharp");
  std::ostringstream table;
  write_table(table, report);
  for (const char* part : {"left out: face #5: the denominator", "2 smooth", "3 sharp", "1 degenerate, 1 free"})
    EXPECT_NE(table.str().find(part), std::string::npos) << part << '\n' << table.str();
}

TEST(Cad, Law5_TheJobsDoNotChangeTheReport) {
  CadModel model = workshop();
  const CadEdge first = model.edges[0];
  for (int i = 0; i < 30; ++i) model.edges.push_back(first);
  CertifyOptions options;
  options.jobs = 1;
  int calls = 0;
  options.progress = [&](std::size_t, std::size_t all) { calls += all == 35; };
  const std::string one = json_of(certify_cad(model, options));
  EXPECT_EQ(calls, 35);
  options.progress = nullptr;
  for (const int jobs : {0, 2, 7}) {
    options.jobs = jobs;
    EXPECT_EQ(json_of(certify_cad(model, options)), one);
  }
}

TEST(Cad, GapsAreJudged) {
  CadModel model = workshop();
  model.faces[1].surface = bilinear({{{1, 0, 0}, {1, 1, 1}, {1, 0, 1}, {1, 1, 2}}});  // rises along the edge
  CertifyOptions options;
  options.request.gap_tolerance = 0.5;
  const Report report = certify_cad(model, options);
  EXPECT_EQ(report.joins[0].judgement.outcome, Outcome::fail);
  EXPECT_EQ(report.joins[0].certificate.gap.lower, 1);
  EXPECT_EQ(report.joins[1].judgement.outcome, Outcome::pass);
  EXPECT_EQ(report.outcome(), Outcome::fail);
}

TEST(Cad, LooksLikeCad) {
  const auto looks = [](const std::string& text) {
    const std::string path = ::testing::TempDir() + "looks_like_cad";
    std::ofstream(path, std::ios::binary) << text;
    return looks_like_cad(path);
  };
  EXPECT_TRUE(looks("ISO-10303-21;\nHEADER;"));
  EXPECT_TRUE(looks("DBRep_DrawableShape\n"));
  EXPECT_TRUE(looks("\nCASCADE Topology V1, (c) Matra-Datavision\n"));
  EXPECT_TRUE(looks(std::string(72, ' ') + "S0000001\n"));
  EXPECT_FALSE(looks(""));
  EXPECT_FALSE(looks("{\"format\": \"patchproof-model\"}"));
  EXPECT_FALSE(looks(std::string(72, ' ') + "G0000001\n"));
  EXPECT_FALSE(looks_like_cad(::testing::TempDir()));
  EXPECT_FALSE(looks_like_cad(::testing::TempDir() + "missing.step"));
}

TEST(Cad, KindsHaveNames) {
  EXPECT_STREQ(to_string(CadEdgeKind::non_manifold), "non-manifold");
  EXPECT_STREQ(to_string(CadEdgeKind::seam), "seam");
}

}  // namespace
}  // namespace patchproof::test
