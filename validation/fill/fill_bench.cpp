// SPDX-License-Identifier: Apache-2.0
// fill_bench [N…]: balls of 6 N² faces and more [1 13 41] and two split polyhedra are filled and proved, on one thread. Prints
// times in processor seconds and the largest memory so far; exits with 1 unless every edge is proved G¹ and every patch C¹ and
// regular.
#include <fmt/format.h>
#include <sys/resource.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "patchproof/mesh/prove_fill.h"
#include "patchproof/mesh/split_faces.h"
#include "validation/corpus/curve_meshes.h"

namespace {

using namespace patchproof;

constexpr std::uint64_t kSeed = 1;
constexpr FillOptions kOptions{NodeScale::rational, FillMethod::c1};

double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto of = [](const timeval& t) { return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) / 1e6; };
  return of(usage.ru_utime) + of(usage.ru_stime);
}

long peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

template <class Work>
double seconds(Work work) {
  const double begin = processor_seconds();
  work();
  return processor_seconds() - begin;
}

// What is missing of the proofs.
std::string missing(const CurveMesh& mesh, const MeshTopology& topology, const FillProof& proof) {
  std::size_t smooth = 0, g1 = 0, c1 = 0, regular = 0;
  for (const EdgeKind kind : topology.kinds) smooth += kind == EdgeKind::smooth;
  for (const Certificate& c : proof.certificates)
    g1 += c.c0.verdict == Verdict::proven && c.g1.verdict == Verdict::proven;
  for (const GregoryProof& patch : proof.patches) {
    c1 += patch.is_c1();
    regular += patch.regular.verdict == Verdict::proven;
  }
  std::string out;
  if (smooth < mesh.edges.size()) out += fmt::format(" {} edges not smooth", mesh.edges.size() - smooth);
  if (g1 < proof.joins.size()) out += fmt::format(" {} joins not G1", proof.joins.size() - g1);
  if (c1 < mesh.faces.size()) out += fmt::format(" {} patches not C1", mesh.faces.size() - c1);
  if (regular < mesh.faces.size()) out += fmt::format(" {} patches not regular", mesh.faces.size() - regular);
  return out;
}

bool measure(const std::string& name, const CurveMesh& mesh) {
  std::optional<Result<MeshTopology>> topology;
  std::optional<Result<FilledMesh<Rational>>> filled;
  std::optional<FillProof> proof;
  const double analysing = seconds([&] { topology = analyse(mesh); });
  if (!*topology) return fmt::print("{}: {}\n", name, topology->error().text()), false;
  const double in_double = seconds([&] { (void)fill_faces<double>(mesh, **topology, kOptions, 1); });
  const double filling = seconds([&] { filled = fill_faces<Rational>(mesh, **topology, kOptions, 1); });
  if (!*filled) return fmt::print("{}: {}\n", name, filled->error().text()), false;
  const double proving = seconds([&] { proof = prove_fill(mesh, **topology, (*filled)->patches, {}, 1); });
  const double per_face = 1000.0 / static_cast<double>(mesh.faces.size());
  const std::string wrong = missing(mesh, **topology, *proof);
  fmt::print("{:<24} {:>6} {:>6} {:>7} {:>6} | {:>7.3f} {:>7.3f} {:>7.3f} {:>7.3f} | {:>7.0f} {:>6} MB {}\n", name,
             mesh.faces.size(), mesh.edges.size(), mesh.t_nodes.size(), proof->joins.size(), analysing * per_face,
             in_double * per_face, filling * per_face, proving * per_face,
             1000 / ((analysing + filling + proving) * per_face), peak_megabytes(), wrong.empty() ? "proved" : wrong);
  return wrong.empty();
}

}  // namespace

int main(int count, char** words) {
  std::vector<int> sizes;
  for (int i = 1; i < count; ++i) sizes.push_back(std::atoi(words[i]));
  if (sizes.empty()) sizes = {1, 13, 41};
  fmt::print("seed {}; milliseconds for each face on one thread\n", kSeed);
  fmt::print("{:<24} {:>6} {:>6} {:>7} {:>6} | {:>7} {:>7} {:>7} {:>7} | {:>7}\n", "mesh", "faces", "edges", "T-nodes",
             "joins", "analyse", "double", "exact", "prove", "faces/s");
  bool good = true;
  using validation::Polyhedron;
  for (const auto& [name, polyhedron] : {std::pair{"football, split", Polyhedron::football},
                                         {"rhombicosidodecahedron", Polyhedron::rhombicosidodecahedron}}) {
    const Result<CurveMesh> mesh = split_faces(validation::polyhedron_mesh(polyhedron, kSeed), kOptions);
    good = mesh && measure(name, *mesh) && good;
  }
  for (const int n : sizes) {
    if (n < 1) return fmt::print("faces on each side should be at least 1: {}\n", n), 2;
    good = measure(fmt::format("ball, {} x {} a side", n, n), validation::closed_mesh(n, kSeed)) && good;
  }
  return good ? 0 : 1;
}
