// SPDX-License-Identifier: Apache-2.0
// Real files against an independent witness: Open CASCADE's own evaluation of surfaces and parameter curves, in double, at
// points of every edge. No sample may lie above a certified upper bound, and at the places that the report names the lower
// bounds must be attained. Skipped without the files.
#include <fmt/format.h>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include <algorithm>
#include <cmath>
#include <set>

#include "io/occt/converted.h"
#include "io/occt/parts.h"

namespace patchproof::test {
namespace {

using Files = std::vector<std::string>;

Files real_files() {
  Files out;
  const std::filesystem::path folder = std::filesystem::path(PATCHPROOF_SOURCE_DIR) / "../shared/data";
  std::error_code none;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, none)) {
    const std::string file = entry.path().string();
    if (entry.is_regular_file() && looks_like_cad(file)) out.push_back(file);
  }
  std::sort(out.begin(), out.end());
  return out;
}

// An edge on a face as Open CASCADE evaluates it. The face lies to the left of the parameter curve of a forward edge.
struct Use {
  opencascade::handle<Geom_Surface> surface;
  opencascade::handle<Geom2d_Curve> parameters;
  double first = 0, last = 0, sign = 1;

  Use(const TopoDS_Edge& edge, const TopoDS_Face& face) {
    surface = BRep_Tool::Surface(face);
    parameters = BRep_Tool::CurveOnSurface(edge, face, first, last);
    sign = edge.Orientation() == TopAbs_FORWARD ? 1 : -1;
  }
  // How far the curve leaves the surface's domain: by rounding, and where conversions cut a plane too tightly.
  double outside() const {
    double bounds[4], most = 0;
    surface->Bounds(bounds[0], bounds[1], bounds[2], bounds[3]);
    for (int k = 0; k <= 256; ++k) {
      const gp_Pnt2d at = uv(k / 256.0);
      if (!surface->IsUPeriodic()) most = std::max({most, bounds[0] - at.X(), at.X() - bounds[1]});
      if (!surface->IsVPeriodic()) most = std::max({most, bounds[2] - at.Y(), at.Y() - bounds[3]});
    }
    return most;
  }
  gp_Pnt2d uv(double fraction) const { return parameters->Value(first + (last - first) * fraction); }
};

// Both sides at one parameter of the edge.
struct Sample {
  gp_Pnt p, q;
  gp_Vec n, m;

  double gap() const { return p.Distance(q); }
  double degrees() const { return std::atan2(n.Crossed(m).Magnitude(), n.Dot(m)) * 180 / M_PI; }
};

Sample sample(const Use& a, const Use& b, double fraction) {
  const gp_Pnt2d at_a = a.uv(fraction), at_b = b.uv(fraction);
  Sample out;
  gp_Vec pu, pv, qu, qv;
  a.surface->D1(at_a.X(), at_a.Y(), out.p, pu, pv);
  b.surface->D1(at_b.X(), at_b.Y(), out.q, qu, qv);
  // With the tangent T, n × T points into the face of a, and m × T, where the join is smooth, on and out of the face of b.
  out.n = pu.Crossed(pv) * a.sign;
  out.m = qu.Crossed(qv) * -b.sign;
  return out;
}

// The largest of many samples, and what doubles may be off.
struct Sampled {
  double gap = 0, angle = 0, longest_n = 0, longest_m = 0, rounding = 0;
  int with_angle = 0;

  // Near poles the normals are differences of nearly equal numbers and have no direction in double.
  bool has_angle(const Sample& s) const {
    return s.n.Magnitude() > 1e-6 * longest_n && s.m.Magnitude() > 1e-6 * longest_m;
  }
};

Sampled samples(const Use& a, const Use& b, int count) {
  std::vector<Sample> all;
  Sampled out;
  for (int k = 0; k < count; ++k) {
    all.push_back(sample(a, b, k / (count - 1.0)));
    const Sample& s = all.back();
    for (const gp_Pnt& x : {s.p, s.q})
      out.rounding =
          std::max({out.rounding, 1e-12 * std::fabs(x.X()), 1e-12 * std::fabs(x.Y()), 1e-12 * std::fabs(x.Z())});
    out.gap = std::max(out.gap, s.gap());
    out.longest_n = std::max(out.longest_n, s.n.Magnitude());
    out.longest_m = std::max(out.longest_m, s.m.Magnitude());
  }
  for (const Sample& s : all)
    if (out.has_angle(s)) {
      ++out.with_angle;
      out.angle = std::max(out.angle, s.degrees());
    }
  return out;
}

