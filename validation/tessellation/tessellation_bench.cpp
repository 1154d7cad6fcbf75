// SPDX-License-Identifier: Apache-2.0
// tessellation_bench [--chord LENGTH]… [MODEL…]: models [examples/cad/block.step] meshed by us at these chord errors [0.1 0.01] and by
// Open CASCADE's BRepMesh at the same measured error; one table (README.md). Exits with 1 when a mesh of ours is measured to be
// farther from a surface than is proved, or is not watertight; 2 when a model cannot be read.
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>

#include "patchproof/io/cad.h"
#include "patchproof/io/read.h"
#include "patchproof/io/write.h"
#include "patchproof/mesh/adaptive_mesh.h"
#include "patchproof/mesh/delaunay.h"
#include "patchproof/mesh/trimmed_mesh.h"
#include "validation/tessellation/occt_mesh.h"

namespace {

using namespace patchproof;
using namespace patchproof::tessellation;

constexpr double kRadians = 0.5;  // BRepMesh's own choice of its angle
constexpr double kSewing = 1e-6;  // its own choice, too
constexpr int kTries = 12;        // of a deflection

double degrees(double radians) { return radians * 180 / M_PI; }

// A way of ours to mesh the model, and the surfaces of the faces that it counts.
struct Way {
  std::string name;
  std::function<Result<CertifiedMesh>(const MeshRequest&)> mesh;
  std::vector<FaceSurface> surfaces;
  double approximation = 0;  // how far what it meshes is from the file's surfaces, as it says itself
};

struct Bench {
  std::string name;
  std::vector<Way> ways;
  TopoDS_Shape shape;  // what BRepMesh meshes
};

struct Trial {
  double deflection = 0, seconds = 0;
  CertifiedMesh mesh;
  Measured measured;
  int faces_without = 0;
};

bool fails(const std::string& name, const std::string& why) {
  const std::string text = why.find(name) == std::string::npos ? name + ": " + why : why;
  std::fprintf(stderr, "tessellation_bench: %s\n", text.c_str());
  return false;
}

bool add_trimmed(Bench& bench, const std::string& path, const TopoDS_Shape& shape) {
  const Result<CadModel> read = read_cad_model(path);
  if (!read) return fails(path, read.error().text());
  const auto cad = std::make_shared<CadModel>(*read);
  Way way{"ours, trimmed faces", {}, surfaces_of(shape)};
  if (way.surfaces.size() != cad->faces.size()) return fails(path, "faces are read in two ways");
  std::vector<TrimmedFace> faces;
  for (const CadFace& face : cad->faces) {
    faces.push_back({face.label, &face.surface});
    way.approximation = std::max(way.approximation, face.approximation.length);
  }
  std::vector<TrimmedEdge> edges;
  for (const CadEdge& edge : cad->edges) {
    if (edge.kind == CadEdgeKind::unusable || edge.kind == CadEdgeKind::degenerate) continue;
    edges.push_back({edge.label, {}, edge.tolerance});
    for (const CadUse& use : edge.uses) edges.back().uses.push_back({use.face, use.forward, &use.parameters});
  }
  if (way.approximation > 0)
    std::printf("%s: we mesh an approximation of a surface, %.2g from the file's, against which all are measured\n",
                bench.name.c_str(), way.approximation);
  way.mesh = [cad, faces, edges](const MeshRequest& request) {
    return trimmed_mesh(faces, edges, request, constrained_delaunay);
  };
  bench.ways.push_back(std::move(way));
  return true;
}

bool add_patches(Bench& bench, const std::string& path) {
  const Result<ModelFile> file = read_model(path);
  if (!file) return fails(path, file.error().text());
  if (!std::holds_alternative<Model<Rational>>(file->model)) return fails(path, "numbers are not in Q");
  const auto model = std::make_shared<Model<Rational>>(std::get<Model<Rational>>(file->model));
  std::vector<const BsplinePatch<Rational, 4>*> patches;
  for (const auto& p : model->patches) {
    if (split_torn(p.surface).size() > 1) return fails(path, "a patch may jump at a knot");
    patches.push_back(&p.surface);
  }
  Model<Rational> only_patches;
  only_patches.patches = model->patches;
  const Result<WrittenModel> written = write_model_cad(only_patches, CadFormat::brep);
  if (!written) return fails(path, written.error().text());
  const std::optional<TopoDS_Shape> faces = read_brep(written->bytes);
  if (!faces) return fails(path, "Open CASCADE does not read it");

  double begin = processor_seconds();
  const EdgeMatch<Rational> match = match_edges(patches);
  const double matching = processor_seconds() - begin;
  begin = processor_seconds();
  bench.shape = sewn(*faces, kSewing);
  std::printf("%s: %zu patches; edges matched by us in %.3f s, sewn by Open CASCADE in %.3f s, neither in the table\n",
              bench.name.c_str(), patches.size(), matching, processor_seconds() - begin);
  bench.ways.push_back({"ours, patches",
                        [model, patches, match](const MeshRequest& request) {
                          return adaptive_mesh(patches, match.joins, match.collapsed, request);
                        },
                        surfaces_of(*faces)});
  const auto temporary =
      std::filesystem::temp_directory_path() / ("tessellation_" + std::to_string(getpid()) + ".brep");
  const bool ok = write_brep(bench.shape, temporary.string()) && add_trimmed(bench, temporary.string(), bench.shape);
  std::filesystem::remove(temporary);
  return ok;
}

bool prepare(Bench& bench, const std::string& path) {
  bench.name = std::filesystem::path(path).stem().string();
  if (!looks_like_cad(path)) return add_patches(bench, path);
  const std::optional<TopoDS_Shape> shape = read_step(path);
  if (!shape) return fails(path, "Open CASCADE does not read it as STEP");
  bench.shape = *shape;
  return add_trimmed(bench, path, bench.shape);
}

void print_head() {
  std::printf("\n%-8s %-20s %9s %6s %9s %8s %10s %10s %10s %10s %s\n", "model", "mesh", "asked", "angle", "triangles",
              "seconds", "proved", "error", "to surface", "parametric", "watertight");
}

// `angle` in degrees, 180: not asked.
void print_row(const Bench& bench, const std::string& name, double asked, double angle, const Trial& trial,
               bool is_ours) {
  const Watertight closed = check_watertight(trial.mesh);
  std::string tight = closed.is_watertight() ? "yes" : "no";
  if (closed.is_watertight() && closed.free > 0) tight += ", " + std::to_string(closed.free) + " free";
  if (closed.cracks > 0) tight += ", " + std::to_string(closed.cracks) + " open edges";
  if (closed.branching > 0) tight += ", " + std::to_string(closed.branching) + " branching";
  if (trial.faces_without > 0) tight += ", " + std::to_string(trial.faces_without) + " faces missing";
  if (trial.mesh.chord_misses + trial.mesh.angle_misses > 0)
    tight += "; not proved: chord of " + std::to_string(trial.mesh.chord_misses) + ", angle of " +
             std::to_string(trial.mesh.angle_misses);
  char proved[32] = "-", at_angle[32] = "-";
  if (is_ours) std::snprintf(proved, sizeof proved, "%.3g", trial.mesh.chord);
  if (angle < 180) std::snprintf(at_angle, sizeof at_angle, "%.1f", angle);
  std::printf("%-8s %-20s %9.4g %6s %9zu %8.3f %10s %10.3g %10.3g %10.3g %s\n", bench.name.c_str(), name.c_str(), asked,
              at_angle, trial.mesh.triangles.size(), trial.seconds, proved, trial.measured.error(),
              trial.measured.to_surface, trial.measured.parametric, tight.c_str());
  std::fflush(stdout);
}

// Once more while it takes little: the least time counts.
template <class Work>
double least_seconds(const Work& once) {
  double least = once(), sum = least;
  for (int k = 0; k < 9 && sum < 0.5; ++k) {
    const double seconds = once();
    least = std::min(least, seconds);
    sum += seconds;
  }
  return least;
}

Trial by_occt(const Bench& bench, const std::vector<FaceSurface>& surfaces, double deflection, double radians) {
  OcctMesh made = mesh_by_occt(bench.shape, deflection, radians);
  Trial out{deflection, made.seconds, std::move(made.mesh), {}, made.faces_without};
  out.measured = measure(out.mesh, surfaces);
  return out;
}

// BRepMesh's meshes about an error, by bisection of its deflection. Its error jumps: one on either side of the target.
struct About {
  std::optional<Trial>
      within;  // error at most 1 % more than the target, with the fewest triangles of those that were tried
  std::optional<Trial> above;  // the least error above that
};

About occt_about(const Bench& bench, const std::vector<FaceSurface>& surfaces, double target, double radians) {
  About out;
  double low = 0, high = INFINITY, deflection = target;
  for (int k = 0; k < kTries && high > 1.01 * low; ++k) {
    Trial trial = by_occt(bench, surfaces, deflection, radians);
    const double error = trial.measured.error();
    const bool is_within = error <= 1.01 * target;
    std::optional<Trial>& rival = is_within ? out.within : out.above;
    // A larger deflection that changes nothing: the angle decides.
    const bool same = is_within && rival && trial.deflection > rival->deflection &&
                      trial.mesh.triangles.size() == rival->mesh.triangles.size();
    if (is_within)
      low = std::max(low, deflection);
    else
      high = std::min(high, deflection);
    if (!rival ||
        (is_within ? trial.mesh.triangles.size() <= rival->mesh.triangles.size() : error < rival->measured.error()))
      rival = std::move(trial);
    if (same || std::abs(error / target - 1) <= 0.01) break;
    deflection =
        low > 0 && std::isfinite(high) ? std::sqrt(low * high) : deflection * std::clamp(target / error, 0.25, 4.0);
  }
  for (std::optional<Trial>* trial : {&out.within, &out.above})
    if (*trial)
      (*trial)->seconds =
          least_seconds([&] { return mesh_by_occt(bench.shape, (*trial)->deflection, radians).seconds; });
  return out;
}

void print_theirs(const Bench& bench, const std::vector<FaceSurface>& surfaces, double target, double radians) {
  const About theirs = occt_about(bench, surfaces, target, radians);
  if (theirs.within) print_row(bench, "  BRepMesh", theirs.within->deflection, degrees(radians), *theirs.within, false);
  if (theirs.above && (!theirs.within || theirs.within->measured.error() < 0.95 * target))
    print_row(bench, "  BRepMesh, worse", theirs.above->deflection, degrees(radians), *theirs.above, false);
}

// What is wrong with our mesh, if anything.
int faults(const Bench& bench, const Way& way, const Trial& trial) {
  int out = 0;
  if (trial.measured.error() > trial.mesh.chord + way.approximation) {
    fails(bench.name, way.name + ": the measured error is above the proved bound");
    ++out;
  }
  if (!check_watertight(trial.mesh).is_watertight()) {
    fails(bench.name, way.name + ": not watertight");
    ++out;
  }
  return out;
}

// Negative: it cannot be meshed.
int run(const Bench& bench, double chord) {
  const std::vector<FaceSurface> surfaces = surfaces_of(bench.shape);
  int wrong = 0;
  Trial as_asked = by_occt(bench, surfaces, chord, kRadians);
  as_asked.seconds = least_seconds([&] { return mesh_by_occt(bench.shape, chord, kRadians).seconds; });
  print_row(bench, "BRepMesh as asked", chord, degrees(kRadians), as_asked, false);
  for (const Way& way : bench.ways)
    for (const double angle : {180.0, degrees(kRadians)}) {
      const MeshRequest request{chord, angle, MeshRequest{}.max_triangles, 1};
      Trial ours;
      std::optional<Error> error;
      ours.seconds = least_seconds([&] {
        const double begin = processor_seconds();
        Result<CertifiedMesh> mesh = way.mesh(request);
        const double end = processor_seconds();
        if (mesh)
          ours.mesh = std::move(*mesh);
        else
          error = mesh.error();
        return end - begin;
      });
      if (error) {
        fails(bench.name, error->text());
        return -1;
      }
      ours.measured = measure(ours.mesh, way.surfaces);
      wrong += faults(bench, way, ours);
      print_row(bench, way.name, chord, angle, ours, true);
      if (angle == 180) print_theirs(bench, surfaces, ours.measured.error(), M_PI);
      print_theirs(bench, surfaces, ours.measured.error(), kRadians);
    }
  return wrong;
}

}  // namespace

