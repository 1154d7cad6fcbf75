// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/evaluate_model.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "io/io_support.h"
#include "patchproof/deadline.h"
#include "patchproof/io/curve_mesh_file.h"
#include "patchproof/mesh/fill_faces.h"
#include "patchproof/parallel.h"
#include "patchproof/patch/rational_patch.h"

namespace patchproof::test {
namespace {

ModelFile example(const std::string& name) {
  Result<ModelFile> file = read_model(std::string(PATCHPROOF_SOURCE_DIR) + "/examples/" + name);
  if (!file) throw std::runtime_error(file.error().text());
  return std::move(*file);
}

// Two B-spline patches, then a GERBS patch, then two Gregory patches; a B-spline curve, then two GERBS curves (the second one is
// the first in space); a solid.
ModelFile mixed() {
  ModelFile out = example("torus_q.json");
  Model<Rational> model = rational_model(out);
  model.patches.erase(model.patches.begin() + 2, model.patches.end());
  model.gerbs_patches = rational_model(example("gerbs/plane.json")).gerbs_patches;
  const std::string two = std::string(PATCHPROOF_SOURCE_DIR) + "/examples/meshes/two_faces.json";
  const CurveMesh mesh = read_curve_mesh(two).value().mesh;
  const FilledMesh<Rational> filled = fill_faces<Rational>(mesh, analyse(mesh).value(), {}, 1).value();
  for (const auto& patch : filled.patches) model.gregory_patches.push_back({"", patch});
  model.curves = {rational_model(example("toolbox/knots.json")).curves[0]};
  model.gerbs_curves = rational_model(example("gerbs/heart_polynomial.json")).gerbs_curves;
  model.gerbs_curves.push_back(model.gerbs_curves[0]);
  model.gerbs_curves[1].dimension = 3;
  model.solids = rational_model(example("toolbox/solid.json")).solids;
  out.model = std::move(model);
  return out;
}
std::vector<ModelPart> all_parts(const ModelFile& file) {
  std::vector<ModelPart> out;
  for (const PartKind kind : {PartKind::patch, PartKind::curve, PartKind::solid})
    for (int i = 0; i < part_count(file, kind); ++i) out.push_back({kind, i});
  return out;
}

// A place at the fractions f of the domain, in texts or numbers.
template <class T>
ModelPlace<T> inside(const Model<T>& model, const ModelPart& part, const std::vector<Rational>& f) {
  ModelPlace<T> out;
  const auto domain = domain_of(model, part).value();
  for (const auto& [begin, end] : domain) out.at.push_back(begin + embed<T>(f[out.at.size()]) * (end - begin));
  return out;
}
const std::vector<std::vector<Rational>> kFractions = {{exact("1/3"), exact("2/7"), exact("4/5")},
                                                       {exact("1/2"), exact("1/2"), exact("1/2")},
                                                       {exact("0"), exact("5/9"), exact("1")}};

// z = |u − 1| + 2 |v − 1| over [0, 2]².
const std::string kRoof = R"~({"format":"patchproof-model","version":1,"patches":[{"degree":[1,1],
  "knots":[[0,0,1,2,2],[0,0,1,2,2]],"control_points":[[[0,0,3],[0,1,1],[0,2,3]],[[1,0,2],[1,1,0],[1,2,2]],
  [[2,0,3],[2,1,1],[2,2,3]]]}]})~";

TEST(EvaluateModel, Law1_RowsAreOrderedAndNamed) {
  const ModelFile file = mixed();
  const auto names = [&](const ModelPart& part, int order) {
    const PlaceText place{std::vector<std::string>(domain_of(file, part).value().size(), "1/3"), {}};
    const auto rows = evaluate_model(file, part, place, order);
    EXPECT_TRUE(rows) << rows.error().text();
    std::string out;
    for (const DerivativeText& row : *rows) {
      EXPECT_EQ(row.value.size(), part.kind == PartKind::curve ? 2U : 3U);
      out += row.name + " ";
      int total = 0;
      for (std::size_t s = 0; s < 3; ++s) {
        total += row.order[s];
        const auto letters = std::count(row.name.begin(), row.name.end(), "uvw"[s]);
        EXPECT_EQ(letters, part.kind == PartKind::curve ? 0 : row.order[s]) << row.name;
      }
      EXPECT_LE(total, order);
    }
    return out;
  };
  for (int patch = 0; patch < 5; ++patch) EXPECT_EQ(names({PartKind::patch, patch}, 2), "S S_u S_v S_uu S_uv S_vv ");
  EXPECT_EQ(names({PartKind::curve, 0}, 5), "C C' C'' C''' C^(4) C^(5) ");
  EXPECT_EQ(names({PartKind::curve, 1}, 1), "C C' ");
  EXPECT_EQ(names({PartKind::solid, 0}, 2), "V V_u V_v V_w V_uu V_uv V_uw V_vv V_vw V_ww ");
  EXPECT_EQ(names({PartKind::solid, 0}, 0), "V ");
}

