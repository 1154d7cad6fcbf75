// SPDX-License-Identifier: Apache-2.0
// Handles of the C API that all threads use, each with a context of its own; and one context that all try to use.
#include "patchproof/c_api.h"

#include <fstream>
#include <iterator>

#include "threads/said.h"
#include "threads/together.h"

namespace patchproof::test {
namespace {

class Context {
 public:
  explicit Context(std::uint32_t flags = 0) { EXPECT_EQ(patchproof_context_create(flags, &context_), PATCHPROOF_OK); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() { patchproof_context_free(context_); }
  operator patchproof_context*() const { return context_; }

 private:
  patchproof_context* context_ = nullptr;
};

// What a call that writes a text of unknown length writes.
template <class Write>
std::string text_of(const Write& write) {
  std::size_t needed = 0;
  if (write(nullptr, std::size_t{0}, &needed) != PATCHPROOF_BUFFER_TOO_SMALL) return "no length";
  std::string out(needed, '\0');
  const patchproof_status status = write(out.data(), needed, &needed);
  return status == PATCHPROOF_OK ? out : patchproof_status_name(status);
}
std::string said_of(const patchproof_text& text) { return {text.data, text.length}; }

template <class S>
S sized() {
  S out{};
  out.struct_size = sizeof(S);
  return out;
}

const char* const kModelFile = PATCHPROOF_SOURCE_DIR "/examples/torus_q.json";
const char* const kMeshFile = PATCHPROOF_SOURCE_DIR "/examples/meshes/two_faces.json";

// Handles that are made once, by this thread.
struct Shared {
  patchproof_model *model = nullptr, *curves = nullptr;
  patchproof_surface* surface = nullptr;
  patchproof_curve* curve = nullptr;
  patchproof_report* report = nullptr;
  patchproof_mesh* mesh = nullptr;
  Shared() {
    const Context context;
    const auto ok = [&](patchproof_status status) {
      EXPECT_EQ(status, PATCHPROOF_OK) << patchproof_error_text(context);
    };
    ok(patchproof_model_read_file(context, patchproof_from(kModelFile), PATCHPROOF_DECIMALS_EXACT, &model));
    ok(patchproof_model_read_file(context, patchproof_from(PATCHPROOF_SOURCE_DIR "/examples/toolbox/test10.json"),
                                  PATCHPROOF_DECIMALS_EXACT, &curves));
    ok(patchproof_surface_of(context, model, 0, &surface));
    ok(patchproof_curve_of(context, curves, 0, &curve));
    auto certify = sized<patchproof_certify_options>();
    certify.jobs = 1;
    certify.seconds_per_join = 1e5;
    ok(patchproof_certify(context, model, &certify, nullptr, &report));
    auto tessellate = sized<patchproof_tessellate_options>();
    tessellate.chord = 0.5;
    tessellate.jobs = 1;
    ok(patchproof_tessellate(context, model, &tessellate, nullptr, &mesh));
  }
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;
  ~Shared() {
    patchproof_mesh_free(mesh);
    patchproof_report_free(report);
    patchproof_curve_free(curve);
    patchproof_surface_free(surface);
    patchproof_model_free(curves);
    patchproof_model_free(model);
  }
};

std::string written(patchproof_context* context, const patchproof_model* model) {
  return text_of([&](char* buffer, std::size_t length, std::size_t* needed) {
    return patchproof_model_write(context, model, PATCHPROOF_FORMAT_JSON, buffer, length, needed);
  });
}

// The model that a call makes, as text, and what the call said.
template <class Make>
std::string made(const Make& make) {
  const Context context;
  patchproof_model* model = nullptr;
  const patchproof_status status = make(context, &model);
  const std::string out = say(status, patchproof_error_text(context), model ? written(context, model) : "no model");
  patchproof_model_free(model);
  return out;
}

std::string info_of(const patchproof_model* model) {
  const Context context;
  auto info = sized<patchproof_model_info>();
  auto patch = sized<patchproof_spline_info>();
  Said out;
  out.add(patchproof_model_get_info(context, model, &info));
  out.add(info.patches), out.add(info.curves), out.add(said_of(info.format)), out.add(said_of(info.units));
  out.add(patchproof_model_patch_get_info(context, model, 0, &patch));
  out.add(patch.degree_u), out.add(patch.points_u), out.add(std::to_array(patch.domain)), out.add(said_of(patch.name));
  std::vector<double> knots_u(patch.knots_u), knots_v(patch.knots_v), points(3 * patch.points_u * patch.points_v),
      weights(patch.points_u * patch.points_v);
  auto into = sized<patchproof_spline_buffers>();
  into.knots_u = knots_u.data(), into.knots_u_length = knots_u.size();
  into.knots_v = knots_v.data(), into.knots_v_length = knots_v.size();
  into.points = points.data(), into.points_length = points.size();
  into.weights = weights.data(), into.weights_length = weights.size();
  out.add(patchproof_model_patch_get_data(context, model, 0, &into));
  out.add(knots_u), out.add(knots_v), out.add(points), out.add(weights);
  out.add(patchproof_model_patch_get_info(context, model, 99, &patch)), out.add(patchproof_error_text(context));
  return out.text();
}

std::string values_of(const patchproof_surface* surface, const patchproof_curve* curve) {
  const Context context;
  std::vector<double> uv, point(300), du(300), normal(300), lower(300), upper(300), rounded(300), bound(100);
  for (int i = 0; i < 100; ++i) uv.push_back(i / 99.0), uv.push_back(i * i / 9801.0);
  const patchproof_parameters at{uv.data(), uv.data() + 1, 100, 2};
  const auto into = [](std::vector<double>& x) { return patchproof_vectors{&x[0], &x[1], &x[2], 100, 3}; };
  auto wanted = sized<patchproof_derivatives>();
  wanted.point = into(point), wanted.du = into(du), wanted.normal = into(normal);
  Said out;
  out.add(patchproof_surface_evaluate(context, surface, at, nullptr, &wanted));
  out.add(patchproof_surface_enclose(context, surface, at, nullptr, into(lower), into(upper)));
  out.add(patchproof_surface_evaluate_rounded(context, surface, at, nullptr, into(rounded)));
  out.add(point), out.add(du), out.add(normal), out.add(lower), out.add(upper), out.add(rounded);
  out.add(patchproof_surface_evaluate_bounded(context, surface, at, nullptr, into(point), bound.data(), bound.size()));
  double most = 0;
  out.add(patchproof_surface_error_bound(context, surface, PATCHPROOF_VECTOR_DUV, &most));
  out.add(point), out.add(bound), out.add(most);
  const std::vector<double> lines{0, 0.25, 0.5, 1};
  std::vector<double> grid(48);
  auto of_grid = sized<patchproof_derivatives>();
  of_grid.point = {&grid[0], &grid[1], &grid[2], 16, 3};
  out.add(patchproof_surface_evaluate_grid(context, surface, lines.data(), 4, lines.data(), 4, nullptr, &of_grid));
  auto of_curve = sized<patchproof_derivatives>();
  of_curve.point = into(point), of_curve.du = into(du);
  out.add(patchproof_curve_evaluate(context, curve, {uv.data(), nullptr, 100, 2}, nullptr, &of_curve));
  out.add(grid), out.add(point), out.add(du);
  uv[7] = 17;
  out.add(patchproof_surface_evaluate(context, surface, at, nullptr, &wanted)), out.add(patchproof_error_text(context));
  return out.text();
}

std::string said_of_report(const patchproof_report* report) {
  const Context context;
  auto summary = sized<patchproof_report_summary>();
  Said out;
  out.add(patchproof_report_get_summary(context, report, &summary));
  out.add(summary.outcome), out.add(summary.joins), out.add(std::to_array(summary.largest_angle));
  for (std::size_t i = 0; i < summary.joins; ++i) {
    auto join = sized<patchproof_join_report>();
    auto witness = sized<patchproof_witness>();
    out.add(patchproof_report_get_join(context, report, i, &join));
    out.add(said_of(join.a.edge)), out.add(join.c1.verdict), out.add(said_of(join.g1.reason)), out.add(join.gap.upper);
    out.add(patchproof_report_get_witness(context, report, i, PATCHPROOF_CLASS_C2, &witness));
    out.add(said_of(witness.quantity)), out.add(said_of(witness.values));
  }
  for (const int format : {PATCHPROOF_REPORT_JSON, PATCHPROOF_REPORT_TABLE})
    out.add(text_of([&](char* buffer, std::size_t length, std::size_t* needed) {
      return patchproof_report_write(context, report, format, buffer, length, needed);
    }));
  return out.text();
}

std::string said_of_mesh(const patchproof_mesh* mesh) {
  const Context context;
  auto info = sized<patchproof_mesh_info>();
  Said out;
  out.add(patchproof_mesh_get_info(context, mesh, &info));
  std::vector<double> vertices(3 * info.vertices);
  std::vector<std::int32_t> triangles(3 * info.triangles), patches(info.triangles);
  out.add(patchproof_mesh_get_data(context, mesh, vertices.data(), vertices.size(), triangles.data(), triangles.size(),
                                   patches.data(), patches.size()));
  out.add(vertices), out.add(triangles), out.add(patches), out.add(info.chord), out.add(said_of(info.notes));
  for (const int format :
       {PATCHPROOF_MESH_STL, PATCHPROOF_MESH_OBJ, PATCHPROOF_MESH_PLY, PATCHPROOF_MESH_GLB, PATCHPROOF_MESH_VTU})
    out.add(text_of([&](char* buffer, std::size_t length, std::size_t* needed) {
      return patchproof_mesh_write(context, mesh, format, buffer, length, needed);
    }));
  return out.text();
}

// With a callback the work runs on one more thread.
const patchproof_callback kCounts{nullptr, [](void*, std::uint64_t, std::uint64_t) -> std::int32_t { return 0; }};
const patchproof_callback kStops{nullptr, [](void*, std::uint64_t, std::uint64_t) -> std::int32_t { return 1; }};

TEST(ThreadsCApi, HandlesAreUsedByAll) {
  const Shared shared;
  ASSERT_FALSE(::testing::Test::HasFailure());
  const patchproof_text knots[] = {patchproof_from("1/3"), patchproof_from("0.25")};
  const auto bytes_of = [](const char* path) {
    std::ifstream in(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string model_bytes = bytes_of(kModelFile), mesh_bytes = bytes_of(kMeshFile);
  const auto text = [](const std::string& x) { return patchproof_text{x.data(), x.size()}; };
  Together all;
  all.add("infos", [&] { return info_of(shared.model); });
  all.add("read", [&] {
    return made([&](patchproof_context* context, patchproof_model** out) {
      return patchproof_model_read_text(context, text(model_bytes), patchproof_from("m.json"),
                                        PATCHPROOF_DECIMALS_BINARY64, out);
    });
  });
  all.add("not read", [&] {
    return made([&](patchproof_context* context, patchproof_model** out) {
      return patchproof_model_read_text(context, patchproof_from("[]"), patchproof_from("m.json"),
                                        PATCHPROOF_DECIMALS_EXACT, out);
    });
  });
  all.add("insertion", [&] {
    return made([&](patchproof_context* context, patchproof_model** out) {
      return patchproof_model_patch_insert_knots(context, shared.model, 0, PATCHPROOF_DIRECTION_U, knots, 2, out);
    });
  });
  all.add("elevation", [&] {
    return made([&](patchproof_context* context, patchproof_model** out) {
      return patchproof_model_patch_elevate(context, shared.model, 0, PATCHPROOF_DIRECTION_V, 1, out);
    });
  });
  all.add("extraction", [&] {
    return made([&](patchproof_context* context, patchproof_model** out) {
      return patchproof_model_curve_extract_bezier(context, shared.curves, 0, out);
    });
  });
  all.add("values", [&] { return values_of(shared.surface, shared.curve); });
  all.add("prepared anew", [&] {
    const Context context;
    patchproof_surface* surface = nullptr;
    const patchproof_status status = patchproof_surface_of(context, shared.model, 1, &surface);
    const std::string out = say(status, values_of(surface, shared.curve));
    patchproof_surface_free(surface);
    return out;
  });
  for (const int scalar : {PATCHPROOF_SCALAR_RATIONAL, PATCHPROOF_SCALAR_INTERVAL})
    all.add("exact values", [&, scalar] {
      const Context context;
      return text_of([&](char* buffer, std::size_t length, std::size_t* needed) {
        return patchproof_model_patch_evaluate_exact(context, shared.model, 0, knots, 2, nullptr, scalar, 2, buffer,
                                                     length, needed);
      });
    });
  all.add("report", [&] { return said_of_report(shared.report); });
  all.add("mesh", [&] { return said_of_mesh(shared.mesh); });
  for (const patchproof_callback* callback : {static_cast<const patchproof_callback*>(nullptr), &kCounts, &kStops}) {
    all.add("certified", [&, callback] {
      const Context context;
      auto options = sized<patchproof_certify_options>();
      options.jobs = 1;
      options.seconds_per_join = 1e5;
      patchproof_report* report = nullptr;
      const patchproof_status status = patchproof_certify(context, shared.model, &options, callback, &report);
      // What is over before the callback is asked for the first time is not stopped.
      const std::string out = callback == &kStops ? say(status == PATCHPROOF_OK || status == PATCHPROOF_STOPPED)
                                                  : say(status, report ? said_of_report(report) : "no report");
      patchproof_report_free(report);
      return out;
    });
    if (callback == &kStops) continue;
    all.add("tessellated", [&, callback] {
      const Context context;
      auto options = sized<patchproof_tessellate_options>();
      options.chord = 1;
      options.jobs = 1;
      patchproof_mesh* mesh = nullptr;
      const patchproof_status status = patchproof_tessellate(context, shared.model, &options, callback, &mesh);
      const std::string out = say(status, mesh ? said_of_mesh(mesh) : "no mesh");
      patchproof_mesh_free(mesh);
      return out;
    });
    all.add("filled", [&, callback] {
      auto options = sized<patchproof_fill_options>();
      options.jobs = 1;
      return made([&](patchproof_context* context, patchproof_model** out) {
        auto summary = sized<patchproof_fill_summary>();
        return patchproof_fill(context, text(mesh_bytes), patchproof_from("mesh.json"), &options, callback, out,
                               &summary);
      });
    });
  }
  all.run();
}

// Each call is done, or told that the context is in use; what is done is right.
TEST(ThreadsCApi, OneContextServesOneCallAtATime) {
  const Shared shared;
  const Context context;
  std::array<std::array<int, 2>, kThreads> counts{};
  std::atomic<bool> good{true};
  in_threads([&](std::size_t k) {
    for (int i = 0; i < 200; ++i) {
      auto info = sized<patchproof_model_info>();
      std::size_t needed = 0;
      const bool even = (i + k) % 2 == 0;
      const patchproof_status status =
          even ? patchproof_model_get_info(context, shared.model, &info)
               : patchproof_model_write(context, shared.model, PATCHPROOF_FORMAT_JSON, nullptr, 0, &needed);
      if (status == PATCHPROOF_CONTEXT_BUSY) {
        ++counts[k][1];
        if (info.patches != 0 || needed != 0) good = false;  // outputs are as they were
      } else {
        ++counts[k][0];
        if (status != (even ? PATCHPROOF_OK : PATCHPROOF_BUFFER_TOO_SMALL)) good = false;
        if (even ? info.patches == 0 : needed == 0) good = false;
      }
    }
  });
  EXPECT_TRUE(good);
  int done = 0, busy = 0;
  for (const auto& [mine, others] : counts) done += mine, busy += others;
  EXPECT_EQ(done + busy, 200 * static_cast<int>(kThreads));
  EXPECT_GT(done, 0);

  // Busy for certain: the callback of a call, which uses its context.
  struct Held {
    patchproof_context* context;
    const patchproof_model* model;
    patchproof_status status;
  } held{context, shared.model, PATCHPROOF_OK};
  const patchproof_callback asks{
      &held, [](void* user, std::uint64_t, std::uint64_t) -> std::int32_t {
        Held& h = *static_cast<Held*>(user);
        auto info = sized<patchproof_model_info>();
        std::thread([&] { h.status = patchproof_model_get_info(h.context, h.model, &info); }).join();
        return 0;
      }};
  patchproof_report* report = nullptr;
  auto options = sized<patchproof_certify_options>();
  options.jobs = 1;
  EXPECT_EQ(patchproof_certify(context, shared.model, &options, &asks, &report), PATCHPROOF_OK);
  EXPECT_EQ(held.status, PATCHPROOF_CONTEXT_BUSY);
  patchproof_report_free(report);
}

// Handles are made and freed by all; of the threads that free the same one, one does.
TEST(ThreadsCApi, AHandleIsFreedOnce) {
  const Context context(PATCHPROOF_KEEP_FREED_HANDLES);
  for (int round = 0; round < 20; ++round) {
    patchproof_model* model = nullptr;
    ASSERT_EQ(patchproof_model_read_file(context, patchproof_from(kModelFile), PATCHPROOF_DECIMALS_EXACT, &model),
              PATCHPROOF_OK);
    std::atomic<int> freed{0}, late{0};
    in_threads([&](std::size_t) {
      const patchproof_status status = patchproof_model_free(model);
      (status == PATCHPROOF_OK ? freed : late) += status == PATCHPROOF_OK || status == PATCHPROOF_FREED_HANDLE;
    });
    EXPECT_EQ(freed, 1);
    EXPECT_EQ(late, static_cast<int>(kThreads) - 1);
  }
}

}  // namespace
}  // namespace patchproof::test
