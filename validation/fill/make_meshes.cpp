// SPDX-License-Identifier: Apache-2.0
// make_meshes FOLDER: writes the closed curve meshes of examples/meshes.
#include <cstdio>
#include <fstream>
#include <string>

#include "patchproof/io/curve_mesh_file.h"
#include "validation/corpus/curve_meshes.h"

int main(int argc, char** argv) {
  using namespace patchproof;
  using validation::Polyhedron;
  if (argc != 2) {
    std::fputs("usage: make_meshes FOLDER\n", stderr);
    return 2;
  }
  constexpr std::uint64_t kSeed = 1;
  const auto write = [&](const std::string& name, const CurveMesh& mesh) {
    std::ofstream out(std::string(argv[1]) + "/" + name);
    out << write_curve_mesh(mesh, "mm");
    return static_cast<bool>(out.flush());
  };
  const bool done = write("football.json", validation::polyhedron_mesh(Polyhedron::football, kSeed)) &&
                    write("mixed_faces.json", validation::polyhedron_mesh(Polyhedron::rhombicosidodecahedron, kSeed));
  if (!done) std::fprintf(stderr, "make_meshes: cannot write into %s\n", argv[1]);
  return done ? 0 : 2;
}