// Each number is that of the part's own formula; patches follow one another as B-splines, GERBS, Gregory patches.
TEST(EvaluateModel, Law2_NumbersOfParts) {
  const ModelFile file = mixed();
  const Model<Rational>& model = rational_model(file);
  ASSERT_EQ(part_count(file, PartKind::patch), 5);
  ASSERT_EQ(part_count(model, PartKind::curve), 3);
  ASSERT_EQ(part_count(file, PartKind::solid), 1);
  for (const auto& f : kFractions)
    for (int i = 0; i < 5; ++i) {
      const ModelPart part{PartKind::patch, i};
      const ModelPlace<Rational> place = inside(model, part, f);
      const Rational &u = place.at[0], &v = place.at[1];
      const auto found = evaluate_part<Rational>(model, part, place, 1);
      ASSERT_TRUE(found) << found.error().text();
      ASSERT_EQ(found->rows.size(), 3U);
      const SurfaceFrame<Rational> s = [&]() -> SurfaceFrame<Rational> {
        if (i > 2) return frame(model.gregory_patches[i - 3].patch, u, v);
        const auto d = i < 2 ? rational_derivatives(model.patches[i].surface, u, v, 1, 1)
                             : partial_derivatives_at<Rational>(model.gerbs_patches[0].surface, {u, v},
                                                                {Side::right, Side::right}, u, v, 1, 1);
        return {d.at(0, 0), d.at(1, 0), d.at(0, 1)};
      }();
      EXPECT_EQ(found->rows[0].value, s.point);
      EXPECT_EQ(found->rows[1].value, s.du);
      EXPECT_EQ(found->rows[2].value, s.dv);
    }
  const ModelPlace<Rational> t = inside(model, {PartKind::curve, 1}, kFractions[0]);
  const auto heart = evaluate_part<Rational>(model, {PartKind::curve, 1}, t, 3);
  ASSERT_TRUE(heart) << heart.error().text();
  EXPECT_EQ(heart->dimension, 2);
  EXPECT_EQ(evaluate_part<Rational>(model, {PartKind::curve, 2}, t, 0).value().dimension, 3);
  const auto direct = derivatives_at<Rational>(model.gerbs_curves[0].curve, t.at[0], Side::right, t.at[0], 3);
  for (std::size_t k = 0; k <= 3; ++k) EXPECT_EQ(heart->rows[k].value, direct[k]);
  const ModelPlace<Rational> x = inside(model, {PartKind::solid, 0}, kFractions[0]);
  const auto solid = evaluate_part<Rational>(model, {PartKind::solid, 0}, x, 3);
  ASSERT_TRUE(solid) << solid.error().text();
  const auto series = rational_taylor(model.solids[0].map, ParameterPlace<Rational, 3>({x.at[0], x.at[1], x.at[2]}), 3);
  ASSERT_EQ(solid->rows.size(), 20U);
  for (const auto& row : solid->rows)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(row.value[c], series[c].derivative(row.order));
}

