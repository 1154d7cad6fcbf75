// SPDX-License-Identifier: Apache-2.0
// CAD files read and written by several threads at a time: Open CASCADE keeps settings of the whole process.
#include <atomic>
#include <iostream>
#include <thread>

#include "io/occt/parts.h"
#include "patchproof/io/write.h"

namespace patchproof::test {
namespace {

TEST_F(CadFiles, Law7_AnyNumberOfThreadsMayReadAndWrite) {
  const std::string step = write_step(rounded_block()), brep = write_brep(rounded_block());
  const CadModel expected = read(step), expected_brep = read(brep);
  Model<Rational> model;
  for (const CadFace& face : expected.faces) model.patches.push_back({face.label, face.surface, true});
  const std::string written = write_model_cad(model, CadFormat::step).value().bytes;
  std::streambuf* const out = std::cout.rdbuf();
  std::streambuf* const err = std::cerr.rdbuf();
  std::atomic<int> waiting{4};
  std::atomic<bool> same{true};
  const auto same_faces = [](const CadModel& a, const CadModel& b) {
    if (a.faces.size() != b.faces.size() || a.edges.size() != b.edges.size()) return false;
    for (std::size_t i = 0; i < a.faces.size(); ++i)
      if (a.faces[i].label != b.faces[i].label || !(a.faces[i].surface.net() == b.faces[i].surface.net())) return false;
    return true;
  };
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&, k] {
      for (--waiting; waiting > 0;) std::this_thread::yield();
      for (int i = 0; i < 3; ++i) {
        const bool good = k % 2 == 0   ? same_faces(read(step), expected)
                          : i % 2 == 0 ? same_faces(read(brep), expected_brep)
                                       : write_model_cad(model, CadFormat::step).value().bytes == written;
        if (!good) same = false;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(same);
  EXPECT_EQ(std::cout.rdbuf(), out);  // each was given back before the next one took it
  EXPECT_EQ(std::cerr.rdbuf(), err);
}

}  // namespace
}  // namespace patchproof::test