// Where along the edge a place of the report lies: the nearest of many parameters, then refined.
double fraction_of(const Place& at, const Use& a, const Use& b) {
  const auto distance = [&](double f) {
    const gp_Pnt2d p = a.uv(f), q = b.uv(f);
    return std::hypot(p.X() - at.a[0], p.Y() - at.a[1]) + std::hypot(q.X() - at.b[0], q.Y() - at.b[1]);
  };
  constexpr int kSteps = 512;
  int nearest = 0;
  for (int k = 1; k <= kSteps; ++k)
    if (distance(k / double(kSteps)) < distance(nearest / double(kSteps))) nearest = k;
  double low = std::max(0, nearest - 1) / double(kSteps), high = std::min(kSteps, nearest + 1) / double(kSteps);
  for (int i = 0; i < 100; ++i) {
    const double one = low + (high - low) / 3, two = high - (high - low) / 3;
    (distance(one) < distance(two) ? high : low) = distance(one) < distance(two) ? two : one;
  }
  double best = low;
  for (const double f : {high, nearest / double(kSteps)})
    if (distance(f) < distance(best)) best = f;
  // A place is held in the surfaces' domains.
  const double size = 1 + std::fabs(at.a[0]) + std::fabs(at.a[1]) + std::fabs(at.b[0]) + std::fabs(at.b[1]);
  EXPECT_LE(distance(best), 1e-7 * size + 2 * (a.outside() + b.outside()));
  return best;
}

class Witness : public ::testing::TestWithParam<std::string> {};

TEST_P(Witness, NoSampleLiesOutsideTheBounds) {
  constexpr int kSamples = 257;
  constexpr double kDegrees = 1e-6;  // of normals in double, and of atan2 near 180°
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  const Result<occt::Converted> converted = occt::read_converted(GetParam(), UnusableFaces::leave_out);
  if (!converted) {
    EXPECT_EQ(converted.error().code, ErrorCode::wrong_count) << converted.error().text();  // no face
    return;
  }
  const CadModel& model = converted->model;
  const Report report = certify_cad(model);
  ASSERT_EQ(converted->sources.size(), model.edges.size());
  std::size_t next = 0;
  int count = 0, with_angle = 0, tight_gaps = 0, tight_angles = 0;
  for (std::size_t e = 0; e < model.edges.size(); ++e) {
    const CadEdgeKind kind = model.edges[e].kind;
    if (kind != CadEdgeKind::shared && kind != CadEdgeKind::seam && kind != CadEdgeKind::non_manifold) continue;
    std::vector<Use> uses;
    for (const auto& [edge, face] : converted->sources[e]) uses.emplace_back(edge, face);
    ASSERT_EQ(uses.size(), model.edges[e].uses.size());
    for (std::size_t i = 0; i + 1 < uses.size(); ++i) {
      ASSERT_LT(next, report.joins.size());
      const ReportedJoin& join = report.joins[next++];
      ASSERT_EQ(join.a.edge, model.edges[e].label);
      const Certificate& c = join.certificate;
      const Use &a = uses[i], &b = uses[i + 1];
      const Sampled most = samples(a, b, kSamples);
      count += kSamples;
      with_angle += most.with_angle;
      // An edge along its surface's domain is certified as that edge, from which its parameter curve may be off by 2⁻⁴⁰.
      const double rounding = most.rounding * (c.rung == "taylor" ? 1 : 10);
      const std::string where = fmt::format("edge {}, {}, {}", join.a.edge, c.rung, to_string(kind));
      EXPECT_LE(most.gap, c.gap.upper * (1 + 1e-9) + rounding) << where;
      EXPECT_LE(most.angle, c.angle.upper * (1 + 1e-9) + kDegrees) << where;
      const Sample at_gap = sample(a, b, fraction_of(c.gap.at, a, b));
      EXPECT_GE(at_gap.gap(), c.gap.lower * (1 - 1e-9) - rounding) << where;
      const Sample at_angle = sample(a, b, fraction_of(c.angle.at, a, b));
      if (most.has_angle(at_angle)) {
        EXPECT_GE(at_angle.degrees(), c.angle.lower * (1 - 1e-9) - kDegrees) << where;
      }
      tight_gaps += c.gap.upper <= std::max(most.gap, at_gap.gap()) * 1.05 + 100 * rounding;
      tight_angles += c.angle.upper <= std::max(most.angle, at_angle.degrees()) * 1.05 + 0.01;
    }
  }
  EXPECT_EQ(next, report.joins.size());
  fmt::print(
      "{}: {} faces, {} edges, {} joins, {} samples, {} with an angle; upper bounds within 5 % of a sample: {} gaps, "
      "{} angles\n",
      std::filesystem::path(GetParam()).filename().string(), model.faces.size(), model.edges.size(),
      report.joins.size(), count, with_angle, tight_gaps, tight_angles);
}

std::string name_of(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = std::filesystem::path(info.param).filename().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(RealFiles, Witness, ::testing::ValuesIn(real_files()), name_of);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Witness);

TEST(WitnessFiles, AreThere) {
  if (real_files().empty()) GTEST_SKIP() << "no STEP, IGES or BREP files in ../shared/data";
  EXPECT_GE(real_files().size(), 30u);
}

}  // namespace
}  // namespace patchproof::test