// On the unit sphere S·S = 1; so S·S_u = 0 and S_u·S_v + S·S_uv = 0, exactly, whatever the number √2.
TEST(EvaluateModel, Law2_ExactOnASphere) {
  const ModelFile file = example("sphere_octants.json");
  const auto& model = std::get<Model<Quadratic>>(file.model);
  for (int octant = 0; octant < 8; ++octant) {
    const ModelPart part{PartKind::patch, octant};
    const auto found = evaluate_part<Quadratic>(model, part, inside(model, part, kFractions[0]), 2);
    ASSERT_TRUE(found) << found.error().text();
    const auto& rows = found->rows;  // S S_u S_v S_uu S_uv S_vv
    const Quadratic zero(0);
    EXPECT_EQ(dot(rows[0].value, rows[0].value), Quadratic(1));
    EXPECT_EQ(dot(rows[0].value, rows[1].value), zero);
    EXPECT_EQ(dot(rows[0].value, rows[2].value), zero);
    EXPECT_EQ(dot(rows[1].value, rows[1].value) + dot(rows[0].value, rows[3].value), zero);
    EXPECT_EQ(dot(rows[1].value, rows[2].value) + dot(rows[0].value, rows[4].value), zero);
    EXPECT_EQ(dot(rows[2].value, rows[2].value) + dot(rows[0].value, rows[5].value), zero);
  }
}

TEST(EvaluateModel, Law2_EachParameterHasItsSide) {
  const ModelFile file = read_good(kRoof, "roof.json");
  for (const Side u : {Side::left, Side::right})
    for (const Side v : {Side::left, Side::right})
      for (const ValueScalar scalar : {ValueScalar::rational, ValueScalar::binary64}) {
        const auto rows = evaluate_model(file, {}, PlaceText{{"1", "1"}, {u, v}}, 1, scalar);
        ASSERT_TRUE(rows) << rows.error().text();
        EXPECT_EQ((*rows)[1].value, (std::vector<std::string>{"1", "0", u == Side::left ? "-1" : "1"}));
        EXPECT_EQ((*rows)[2].value, (std::vector<std::string>{"0", "1", v == Side::left ? "-2" : "2"}));
      }
  EXPECT_EQ(evaluate_model(file, {}, PlaceText{{"1", "1"}, {}}, 1).value()[1].value[2], "1");
}

template <class T>
void expect_enclosed_and_near(const Model<T>& model, const ModelPart& part, const ModelPlace<T>& place, int order) {
  const auto truth = evaluate_part<T>(model, part, place, order);
  const auto enclosed = evaluate_part<Interval>(model, part, place, order);
  const auto near = evaluate_part<double>(model, part, place, order);
  ASSERT_TRUE(truth && enclosed && near);
  ASSERT_EQ(truth->rows.size(), enclosed->rows.size());
  ASSERT_EQ(truth->rows.size(), near->rows.size());
  for (std::size_t i = 0; i < truth->rows.size(); ++i) {
    EXPECT_EQ(truth->rows[i].order, enclosed->rows[i].order);
    EXPECT_EQ(truth->rows[i].order, near->rows[i].order);
    for (std::size_t c = 0; c < 3; ++c) {
      const T& x = truth->rows[i].value[c];
      const Interval& bounds = enclosed->rows[i].value[c];
      EXPECT_LE(embed<T>(from_double(bounds.inf())), x);
      EXPECT_LE(x, embed<T>(from_double(bounds.sup())));
      const double scale = std::max(1.0, std::abs(nearest_double(x)));
      EXPECT_LT(bounds.sup() - bounds.inf(), 1e-8 * scale);
      EXPECT_LT(std::abs(near->rows[i].value[c] - nearest_double(x)), 1e-8 * scale);
    }
  }
}

TEST(EvaluateModel, Law3And4_IntervalsEncloseAndDoublesAreNear) {
  const ModelFile file = mixed(), sphere = example("sphere_octants.json");
  const auto& octants = std::get<Model<Quadratic>>(sphere.model);
  for (const auto& f : kFractions) {
    for (const ModelPart& part : all_parts(file))
      expect_enclosed_and_near(rational_model(file), part, inside(rational_model(file), part, f), 2);
    for (const int octant : {0, 3})
      expect_enclosed_and_near(octants, {PartKind::patch, octant}, inside(octants, {PartKind::patch, octant}, f), 2);
  }
}

TEST(EvaluateModel, Law4_DoublesThatOverflowAreAnError) {
  const std::string huge = "1" + std::string(299, '0');
  const ModelFile file = read_good(
      json_curve("[[0,0],[\"" + huge + "\",1],[0,0]]", ",\n\"knots\":[0,0,0,1e-20,1e-20,1e-20]"), "huge.json");
  const ModelPart curve{PartKind::curve, 0};
  ASSERT_TRUE(evaluate_model(file, curve, {{"0"}, {}}, 2));
  const auto found = evaluate_model(file, curve, {{"0"}, {}}, 2, ValueScalar::binary64);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::usage);
  EXPECT_EQ(found.error().values, "0");
}

