// SPDX-License-Identifier: Apache-2.0
// The C API for tests: handles that free themselves, and models to work on.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "patchproof/c_api.h"

namespace patchproof::test {

struct Free {
  void operator()(patchproof_context* x) const { EXPECT_EQ(patchproof_context_free(x), PATCHPROOF_OK); }
  void operator()(patchproof_model* x) const { EXPECT_EQ(patchproof_model_free(x), PATCHPROOF_OK); }
  void operator()(patchproof_surface* x) const { EXPECT_EQ(patchproof_surface_free(x), PATCHPROOF_OK); }
  void operator()(patchproof_curve* x) const { EXPECT_EQ(patchproof_curve_free(x), PATCHPROOF_OK); }
  void operator()(patchproof_report* x) const { EXPECT_EQ(patchproof_report_free(x), PATCHPROOF_OK); }
  void operator()(patchproof_mesh* x) const { EXPECT_EQ(patchproof_mesh_free(x), PATCHPROOF_OK); }
};
template <class H>
using Owned = std::unique_ptr<H, Free>;

inline Owned<patchproof_context> make_context(std::uint32_t flags = 0) {
  patchproof_context* out = nullptr;
  EXPECT_EQ(patchproof_context_create(flags, &out), PATCHPROOF_OK);
  return Owned<patchproof_context>(out);
}

// The handle that make(&handle) gives; nullptr, and a failure, where its status is another than OK.
template <class H, class Make>
Owned<H> owned(const Owned<patchproof_context>& context, const Make& make) {
  H* out = nullptr;
  EXPECT_EQ(make(&out), PATCHPROOF_OK) << patchproof_error_text(context.get());
  return Owned<H>(out);
}

inline patchproof_text text_of(const std::string& text) { return {text.data(), text.size()}; }
inline std::string string_of(patchproof_text text) {
  EXPECT_EQ(text.data[text.length], '\0');
  return {text.data, text.length};
}

inline std::string example(const std::string& name) { return std::string(PATCHPROOF_SOURCE_DIR) + "/examples/" + name; }
inline std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream out;
  out << file.rdbuf();
  return out.str();
}

inline Owned<patchproof_model> read_example(const Owned<patchproof_context>& context, const std::string& name) {
  return owned<patchproof_model>(context, [&](patchproof_model** out) {
    return patchproof_model_read_file(context.get(), text_of(example(name)), PATCHPROOF_DECIMALS_EXACT, out);
  });
}

// What write(buffer, length, &needed) writes.
template <class Write>
std::string written(const Write& write) {
  std::size_t needed = 0;
  EXPECT_EQ(write(nullptr, 0, &needed), PATCHPROOF_BUFFER_TOO_SMALL);
  std::string out(needed, '?');
  EXPECT_EQ(write(out.data(), needed, &needed), PATCHPROOF_OK);
  EXPECT_EQ(out.size(), needed);
  EXPECT_EQ(out.back(), '\0');
  out.pop_back();
  return out;
}

template <class S>
S sized() {
  S out{};
  out.struct_size = sizeof(S);
  return out;
}

// Two bicubic squares in one plane, side by side; `lift` moves the second one's far points up, so that they meet in a kink.
struct TwoSquares {
  std::vector<double> knots{0, 0, 0, 0, 1, 1, 1, 1}, a, b;
  patchproof_surface_data patches[2];
  patchproof_model_data data;

  explicit TwoSquares(double lift = 0) {
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        for (const double x : {i / 4.0, j / 4.0, 0.0}) a.push_back(x);
        for (const double x : {(3 + i) / 4.0, j / 4.0, lift * i}) b.push_back(x);
      }
    for (int k = 0; k < 2; ++k) {
      patchproof_surface_data& p = patches[k] = sized<patchproof_surface_data>();
      p.degree_u = p.degree_v = 3;
      p.knots_u = p.knots_v = knots.data();
      p.knots_u_length = p.knots_v_length = knots.size();
      p.points = (k == 0 ? a : b).data();
      p.points_length = 48;
    }
    data = sized<patchproof_model_data>();
    data.patches = patches;
    data.patches_length = 2;
  }
  TwoSquares(const TwoSquares&) = delete;
  Owned<patchproof_model> make(const Owned<patchproof_context>& context) const {
    return owned<patchproof_model>(
        context, [&](patchproof_model** out) { return patchproof_model_create(context.get(), &data, out); });
  }
};

}  // namespace patchproof::test
