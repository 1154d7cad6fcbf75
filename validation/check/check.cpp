// SPDX-License-Identifier: Apache-2.0
#include "validation/check/check.h"

#include <tbb/parallel_for.h>

namespace patchproof::validation {

const std::vector<std::string>& kernel_names() {
  static const std::vector<std::string> names{
      "S",           "S_u",       "S_v",       "S_uu",      "S_uv",   "S_vv",      "n",       "grid S",     "grid S_u",
      "grid S_v",    "grid S_uu", "grid S_uv", "grid S_vv", "grid n", "same bits", "bounded", "interval",   "rounded",
      "compensated", "C",         "C'",        "C''",       "refine", "bezier",    "decide",  "decide ifma"};
  return names;
}

Tallies check_all(const CheckOptions& options) {
  const std::vector<SurfaceCase> surfaces = surface_cases(options.corpus);
  const std::vector<CurveCase> curves = curve_cases(options.corpus);
  std::vector<Tallies> parts(surfaces.size() + curves.size() + 1);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t k) {
    if (k < surfaces.size()) {
      check_surface(surfaces[k], options, parts[k]);
      check_refinement(surfaces[k], options, parts[k]);
    } else if (k + 1 == parts.size()) {
      check_decisions(options, parts[k]);
    } else {
      check_curve(curves[k - surfaces.size()], options, parts[k]);
    }
  });
  Tallies all;  // in the order of the corpus, whoever was first
  for (const Tallies& part : parts)
    for (const auto& [key, tally] : part) merge(all[key], tally);
  return all;
}

}  // namespace patchproof::validation