TEST(EvaluateModel, Law5_NextToACornerOfAGregoryPatch) {
  const ModelFile file = mixed();
  const Model<Rational>& model = rational_model(file);
  const ModelPart part{PartKind::patch, 3};
  for (const ModelPlace<Rational>& place :
       {ModelPlace<Rational>{{0, 1}}, {{exact("1e-30"), exact("1e-12")}}, {{1 - exact("1e-9"), exact("1e-200")}}}) {
    const auto truth = evaluate_part<Rational>(model, part, place, 1).value();
    const auto enclosed = evaluate_part<Interval>(model, part, place, 1).value();
    const auto near = evaluate_part<double>(model, part, place, 1).value();
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const double nearest = nearest_double(truth.rows[i].value[c]);
        EXPECT_EQ(near.rows[i].value[c], nearest);
        EXPECT_LE(enclosed.rows[i].value[c].inf(), nearest);
        EXPECT_GE(enclosed.rows[i].value[c].sup(), nearest);
        EXPECT_LE(enclosed.rows[i].value[c].sup() - enclosed.rows[i].value[c].inf(), 1e-15 * (1 + std::abs(nearest)));
      }
  }
}

TEST(EvaluateModel, Law6_TextsAreTheSameNumbers) {
  const ModelFile file = mixed();
  const Model<Rational>& model = rational_model(file);
  for (const ModelPart& part : all_parts(file)) {
    PlaceText place;
    ModelPlace<Rational> numbers = inside(model, part, {exact("0.3"), exact("0.1"), exact("0.7")});
    for (const Rational& x : numbers.at) place.at.push_back(to_text(x));
    for (const ValueScalar scalar : {ValueScalar::rational, ValueScalar::interval, ValueScalar::binary64}) {
      const auto rows = evaluate_model(file, part, place, 2, scalar);
      ASSERT_TRUE(rows) << rows.error().text();
      const auto compare = [&](const auto& values) {
        ASSERT_EQ(rows->size(), values.rows.size());
        for (std::size_t i = 0; i < rows->size(); ++i) {
          ASSERT_EQ((*rows)[i].value.size(), static_cast<std::size_t>(values.dimension));
          for (int c = 0; c < values.dimension; ++c) EXPECT_EQ((*rows)[i].value[c], to_text(values.rows[i].value[c]));
        }
      };
      if (scalar == ValueScalar::rational) compare(evaluate_part<Rational>(model, part, numbers, 2).value());
      if (scalar == ValueScalar::interval) compare(evaluate_part<Interval>(model, part, numbers, 2).value());
      if (scalar == ValueScalar::binary64) compare(evaluate_part<double>(model, part, numbers, 2).value());
    }
  }
  EXPECT_EQ(evaluate_model(read_good(kRoof, "roof.json"), {}, PlaceText{{"0.1", "1/7"}, {}}).value()[0].value,
            (std::vector<std::string>{"1/10", "1/7", "183/70"}));
  EXPECT_EQ(domain_of(read_good(kRoof, "roof.json"), {}).value(),
            (std::vector<std::pair<std::string, std::string>>{{"0", "2"}, {"0", "2"}}));
}

