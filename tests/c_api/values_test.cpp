// SPDX-License-Identifier: Apache-2.0
// What the C API answers is what the C++ library answers.
#include <cmath>
#include <cstring>

#include "c_api/owned.h"
#include "patchproof/io/evaluate_model.h"
#include "patchproof/io/read.h"
#include "patchproof/io/write.h"
#include "patchproof/patch/evaluate_batch.h"

namespace patchproof::test {
namespace {

class CApiValues : public testing::Test {
 protected:
  Owned<patchproof_context> context_ = make_context();
  patchproof_context* c() const { return context_.get(); }
  std::string json_of(const Owned<patchproof_model>& model) const {
    return written([&](char* b, std::size_t n, std::size_t* needed) {
      return patchproof_model_write(c(), model.get(), PATCHPROOF_FORMAT_JSON, b, n, needed);
    });
  }
  Owned<patchproof_model> from_text(const std::string& text) const {
    return owned<patchproof_model>(context_, [&](auto out) {
      return patchproof_model_read_text(c(), text_of(text), patchproof_from("m.json"), PATCHPROOF_DECIMALS_EXACT, out);
    });
  }
  patchproof_status create(const patchproof_model_data& data) const {
    patchproof_model* out = nullptr;
    const patchproof_status status = patchproof_model_create(c(), &data, &out);
    EXPECT_EQ(status == PATCHPROOF_OK, out != nullptr);
    patchproof_model_free(out);
    return status;
  }
  std::string error() const { return patchproof_error_text(c()); }
};

TEST_F(CApiValues, ModelsFromFilesAreThoseOfTheLibrary) {
  for (const char* name : {"cup.json", "sphere_q.json", "gerbs/heart.json", "toolbox/test12.json"}) {
    const Owned<patchproof_model> model = read_example(context_, name);
    const Result<ModelFile> file = read_model(example(name));
    ASSERT_TRUE(file) << file.error().text();
    EXPECT_EQ(json_of(model), std::visit([](const auto& m) { return write_model_json(m); }, file->model));
    patchproof_model_info info = sized<patchproof_model_info>();
    ASSERT_EQ(patchproof_model_get_info(c(), model.get(), &info), PATCHPROOF_OK);
    EXPECT_EQ(static_cast<int>(info.patches), part_count(*file, PartKind::patch));
    EXPECT_EQ(static_cast<int>(info.curves), part_count(*file, PartKind::curve));
    EXPECT_EQ(string_of(info.format), "patchproof-model");
  }
}

TEST_F(CApiValues, ArraysAreTakenExactly) {
  TwoSquares squares;
  squares.a[4] = 0.1;  // not the decimal 1/10
  squares.a[5] = -0x1.8p-1070;
  squares.data.units = patchproof_from("mm");
  squares.patches[0].name = patchproof_from("first \"one\"");
  const Owned<patchproof_model> model = squares.make(context_);
  const Owned<patchproof_model> again = from_text(json_of(model));
  patchproof_spline_info info = sized<patchproof_spline_info>();
  ASSERT_EQ(patchproof_model_patch_get_info(c(), again.get(), 0, &info), PATCHPROOF_OK);
  EXPECT_EQ(string_of(info.name), "first \"one\"");
  EXPECT_EQ(info.is_double, 1);
  EXPECT_EQ(info.is_rational, 0);
  EXPECT_EQ(info.points_u * info.points_v, 16u);
  EXPECT_EQ(info.domain[3], 1);
  double knots[8], points[48];
  patchproof_spline_buffers buffers = sized<patchproof_spline_buffers>();
  buffers.knots_v = knots;
  buffers.knots_v_length = 8;
  buffers.points = points;
  buffers.points_length = 48;
  ASSERT_EQ(patchproof_model_patch_get_data(c(), again.get(), 0, &buffers), PATCHPROOF_OK) << error();
  EXPECT_EQ(std::memcmp(points, squares.a.data(), sizeof points), 0);
  EXPECT_EQ(std::memcmp(knots, squares.knots.data(), sizeof knots), 0);
  points[0] = 77;
  buffers.knots_v_length = 7;
  EXPECT_EQ(patchproof_model_patch_get_data(c(), again.get(), 0, &buffers), PATCHPROOF_BAD_ARGUMENT);
  EXPECT_EQ(points[0], 77) << "nothing is written when one length is wrong";
}

TEST_F(CApiValues, ArraysThatCannotBeUsed) {
  TwoSquares squares;
  squares.patches[1].points_length = 47;
  EXPECT_EQ(create(squares.data), PATCHPROOF_BAD_ARGUMENT);
  EXPECT_NE(error().find("patches[1].points_length"), std::string::npos) << error();
  squares.patches[1].points_length = 48;
  squares.patches[1].weights_length = 1;
  EXPECT_EQ(create(squares.data), PATCHPROOF_BAD_ARGUMENT);
  squares.patches[1].weights_length = 0;
  squares.patches[1].degree_u = 4;
  EXPECT_EQ(create(squares.data), PATCHPROOF_BAD_ARGUMENT);
  squares.patches[1].degree_u = -1;
  EXPECT_EQ(create(squares.data), PATCHPROOF_BAD_DATA);
  squares.patches[1].degree_u = 3;
  squares.b[7] = std::nan("");
  EXPECT_EQ(create(squares.data), PATCHPROOF_BAD_DATA);
  EXPECT_NE(error().find("/patches/1/control_points/0/2/1"), std::string::npos) << error();
  squares.b[7] = INFINITY;
  EXPECT_EQ(create(squares.data), PATCHPROOF_BAD_DATA);
  squares.b[7] = 0;
  squares.patches[0].name = {"\xff", 1};
  EXPECT_EQ(create(squares.data), PATCHPROOF_BAD_DATA);
  squares.patches[0].name = {};
  patchproof_declared_join join{0, PATCHPROOF_EDGE_U_MAX, 2, PATCHPROOF_EDGE_U_MIN, 0};
  squares.data.joins = &join;
  squares.data.joins_length = 1;
  EXPECT_EQ(create(squares.data), PATCHPROOF_BAD_DATA);
  join.patch_b = 1;
  join.edge_b = 4;
  EXPECT_EQ(create(squares.data), PATCHPROOF_BAD_ARGUMENT);
  join.edge_b = PATCHPROOF_EDGE_U_MIN;
  EXPECT_EQ(create(squares.data), PATCHPROOF_OK) << error();
  const std::vector<double> zeros(16, 0.0);
  squares.patches[0].weights = zeros.data();
  squares.patches[0].weights_length = 16;
  EXPECT_EQ(create(squares.data), PATCHPROOF_BAD_DATA);
  EXPECT_NE(error().find("vanishing_weight"), std::string::npos) << error();
}

// Pairs, lists and records give the bits of the C++ batch, from either side of a knot.
TEST_F(CApiValues, BatchesAreThoseOfTheLibrary) {
  const std::vector<double> knots{0, 0, 0, 1, 1, 2, 2, 2}, line{0, 0, 1, 1};
  std::vector<double> points, weights;
  for (int i = 0; i < 10; ++i) {
    for (int k = 0; k < 3; ++k) points.push_back(std::sin(3.0 * i + k));
    weights.push_back(1 + 0.125 * i);
  }
  patchproof_surface_data data = sized<patchproof_surface_data>();
  data.degree_u = 2;
  data.degree_v = 1;
  data.knots_u = knots.data();
  data.knots_u_length = knots.size();
  data.knots_v = line.data();
  data.knots_v_length = line.size();
  data.points = points.data();
  data.points_length = points.size();
  data.weights = weights.data();
  data.weights_length = weights.size();
  const auto surface =
      owned<patchproof_surface>(context_, [&](auto out) { return patchproof_surface_create(c(), &data, out); });
  const Result<BatchSurface> batch = BatchSurface::make({2, 1, knots, line, points, weights});
  ASSERT_TRUE(batch);

  constexpr std::size_t kCount = 5000;  // more than a block of what is gathered
  std::vector<double> uv(2 * kCount), u, v;
  for (std::size_t i = 0; i < kCount; ++i) {
    uv[2 * i] = i % 7 == 0 ? 1 : 2.0 * static_cast<double>(i) / (kCount - 1);
    uv[2 * i + 1] = static_cast<double>(i * 7919 % kCount) / kCount;
    u.push_back(uv[2 * i]);
    v.push_back(uv[2 * i + 1]);
  }
  for (const Side side : {Side::right, Side::left}) {
    std::vector<double> expected(6 * kCount), got(6 * kCount), normals(3 * kCount);
    const SurfaceBatchOptions sides{side, side};
    ASSERT_TRUE(batch->evaluate(
        u, v,
        {VectorArray::records(expected.data(), 6), {}, {}, {}, {}, VectorArray::records(expected.data() + 3, 6), {}},
        sides));
    patchproof_evaluate_options options = sized<patchproof_evaluate_options>();
    options.side_u = options.side_v = side == Side::right ? PATCHPROOF_SIDE_RIGHT : PATCHPROOF_SIDE_LEFT;
    options.threads = side == Side::right ? 2 : 0;
    patchproof_derivatives out = sized<patchproof_derivatives>();
    out.point = {got.data(), got.data() + 1, got.data() + 2, kCount, 6};
    out.duv = {got.data() + 3, got.data() + 4, got.data() + 5, kCount, 6};
    out.normal = {normals.data(), normals.data() + kCount, normals.data() + 2 * kCount, kCount, 0};
    ASSERT_EQ(patchproof_surface_evaluate(c(), surface.get(), {uv.data(), uv.data() + 1, kCount, 2}, &options, &out),
              PATCHPROOF_OK)
        << error();
    EXPECT_EQ(std::memcmp(expected.data(), got.data(), 8 * got.size()), 0);
    std::fill(got.begin(), got.end(), 0);
    ASSERT_EQ(patchproof_surface_evaluate(c(), surface.get(), {u.data(), v.data(), kCount, 0}, &options, &out),
              PATCHPROOF_OK);
    EXPECT_EQ(std::memcmp(expected.data(), got.data(), 8 * got.size()), 0);
    for (std::size_t i = 0; i < kCount; ++i)
      EXPECT_NEAR(std::hypot(normals[i], normals[kCount + i], normals[2 * kCount + i]), 1, 1e-12);
  }
  // From the last to the first, and a bad one named by its place.
  std::vector<double> backward(3 * kCount), forward(3 * kCount);
  ASSERT_TRUE(batch->evaluate_correctly_rounded(u, v, VectorArray::interleaved(forward.data())));
  ASSERT_EQ(patchproof_surface_evaluate_rounded(
                c(), surface.get(), {uv.data() + 2 * kCount - 2, uv.data() + 2 * kCount - 1, kCount, -2}, nullptr,
                {backward.data(), backward.data() + 1, backward.data() + 2, kCount, 3}),
            PATCHPROOF_OK);
  for (std::size_t i = 0; i < kCount; ++i)
    EXPECT_EQ(std::memcmp(&forward[3 * i], &backward[3 * (kCount - 1 - i)], 24), 0);
  std::vector<double> bound(kCount), lower(3 * kCount), upper(3 * kCount);
  const patchproof_parameters pairs{uv.data(), uv.data() + 1, kCount, 2};
  ASSERT_EQ(patchproof_surface_evaluate_bounded(c(), surface.get(), pairs, nullptr,
                                                {backward.data(), backward.data() + 1, backward.data() + 2, kCount, 3},
                                                bound.data(), kCount),
            PATCHPROOF_OK);
  ASSERT_EQ(patchproof_surface_enclose(c(), surface.get(), pairs, nullptr,
                                       {lower.data(), lower.data() + 1, lower.data() + 2, kCount, 3},
                                       {upper.data(), upper.data() + 1, upper.data() + 2, kCount, 3}),
            PATCHPROOF_OK);
  for (std::size_t i = 0; i < 3 * kCount; ++i) {
    EXPECT_LE(std::abs(forward[i] - backward[i]), bound[i / 3] + std::abs(forward[i]) * 0x1p-53);
    EXPECT_LE(lower[i], upper[i]);
    EXPECT_LE(std::nextafter(lower[i], -INFINITY), forward[i]);
    EXPECT_GE(std::nextafter(upper[i], INFINITY), forward[i]);
  }
  uv[2 * 4321 + 1] = 1.5;
  patchproof_derivatives out = sized<patchproof_derivatives>();
  out.point = {forward.data(), forward.data() + 1, forward.data() + 2, kCount, 3};
  EXPECT_EQ(patchproof_surface_evaluate(c(), surface.get(), pairs, nullptr, &out), PATCHPROOF_BAD_DATA);
  EXPECT_NE(error().find("parameter 4321"), std::string::npos) << error();
}

TEST_F(CApiValues, CurvesAndGrids) {
  const Owned<patchproof_model> model = read_example(context_, "toolbox/test12.json");
  patchproof_spline_info info = sized<patchproof_spline_info>();
  ASSERT_EQ(patchproof_model_curve_get_info(c(), model.get(), 0, &info), PATCHPROOF_OK) << error();
  const auto curve =
      owned<patchproof_curve>(context_, [&](auto out) { return patchproof_curve_of(c(), model.get(), 0, out); });
  const double middle = (info.domain[0] + info.domain[1]) / 2;
  double p[3], d[3], bound = 0;
  patchproof_derivatives out = sized<patchproof_derivatives>();
  out.point = {p, p + 1, p + 2, 1, 3};
  out.du = {d, d + 1, d + 2, 1, 3};
  ASSERT_EQ(patchproof_curve_evaluate(c(), curve.get(), {&middle, nullptr, 1, 1}, nullptr, &out), PATCHPROOF_OK);
  ASSERT_EQ(patchproof_curve_error_bound(c(), curve.get(), PATCHPROOF_VECTOR_POINT, &bound), PATCHPROOF_OK);
  EXPECT_LT(bound, 1e-9);
  out.normal = out.point;
  EXPECT_EQ(patchproof_curve_evaluate(c(), curve.get(), {&middle, nullptr, 1, 1}, nullptr, &out),
            PATCHPROOF_BAD_ARGUMENT);
  EXPECT_EQ(patchproof_curve_evaluate(c(), curve.get(), {&middle, &middle, 1, 1}, nullptr, &out),
            PATCHPROOF_BAD_ARGUMENT);

  const Owned<patchproof_model> squares = TwoSquares(0.5).make(context_);
  const auto surface =
      owned<patchproof_surface>(context_, [&](auto s) { return patchproof_surface_of(c(), squares.get(), 1, s); });
  const double u[] = {0, 0.5, 1}, v[] = {0.25, 0.75};
  double grid[18], scattered[18], uu[6], vv[6];
  for (int i = 0; i < 6; ++i) uu[i] = u[i / 2], vv[i] = v[i % 2];
  patchproof_derivatives all = sized<patchproof_derivatives>();
  all.point = {grid, grid + 1, grid + 2, 6, 3};
  ASSERT_EQ(patchproof_surface_evaluate_grid(c(), surface.get(), u, 3, v, 2, nullptr, &all), PATCHPROOF_OK);
  all.point = {scattered, scattered + 1, scattered + 2, 6, 3};
  ASSERT_EQ(patchproof_surface_evaluate(c(), surface.get(), {uu, vv, 6, 1}, nullptr, &all), PATCHPROOF_OK);
  EXPECT_EQ(std::memcmp(grid, scattered, sizeof grid), 0);
  EXPECT_EQ(grid[12], 1.5);
}

TEST_F(CApiValues, ExactValuesAreThoseOfTheLibrary) {
  for (const char* name : {"sphere_q.json", "torus.json", "gerbs/heart.json"}) {
    const Owned<patchproof_model> model = read_example(context_, name);
    const ModelFile file = *read_model(example(name));
    const auto kind = part_count(file, PartKind::patch) > 0 ? PartKind::patch : PartKind::curve;
    const auto domain = *domain_of(file, {kind, 0});
    std::vector<std::string> at;
    for (const auto& [begin, end] : domain)
      at.push_back(to_text(Rational((*parse_scalar<Rational>(begin) + *parse_scalar<Rational>(end)) / 3)));
    std::vector<patchproof_text> texts;
    for (const std::string& t : at) texts.push_back(text_of(t));
    for (const std::int32_t scalar : {PATCHPROOF_SCALAR_RATIONAL, PATCHPROOF_SCALAR_INTERVAL}) {
      const auto rows =
          evaluate_model(file, {kind, 0}, PlaceText{at, {}}, 1,
                         scalar == PATCHPROOF_SCALAR_RATIONAL ? ValueScalar::rational : ValueScalar::interval);
      const auto call = [&](char* b, std::size_t n, std::size_t* needed) {
        return (kind == PartKind::patch ? patchproof_model_patch_evaluate_exact
                                        : patchproof_model_curve_evaluate_exact)(
            c(), model.get(), 0, texts.data(), texts.size(), nullptr, scalar, 1, b, n, needed);
      };
      if (!rows) {
        std::size_t needed = 0;
        EXPECT_EQ(call(nullptr, 0, &needed), PATCHPROOF_BAD_DATA);
        continue;
      }
      std::string expected;
      for (const DerivativeText& row : *rows) {
        for (const std::string& x : row.value) expected += x + "\n";
        if (row.value.size() == 2) expected += scalar == PATCHPROOF_SCALAR_RATIONAL ? "0\n" : "[0, 0]\n";
      }
      EXPECT_EQ(written(call), expected);
    }
  }
}

// Refinement leaves the exact point where it is; what cannot be done is refused with its number.
TEST_F(CApiValues, Refinement) {
  const Owned<patchproof_model> model = read_example(context_, "sphere_q.json");
  const std::vector<patchproof_text> at{patchproof_from("1/7"), patchproof_from("3/5")};
  const auto point = [&](const Owned<patchproof_model>& m) {
    return written([&](char* b, std::size_t n, std::size_t* needed) {
      return patchproof_model_patch_evaluate_exact(c(), m.get(), 0, at.data(), 2, nullptr, 0, 2, b, n, needed);
    });
  };
  const std::string expected = point(model);
  const patchproof_text knots[] = {patchproof_from("1/3"), patchproof_from("1/3"), patchproof_from("0.25")};
  const auto finer = owned<patchproof_model>(context_, [&](auto out) {
    return patchproof_model_patch_insert_knots(c(), model.get(), 0, PATCHPROOF_DIRECTION_V, knots, 3, out);
  });
  const auto higher = owned<patchproof_model>(context_, [&](auto out) {
    return patchproof_model_patch_elevate(c(), finer.get(), 0, PATCHPROOF_DIRECTION_U, 3, out);
  });
  EXPECT_EQ(point(finer), expected);
  EXPECT_EQ(point(higher), expected);
  const auto pieces = owned<patchproof_model>(
      context_, [&](auto out) { return patchproof_model_patch_extract_bezier(c(), higher.get(), 0, out); });
  patchproof_model_info info = sized<patchproof_model_info>();
  ASSERT_EQ(patchproof_model_get_info(c(), pieces.get(), &info), PATCHPROOF_OK);
  EXPECT_EQ(info.patches, 3u);
  patchproof_spline_info last = sized<patchproof_spline_info>();
  ASSERT_EQ(patchproof_model_patch_get_info(c(), pieces.get(), 2, &last), PATCHPROOF_OK);
  EXPECT_DOUBLE_EQ(last.domain[2], 1.0 / 3);
  EXPECT_EQ(last.is_double, 0);

  patchproof_model* none = nullptr;
  const auto insert = [&](const char* knot) {
    const patchproof_text one[] = {patchproof_from("1/2"), patchproof_from(knot)};
    return patchproof_model_patch_insert_knots(c(), model.get(), 0, PATCHPROOF_DIRECTION_U, one, 2, &none);
  };
  for (const char* bad : {"1", "0", "7/5", "1/0", "abc", ""}) {
    EXPECT_EQ(insert(bad), PATCHPROOF_BAD_DATA) << bad;
    EXPECT_NE(error().find("knots[1]"), std::string::npos) << error();
  }
  const std::vector<patchproof_text> many(10, patchproof_from("1/2"));
  EXPECT_EQ(patchproof_model_patch_insert_knots(c(), model.get(), 0, 0, many.data(), many.size(), &none),
            PATCHPROOF_BAD_DATA);
  EXPECT_EQ(patchproof_model_patch_elevate(c(), model.get(), 0, 0, 1000000000, &none), PATCHPROOF_BAD_DATA);
  EXPECT_EQ(none, nullptr);

  const Owned<patchproof_model> curves = read_example(context_, "toolbox/test12.json");
  const auto bezier = owned<patchproof_model>(
      context_, [&](auto out) { return patchproof_model_curve_extract_bezier(c(), curves.get(), 0, out); });
  ASSERT_EQ(patchproof_model_get_info(c(), bezier.get(), &info), PATCHPROOF_OK);
  EXPECT_GE(info.curves, 1u);
  EXPECT_EQ(info.patches, 0u);
}

}  // namespace
}  // namespace patchproof::test