int main(int count, char** words) {
  std::vector<std::string> models;
  std::vector<double> chords;
  for (int k = 1; k < count; ++k) {
    if (std::strncmp(words[k], "--", 2) != 0) {
      models.push_back(words[k]);
      continue;
    }
    const bool has_length = std::strcmp(words[k], "--chord") == 0 && k + 1 < count;
    chords.push_back(has_length ? std::atof(words[++k]) : 0);
    if (!(chords.back() > 0)) {
      std::fputs("usage: tessellation_bench [--chord LENGTH]... [MODEL...]\n", stderr);
      return 2;
    }
  }
  if (models.empty()) models = {PATCHPROOF_SOURCE_DIR "/examples/cad/block.step"};
  if (chords.empty()) chords = {0.1, 0.01};
  std::printf("Open CASCADE %s\n", occt_version().c_str());
  std::vector<Bench> benches(models.size());
  for (std::size_t k = 0; k < models.size(); ++k)
    if (!prepare(benches[k], models[k])) return 2;
  print_head();
  int wrong = 0;
  for (const Bench& bench : benches)
    for (const double chord : chords) {
      const int here = run(bench, chord);
      if (here < 0) return 2;
      wrong += here;
    }
  std::printf("%d wrong\n", wrong);
  return wrong == 0 ? 0 : 1;
}
