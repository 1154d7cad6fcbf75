// SPDX-License-Identifier: Apache-2.0
// Misuse of the C API ends in a status, and changes nothing.
#include <atomic>
#include <cfenv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include "c_api/owned.h"

namespace patchproof::test {
namespace {

class CApiMisuse : public testing::Test {
 protected:
  Owned<patchproof_context> context_ = make_context();
  Owned<patchproof_model> model_ = TwoSquares(0.25).make(context_);
  patchproof_context* c() const { return context_.get(); }
  patchproof_model* m() const { return model_.get(); }

  Owned<patchproof_surface> surface() const {
    return owned<patchproof_surface>(context_, [&](auto out) { return patchproof_surface_of(c(), m(), 0, out); });
  }
  void expect(patchproof_status expected, patchproof_status status, const std::string& where) {
    EXPECT_EQ(status, expected) << patchproof_error_text(c());
    patchproof_error error = sized<patchproof_error>();
    ASSERT_EQ(patchproof_last_error(c(), &error), PATCHPROOF_OK);
    EXPECT_EQ(error.status, expected);
    EXPECT_NE(string_of(error.where).find(where), std::string::npos) << string_of(error.where);
    EXPECT_FALSE(string_of(error.message).empty());
    EXPECT_EQ(string_of(error.code).empty(), expected != PATCHPROOF_BAD_DATA);
  }
  void bad_argument(patchproof_status status, const std::string& where) {
    expect(PATCHPROOF_BAD_ARGUMENT, status, where);
  }
};

TEST_F(CApiMisuse, VersionAndNames) {
  EXPECT_EQ(patchproof_abi_version(), PATCHPROOF_ABI_VERSION);
  EXPECT_STREQ(patchproof_status_name(PATCHPROOF_STOPPED), "PATCHPROOF_STOPPED");
  EXPECT_STREQ(patchproof_status_name(PATCHPROOF_INTERNAL_ERROR), "PATCHPROOF_INTERNAL_ERROR");
  EXPECT_STREQ(patchproof_status_name(-1), "unknown status");
  EXPECT_STREQ(patchproof_status_name(10), "unknown status");
  EXPECT_EQ(patchproof_from(nullptr).length, 0u);
}

TEST_F(CApiMisuse, NoContext) {
  patchproof_model* out = nullptr;
  EXPECT_EQ(patchproof_model_read_file(nullptr, patchproof_from("x"), 0, &out), PATCHPROOF_BAD_ARGUMENT);
  EXPECT_EQ(patchproof_context_create(0, nullptr), PATCHPROOF_BAD_ARGUMENT);
  patchproof_context* none = nullptr;
  EXPECT_EQ(patchproof_context_create(8, &none), PATCHPROOF_BAD_ARGUMENT);
  EXPECT_EQ(none, nullptr);
  EXPECT_NE(patchproof_error_text(nullptr), nullptr);
  EXPECT_EQ(patchproof_last_error(nullptr, nullptr), PATCHPROOF_BAD_ARGUMENT);
  EXPECT_EQ(patchproof_context_free(nullptr), PATCHPROOF_OK);
  EXPECT_EQ(patchproof_model_free(nullptr), PATCHPROOF_OK);
  EXPECT_EQ(patchproof_mesh_free(nullptr), PATCHPROOF_OK);
}

TEST_F(CApiMisuse, NullHandlesAndPlaces) {
  patchproof_model* model = nullptr;
  patchproof_surface* surface = nullptr;
  patchproof_report* report = nullptr;
  patchproof_mesh* mesh = nullptr;
  double number = 7;
  std::size_t needed = 7;
  patchproof_model_info info = sized<patchproof_model_info>();
  bad_argument(patchproof_model_read_file(c(), patchproof_from("x"), 0, nullptr), "out");
  bad_argument(patchproof_model_read_file(c(), {nullptr, 3}, 0, &model), "path");
  bad_argument(patchproof_model_read_file(c(), {"a\0b", 3}, 0, &model), "path");
  bad_argument(patchproof_model_read_text(c(), {nullptr, 1}, {}, 0, &model), "bytes");
  bad_argument(patchproof_model_read_text(c(), patchproof_from("{}"), {}, 2, &model), "decimals");
  bad_argument(patchproof_model_create(c(), nullptr, &model), "data");
  bad_argument(patchproof_model_get_info(c(), nullptr, &info), "model");
  bad_argument(patchproof_model_get_info(c(), m(), nullptr), "out");
  bad_argument(patchproof_model_write(c(), m(), 9, nullptr, 0, &needed), "format");
  bad_argument(patchproof_model_write(c(), m(), 0, nullptr, 1, &needed), "buffer");
  bad_argument(patchproof_model_write(c(), m(), 0, nullptr, 0, nullptr), "needed");
  bad_argument(patchproof_surface_of(c(), nullptr, 0, &surface), "model");
  bad_argument(patchproof_surface_of(c(), m(), 2, &surface), "patch");
  bad_argument(patchproof_surface_error_bound(c(), nullptr, 0, &number), "surface");
  bad_argument(patchproof_surface_error_bound(c(), this->surface().get(), 6, &number), "vector");
  bad_argument(patchproof_model_patch_insert_knots(c(), m(), 0, 2, nullptr, 0, &model), "direction");
  bad_argument(patchproof_model_patch_insert_knots(c(), m(), 0, 0, nullptr, 1, &model), "knots");
  bad_argument(patchproof_model_patch_elevate(c(), m(), 0, 0, -1, &model), "times");
  bad_argument(patchproof_model_curve_elevate(c(), m(), 0, 1, &model), "curve");
  bad_argument(patchproof_certify(c(), nullptr, nullptr, nullptr, &report), "model");
  bad_argument(patchproof_certify(c(), m(), nullptr, nullptr, nullptr), "out");
  bad_argument(patchproof_tessellate(c(), m(), nullptr, nullptr, &mesh), "options");
  bad_argument(patchproof_fill(c(), {nullptr, 2}, {}, nullptr, nullptr, &model, nullptr), "curve_mesh");
  EXPECT_EQ(model, nullptr);
  EXPECT_EQ(surface, nullptr);
  EXPECT_EQ(report, nullptr);
  EXPECT_EQ(mesh, nullptr);
  EXPECT_EQ(number, 7);
  EXPECT_EQ(patchproof_model_get_info(c(), m(), &info), PATCHPROOF_OK);
  EXPECT_STREQ(patchproof_error_text(c()), "");
}

TEST_F(CApiMisuse, SizesOfStructs) {
  struct Longer {
    patchproof_certify_options options;
    double newer = 0;
  } longer{};
  patchproof_report* report = nullptr;
  bad_argument(patchproof_certify(c(), m(), &longer.options, nullptr, &report), "options.struct_size");
  longer.options.struct_size = sizeof longer.options - 8;
  bad_argument(patchproof_certify(c(), m(), &longer.options, nullptr, &report), "options.struct_size");
  longer.options.struct_size = sizeof longer;  // of a newer header: what we do not know must not be asked for
  longer.newer = 1;
  bad_argument(patchproof_certify(c(), m(), &longer.options, nullptr, &report), "options");
  longer.newer = 0;
  EXPECT_EQ(patchproof_certify(c(), m(), &longer.options, nullptr, &report), PATCHPROOF_OK);
  const Owned<patchproof_report> kept(report);

  struct LongerSummary {
    patchproof_report_summary summary;
    double newer = 5;
  } summary{};
  bad_argument(patchproof_report_get_summary(c(), report, &summary.summary), "out.struct_size");
  summary.summary.struct_size = sizeof summary;
  EXPECT_EQ(patchproof_report_get_summary(c(), report, &summary.summary), PATCHPROOF_OK);
  EXPECT_EQ(summary.summary.joins, 1u);
  EXPECT_EQ(summary.summary.struct_size, sizeof summary);
  EXPECT_EQ(summary.newer, 5);
}

TEST_F(CApiMisuse, Options) {
  patchproof_report* report = nullptr;
  const auto certify = [&](auto set, const std::string& where) {
    patchproof_certify_options o = sized<patchproof_certify_options>();
    set(o);
    bad_argument(patchproof_certify(c(), m(), &o, nullptr, &report), where);
  };
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  certify([](auto& o) { o.require = PATCHPROOF_CLASS_C2; }, "require");
  certify([](auto& o) { o.has_gap = 2; }, "has_gap");
  certify([](auto& o) { o.gap_tolerance = 1; }, "gap_tolerance");  // which would not count
  certify([](auto& o) { o.angle_tolerance = 1; }, "angle_tolerance");
  certify([](auto& o) { o.curvature_tolerance = 1; }, "curvature_tolerance");
  certify([&](auto& o) { o.has_gap = 1, o.gap_tolerance = nan; }, "gap_tolerance");
  certify([&](auto& o) { o.has_gap = 1, o.gap_tolerance = -1; }, "gap_tolerance");
  certify([&](auto& o) { o.has_angle = 1, o.angle_tolerance = 181; }, "angle_tolerance");
  certify([&](auto& o) { o.seconds_per_join = infinity; }, "seconds_per_join");
  certify([&](auto& o) { o.match_length = -0.5; }, "match_length");
  certify([&](auto& o) { o.jobs = -1; }, "jobs");
  certify([&](auto& o) { o.jobs = 1025; }, "jobs");
  EXPECT_EQ(report, nullptr);
  patchproof_mesh* mesh = nullptr;
  for (const double chord : {0.0, -1.0, nan, infinity}) {
    patchproof_tessellate_options o = sized<patchproof_tessellate_options>();
    o.chord = chord;
    bad_argument(patchproof_tessellate(c(), m(), &o, nullptr, &mesh), "chord");
  }
}

TEST_F(CApiMisuse, LengthsOfBatches) {
  const Owned<patchproof_surface> s = surface();
  double u[4] = {0, 0.5, 1, 0.25}, p[12] = {};
  patchproof_derivatives out = sized<patchproof_derivatives>();
  out.point = {p, p + 1, p + 2, 3, 3};
  const auto evaluate = [&](patchproof_parameters at) {
    return patchproof_surface_evaluate(c(), s.get(), at, nullptr, &out);
  };
  bad_argument(evaluate({u, u, 4, 1}), "out.point.count");
  bad_argument(evaluate({u, nullptr, 3, 1}), "at.v");
  bad_argument(evaluate({nullptr, u, 3, 1}), "at.u");
  out.point.y = nullptr;
  bad_argument(evaluate({u, u, 3, 1}), "out.point");
  out.point.y = p + 1;
  bad_argument(patchproof_surface_evaluate(c(), s.get(), {u, u, 3, 1}, nullptr, nullptr), "out");
  out.struct_size = 3;
  bad_argument(evaluate({u, u, 3, 1}), "out.struct_size");
  out.struct_size = sizeof out;
  bad_argument(patchproof_surface_evaluate_grid(c(), s.get(), u, SIZE_MAX / 2, u, SIZE_MAX / 2, nullptr, &out),
               "u_length");
  bad_argument(patchproof_surface_evaluate_bounded(c(), s.get(), {u, u, 3, 1}, nullptr, out.point, p, 2),
               "bound_length");
  bad_argument(patchproof_surface_evaluate_rounded(c(), s.get(), {u, u, 3, 1}, nullptr, {}), "point");
  patchproof_evaluate_options options = sized<patchproof_evaluate_options>();
  options.side_u = 2;
  bad_argument(patchproof_surface_evaluate(c(), s.get(), {u, u, 3, 1}, &options, &out), "side_u");
  options.side_u = 0;
  options.threads = -2;
  bad_argument(patchproof_surface_evaluate(c(), s.get(), {u, u, 3, 1}, &options, &out), "threads");
  for (const double x : p) EXPECT_EQ(x, 0);
  EXPECT_EQ(evaluate({u, u, 3, 1}), PATCHPROOF_OK);
  u[2] = std::nan("");
  expect(PATCHPROOF_BAD_DATA, evaluate({u, u, 3, 1}), "parameter 2");
}

TEST_F(CApiMisuse, FreedHandlesAreSeenWhenTheyAreKept) {
  const Owned<patchproof_context> context = make_context(PATCHPROOF_KEEP_FREED_HANDLES);
  patchproof_model* model = TwoSquares().make(context).release();
  patchproof_surface* surface = nullptr;
  ASSERT_EQ(patchproof_surface_of(context.get(), model, 0, &surface), PATCHPROOF_OK);
  EXPECT_EQ(patchproof_model_free(model), PATCHPROOF_OK);
  EXPECT_EQ(patchproof_model_free(model), PATCHPROOF_FREED_HANDLE);
  patchproof_model_info info = sized<patchproof_model_info>();
  EXPECT_EQ(patchproof_model_get_info(context.get(), model, &info), PATCHPROOF_FREED_HANDLE);
  EXPECT_NE(std::string(patchproof_error_text(context.get())).find("freed"), std::string::npos);
  EXPECT_EQ(patchproof_model_get_info(c(), model, &info), PATCHPROOF_FREED_HANDLE) << "through another context";
  double bound = 0;
  EXPECT_EQ(patchproof_surface_error_bound(context.get(), surface, 0, &bound), PATCHPROOF_OK) << "it needs no model";
  EXPECT_EQ(patchproof_surface_free(surface), PATCHPROOF_OK);
  EXPECT_EQ(patchproof_surface_free(surface), PATCHPROOF_FREED_HANDLE);
  EXPECT_EQ(patchproof_surface_error_bound(context.get(), surface, 0, &bound), PATCHPROOF_FREED_HANDLE);

  patchproof_context* freed = make_context(PATCHPROOF_KEEP_FREED_HANDLES).release();
  EXPECT_EQ(patchproof_context_free(freed), PATCHPROOF_OK);
  EXPECT_EQ(patchproof_context_free(freed), PATCHPROOF_FREED_HANDLE);
  EXPECT_EQ(patchproof_model_get_info(freed, m(), &info), PATCHPROOF_FREED_HANDLE);
  EXPECT_NE(std::string(patchproof_error_text(freed)).find("freed"), std::string::npos);
  patchproof_error error = sized<patchproof_error>();
  EXPECT_EQ(patchproof_last_error(freed, &error), PATCHPROOF_FREED_HANDLE);
}

TEST_F(CApiMisuse, ACallbackStopsThrowsOrUsesTheContext) {
  patchproof_report* report = nullptr;
  const patchproof_callback stops{nullptr, [](void*, std::uint64_t, std::uint64_t) { return 1; }};
  expect(PATCHPROOF_STOPPED, patchproof_certify(c(), m(), nullptr, &stops, &report), "callback");
  const patchproof_callback throws{
      nullptr, [](void*, std::uint64_t, std::uint64_t) -> std::int32_t { throw std::runtime_error("no"); }};
  expect(PATCHPROOF_CALLBACK_THREW, patchproof_certify(c(), m(), nullptr, &throws, &report), "callback");
  EXPECT_EQ(report, nullptr);

  struct Seen {
    patchproof_context* context;
    patchproof_model* model;
    patchproof_status busy = PATCHPROOF_OK, freed = PATCHPROOF_OK, error = PATCHPROOF_OK;
    std::string text = {};
    std::thread::id thread = {};
  } seen{c(), m()};
  const patchproof_callback uses{&seen, [](void* user, std::uint64_t, std::uint64_t) {
                                   Seen& s = *static_cast<Seen*>(user);
                                   patchproof_model_info info = sized<patchproof_model_info>();
                                   s.busy = patchproof_model_get_info(s.context, s.model, &info);
                                   s.freed = patchproof_context_free(s.context);
                                   patchproof_error error = sized<patchproof_error>();
                                   s.error = patchproof_last_error(s.context, &error);
                                   s.text = patchproof_error_text(s.context);
                                   s.thread = std::this_thread::get_id();
                                   return 0;
                                 }};
  EXPECT_EQ(patchproof_certify(c(), m(), nullptr, &uses, &report), PATCHPROOF_OK);
  const Owned<patchproof_report> kept(report);
  EXPECT_EQ(seen.busy, PATCHPROOF_CONTEXT_BUSY);
  EXPECT_EQ(seen.freed, PATCHPROOF_CONTEXT_BUSY);
  EXPECT_EQ(seen.error, PATCHPROOF_CONTEXT_BUSY);
  EXPECT_EQ(seen.text.find("PATCHPROOF_CONTEXT_BUSY"), 0u);
  EXPECT_EQ(seen.thread, std::this_thread::get_id());
}

// Joins that would take a while are left at once.
TEST_F(CApiMisuse, StoppingIsPrompt) {
  const Owned<patchproof_model> teapot = read_example(context_, "torus.json");
  struct Calls {
    int count = 0;
    std::uint64_t done = 0;
  } calls;
  const patchproof_callback second{&calls, [](void* user, std::uint64_t done, std::uint64_t) {
                                     Calls& c = *static_cast<Calls*>(user);
                                     c.done = done;
                                     return ++c.count == 1 ? 1 : 0;
                                   }};
  patchproof_report* report = nullptr;
  expect(PATCHPROOF_STOPPED, patchproof_certify(c(), teapot.get(), nullptr, &second, &report), "callback");
  EXPECT_EQ(calls.count, 1) << "it is not asked again";
  patchproof_mesh* mesh = nullptr;
  patchproof_tessellate_options options = sized<patchproof_tessellate_options>();
  options.chord = 1e-6;
  calls.count = 0;
  expect(PATCHPROOF_STOPPED, patchproof_tessellate(c(), teapot.get(), &options, &second, &mesh), "callback");
  EXPECT_EQ(mesh, nullptr);
}

TEST_F(CApiMisuse, TheCallersFloatingPointEnvironmentHasNoInfluence) {
  const Owned<patchproof_surface> s = surface();
  double u[3] = {0.1, 0.7, 0.3}, before[9], after[9];
  patchproof_derivatives out = sized<patchproof_derivatives>();
  out.point = {before, before + 1, before + 2, 3, 3};
  ASSERT_EQ(patchproof_surface_evaluate(c(), s.get(), {u, u, 3, 1}, nullptr, &out), PATCHPROOF_OK);
  const auto json = [&] {
    const auto report =
        owned<patchproof_report>(context_, [&](auto r) { return patchproof_certify(c(), m(), nullptr, nullptr, r); });
    return written([&](char* b, std::size_t n, std::size_t* needed) {
      return patchproof_report_write(c(), report.get(), PATCHPROOF_REPORT_JSON, b, n, needed);
    });
  };
  const std::string expected = json();
  std::fenv_t environment;
  std::fegetenv(&environment);
  std::fesetround(FE_UPWARD);
#ifdef __SSE2__
  const unsigned flushes = 0x8040;
  _mm_setcsr(_mm_getcsr() | flushes);  // flush to zero, denormals are zero
#endif
  out.point = {after, after + 1, after + 2, 3, 3};
  const patchproof_status status = patchproof_surface_evaluate(c(), s.get(), {u, u, 3, 1}, nullptr, &out);
  const std::string got = json();
  EXPECT_EQ(std::fegetround(), FE_UPWARD);
#ifdef __SSE2__
  EXPECT_EQ(_mm_getcsr() & flushes, flushes);
#endif
  std::fesetenv(&environment);
  EXPECT_EQ(status, PATCHPROOF_OK);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(before[i], after[i]);
  EXPECT_EQ(got, expected);
}

TEST_F(CApiMisuse, AContextServesOneCallAtATime) {
  std::atomic<int> ok{0}, busy{0}, other{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 200; ++i) {
        patchproof_model_info info = sized<patchproof_model_info>();
        const patchproof_status status = patchproof_model_get_info(c(), m(), &info);
        ++(status == PATCHPROOF_OK ? ok : status == PATCHPROOF_CONTEXT_BUSY ? busy : other);
      }
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(ok + busy, 800);
  EXPECT_EQ(other, 0);
  EXPECT_GT(ok, 0);
}

}  // namespace
}  // namespace patchproof::test
