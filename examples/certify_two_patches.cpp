// SPDX-License-Identifier: Apache-2.0
// Reads a model with two patches or more, finds where the first two meet, certifies it and prints the certificate.
#include <iostream>

#include "patchproof/io/read.h"
#include "patchproof/join/certify.h"
#include "patchproof/join/edge_match.h"

int main(int argc, char** argv) {
  using namespace patchproof;
  const Result<ModelFile> file = read_model(argc > 1 ? argv[1] : "examples/seven/kink_at_end.json");
  if (!file) return std::cerr << file.error().text() << '\n', 2;
  return std::visit(
      [](const auto& model) {
        if (model.patches.size() < 2) return std::cerr << "two patches are needed\n", 2;
        const auto &a = model.patches[0].surface, &b = model.patches[1].surface;
        const auto match = match_edges<std::decay_t<decltype(a.net()[0][0])>>({&a, &b});
        for (const auto& join : match.joins) {
          const Certificate c = certify_join(a, b, join);
          std::cout << "C0 " << to_string(c.c0.verdict) << ", G1 " << to_string(c.g1.verdict) << ", C1 "
                    << to_string(c.c1.verdict) << "\ngap   in [" << c.gap.lower << ", " << c.gap.upper
                    << "]\nangle in [" << c.angle.lower << ", " << c.angle.upper
                    << "] degrees, worst at v = " << c.angle.at.a[1] << " of the first patch\n";
        }
        return 0;
      },
      file->model);
}