TEST(EvaluateModel, Law7_ManyPlaces) {
  const ModelFile file = mixed();
  const ModelPart part{PartKind::patch, 4};
  std::vector<PlaceText> places;
  for (int i = 0; i < 40; ++i)
    places.push_back({{std::to_string(i) + "/41", std::to_string(i * i % 41) + "/41"}, {Side::left, Side::right}});
  for (const int jobs : {0, 1, 8}) {
    const auto many = evaluate_model(file, part, places, 1, ValueScalar::interval, jobs);
    ASSERT_TRUE(many) << many.error().text();
    ASSERT_EQ(many->size(), places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto one = evaluate_model(file, part, places[i], 1, ValueScalar::interval).value();
      for (std::size_t k = 0; k < one.size(); ++k) EXPECT_EQ((*many)[i][k].value, one[k].value);
    }
  }
  places[7].at[1] = "nan";
  places[3].at[0] = "2";
  const auto failed = evaluate_model(file, part, places, 1, ValueScalar::rational, 8);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().where, "place 3, at");
  EXPECT_EQ(failed.error().code, ErrorCode::outside_domain);
  EXPECT_TRUE(evaluate_model(file, part, std::vector<PlaceText>{}, 1).value().empty());
  const std::vector<ModelPlace<Rational>> numbers(3, {{exact("1/3"), exact("1/4")}});
  const auto values = evaluate_part<Rational>(rational_model(file), part, numbers, 1, 2);
  ASSERT_TRUE(values) << values.error().text();
  for (const auto& v : *values)
    EXPECT_EQ(v.rows[2].value,
              evaluate_part<Rational>(rational_model(file), part, numbers[0], 1).value().rows[2].value);
  const std::atomic<bool> flag{true};
  const StopScope scope(&flag);
  EXPECT_THROW((void)evaluate_model(file, part, places, 1), stop_requested);
}

TEST(EvaluateModel, Errors) {
  const ModelFile file = mixed(), roots = example("sphere_octants.json"), heart = example("gerbs/heart.json");
  const ModelPart patch{}, curve{PartKind::curve, 0}, solid{PartKind::solid, 0}, gregory{PartKind::patch, 3};
  struct Case {
    const ModelFile& file;
    ModelPart part;
    PlaceText place;
    int order;
    ErrorCode code;
    const char *where, *values;
  };
  for (const Case& c :
       {Case{file, {PartKind::patch, 5}, {{"0", "0"}, {}}, 0, ErrorCode::bad_reference, "patch", "5"},
        Case{file, {PartKind::curve, -1}, {{"0"}, {}}, 0, ErrorCode::bad_reference, "curve", "-1"},
        Case{heart, solid, {{"0", "0", "0"}, {}}, 0, ErrorCode::bad_reference, "solid", "0"},
        Case{file, patch, {{"0"}, {}}, 0, ErrorCode::usage, "at", "0"},
        Case{file, patch, {{}, {}}, 0, ErrorCode::usage, "at", ""},
        Case{file, curve, {{}, {}}, 0, ErrorCode::usage, "at", ""},
        Case{file, curve, {{"0", "0"}, {}}, 0, ErrorCode::usage, "at", "0,0"},
        Case{file, solid, {{"0", "0", "0", "0"}, {}}, 0, ErrorCode::usage, "at", "0,0,0,0"},
        Case{file, patch, {{"0", "0"}, {Side::left}}, 0, ErrorCode::usage, "at", "1"},
        Case{file, patch, {{"0", "0"}, {}}, -1, ErrorCode::usage, "derivatives", "-1"},
        Case{file, patch, {{"0", "0"}, {}}, 21, ErrorCode::usage, "derivatives", "21"},
        Case{file, patch, {{"0", "1/0"}, {}}, 0, ErrorCode::bad_number, "at", "1/0"},
        Case{file, patch, {{"", "0"}, {}}, 0, ErrorCode::bad_number, "at", ""},
        Case{file, patch, {{"0", "-1/99"}, {}}, 0, ErrorCode::outside_domain, "at", "-1/99"},
        Case{file, gregory, {{"0.0", "1"}, {}}, 2, ErrorCode::unsupported, "derivatives", "0.0,1"},
        Case{roots, patch, {{"0", "sqrt(3)/3"}, {}}, 0, ErrorCode::usage, "", "0,sqrt(3)/3"},
        Case{heart, curve, {{"1/3"}, {}}, 0, ErrorCode::unsupported, "scalar", "expo-rational(1,1,1,1/2)"}}) {
    const auto found = evaluate_model(c.file, c.part, c.place, c.order);
    ASSERT_FALSE(found) << c.where << " " << c.values;
    EXPECT_EQ(found.error().code, c.code) << found.error().text();
    EXPECT_EQ(found.error().where, c.where) << found.error().text();
    EXPECT_EQ(found.error().values, c.values) << found.error().text();
  }
  EXPECT_TRUE(evaluate_model(heart, curve, {{"1/3"}, {}}, 0, ValueScalar::interval));
  EXPECT_FALSE(domain_of(file, {PartKind::solid, 1}));
}

}  // namespace
}  // namespace patchproof::test
