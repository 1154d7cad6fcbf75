// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>

#include "cli/commands.h"
#include "patchproof/io/curve_mesh_file.h"
#include "patchproof/io/write.h"
#include "patchproof/mesh/prove_fill.h"
#include "patchproof/mesh/repair_mesh.h"
#include "patchproof/mesh/split_faces.h"

namespace patchproof::cli {
namespace {

struct Options {
  std::string from, to;
  std::string method = "c1", scale = "auto";
  std::optional<double> repair;  // degrees
  int jobs = 0;
  bool quiet = false;
  Decimals decimals = Decimals::exact;
};

std::string plural(std::size_t count, const char* one, const char* more) {
  return fmt::format("{} {}", count, count == 1 ? one : more);
}

struct Tally {
  int proven = 0, refuted = 0, undecided = 0;
  void add(Verdict verdict) {
    ++(verdict == Verdict::proven ? proven : verdict == Verdict::refuted ? refuted : undecided);
  }
  int exit_code() const { return refuted > 0 ? kRefuted : undecided > 0 ? kUndecided : kProven; }
  std::string text() const {
    std::string out = fmt::format("{} proven", proven);
    if (refuted > 0) out += fmt::format(", {} refuted", refuted);
    if (undecided > 0) out += fmt::format(", {} undecided", undecided);
    return out;
  }
};

std::string place_of(const CurveMesh& mesh, const MeshJoin& join) {
  return fmt::format("edge {}, faces {} and {}", mesh.edges[join.edge].id, mesh.faces[join.join.patch_a].id,
                     mesh.faces[join.join.patch_b].id);
}

// The largest angle between the tangent planes of faces at one node of an edge, about, in degrees.
double angle_at_nodes(const MeshTopology& topology, int edge) {
  std::map<Rational, std::vector<Vec<double, 3>>> normals;
  for (const std::vector<int>* side : {&topology.left[edge], &topology.right[edge]})
    for (const int index : *side) {
      const EdgeUse& use = topology.uses[index];
      for (const bool at_end : {false, true}) {
        const Rational& t = at_end ? use.end() : use.begin();
        const Vec<Rational, 3> n = outward_normal(topology, use, t, at_end ? use.end_derivative : use.begin_derivative);
        const Rational size = std::max({Rational(abs(n[0])), Rational(abs(n[1])), Rational(abs(n[2]))});
        normals[t].push_back({{nearest_double(n[0] / size), nearest_double(n[1] / size), nearest_double(n[2] / size)}});
      }
    }
  double largest = 0;
  for (const auto& at : normals)
    for (const Vec<double, 3>& n : at.second) {
      const Vec<double, 3>& first = at.second.front();
      const Vec<double, 3> c = cross(first, n);
      largest = std::max(largest, std::atan2(std::sqrt(dot(c, c)), dot(first, n)) * 180 / std::numbers::pi);
    }
  return largest;
}

struct Findings {
  Tally g1, c1, regular;
  std::string lines;
};

Findings judge(const CurveMesh& mesh, const MeshTopology& topology, const FillProof& proof) {
  Findings out;
  for (std::size_t i = 0; i < proof.joins.size(); ++i) {
    const MeshJoin& join = proof.joins[i];
    const Certificate& c = proof.certificates[i];
    const std::string place = place_of(mesh, join);
    if (topology.kinds[join.edge] == EdgeKind::sharp) {
      constexpr double kNearlySmooth = 1;  // degrees
      const double at_nodes = angle_at_nodes(topology, join.edge);
      out.lines += fmt::format(
          "  {}: sharp, its faces' tangent planes are {:.2g} degrees apart at a node{}; largest angle in [{:.5g}, "
          "{:.5g}] degrees\n",
          place, at_nodes, at_nodes < kNearlySmooth ? " (--repair would make them one)" : "", c.angle.lower,
          c.angle.upper);
      continue;
    }
    const Verdict verdict = c.c0.verdict == Verdict::proven ? c.g1.verdict : c.c0.verdict;
    out.g1.add(verdict);
    if (verdict != Verdict::proven)
      out.lines += fmt::format("  {}: G1 {}: {}\n", place, to_string(verdict), c.g1.reason);
  }
  for (std::size_t f = 0; f < proof.patches.size(); ++f) {
    const GregoryProof& p = proof.patches[f];
    out.c1.add(p.is_c1() ? Verdict::proven : Verdict::refuted);
    out.regular.add(p.regular.verdict);
    const std::string place = "face " + mesh.faces[f].id;
    if (!p.is_c1())
      out.lines += fmt::format("  {}: C1 refuted: {}\n", place,
                               !p.c1 ? "the derivatives across a knot line jump" : "the three surfaces do not fit");
    if (p.regular.verdict != Verdict::proven)
      out.lines += fmt::format("  {}: regular {}: {}\n", place, to_string(p.regular.verdict), p.regular.reason);
  }
  return out;
}

// A rational number a little above the sine of an angle of at most 30 degrees.
Rational sine_of(double degrees) { return from_double(std::sin(degrees * std::numbers::pi / 180) * (1 + 1e-12)); }

Error at(const std::string& path, Error error) {
  error.where = error.where.empty() ? path : path + ", " + error.where;
  return error;
}

int run(const Options& options) {
  if (const std::string extension = std::filesystem::path(options.to).extension().string();
      extension != ".json" && std::filesystem::path(options.to).has_extension())
    return report_error({ErrorCode::usage, "fill", "OUT ends in .json; convert makes other formats of it", options.to});
  if (options.repair && !(*options.repair >= 0 && *options.repair <= 30))
    return report_error(
        {ErrorCode::usage, "--repair", "an angle from 0 to 30 degrees", fmt::format("{}", *options.repair)});
  Result<CurveMeshFile> file = read_curve_mesh(options.from, options.decimals);
  if (!file) return report_error(file.error());
  std::error_code ignored;
  if (options.to != "-" && std::filesystem::equivalent(options.from, options.to, ignored))
    return report_error({ErrorCode::usage, "fill", "would overwrite its input", options.to});
  std::string text;
  CurveMesh mesh = std::move(file->mesh);
  if (options.repair) {
    Result<RepairedMesh> repaired = repair_mesh(mesh, {sine_of(*options.repair)});
    if (!repaired) return report_error(at(options.from, repaired.error()));
    text += fmt::format("repaired: {} moved, by at most {} {}\n",
                        plural(repaired->moves.size(), "point or vector", "points and vectors"),
                        to_text(repaired->largest), file->units);
    std::set<std::string> edges;
    for (const RepairMove& move : repaired->moves)
      edges.insert(mesh.edges[move.part == RepairMove::Part::left_vector || move.part == RepairMove::Part::right_vector
                                  ? mesh.control_vectors[move.index].edge
                                  : move.edge]
                       .id);
    if (!edges.empty()) text += fmt::format("  of edges {}\n", fmt::join(edges, ", "));
    for (const int v : repaired->vertices)
      text += fmt::format("  vertex {}: its tangents are farther from one plane, and stay\n", mesh.vertices[v].id);
    mesh = std::move(repaired->mesh);
  }
  const std::size_t faces = mesh.faces.size();
  const auto other =
      std::count_if(mesh.faces.begin(), mesh.faces.end(), [](const MeshFace& f) { return f.sides.size() != 4; });
  // Vectors across an edge become uneven in length at T-nodes, and those of a split face are T-nodes.
  const bool uneven = other > 0 || !mesh.t_nodes.empty();
  const FillOptions fill{
      options.scale == "rational" || (options.scale == "auto" && uneven) ? NodeScale::rational : NodeScale::none,
      options.method == "former" ? FillMethod::former : FillMethod::c1};
  if (other > 0) {
    Result<CurveMesh> split = split_faces(mesh, fill);
    if (!split) return report_error(at(options.from, split.error()));
    text += fmt::format("split: {} not of four sides; {} in place of {}\n", plural(other, "face", "faces"),
                        plural(split->faces.size(), "face", "faces"), faces);
    mesh = std::move(*split);
  }
  const Result<MeshTopology> topology = analyse(mesh);
  if (!topology) return report_error(at(options.from, topology.error()));
  Result<FilledMesh<Rational>> filled = fill_faces<Rational>(mesh, *topology, fill, options.jobs);
  if (!filled) {
    Error error = at(options.from, filled.error());
    if (other > 0) error.message += " (edges F/0, F/1, … are those that face F was split along)";
    return report_error(error);
  }
  const FillProof proof = prove_fill(mesh, *topology, filled->patches, {}, options.jobs);
  const Findings findings = judge(mesh, *topology, proof);

  Model<Rational> model;
  model.units = file->units;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    model.gregory_patches.push_back({mesh.faces[f].id, std::move(filled->patches[f])});
  if (const int failed = write_output(options.to, write_model_json(model))) return failed;

  const auto count = [&](EdgeKind kind) { return std::count(topology->kinds.begin(), topology->kinds.end(), kind); };
  text += fmt::format("{}: {}, {} ({} smooth, {} sharp, {} boundary)\n", options.from,
                      plural(mesh.faces.size(), "face", "faces"), plural(mesh.edges.size(), "edge", "edges"),
                      count(EdgeKind::smooth), count(EdgeKind::sharp), count(EdgeKind::boundary));
  if (!options.quiet) text += findings.lines;
  text += fmt::format("G1 across smooth edges: {}\nC1 inside patches: {}\nnormal nowhere zero: {}\n",
                      findings.g1.text(), findings.c1.text(), findings.regular.text());
  if (options.to == "-")  // where the model is
    std::fputs(text.c_str(), stderr);
  else if (const int failed = write_output("-", text))
    return failed;
  const int codes[] = {findings.g1.exit_code(), findings.c1.exit_code(), findings.regular.exit_code()};
  return std::count(std::begin(codes), std::end(codes), kRefuted) > 0
             ? kRefuted
             : *std::max_element(std::begin(codes), std::end(codes));
}

}  // namespace

void add_fill(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("fill", "fill a mesh of curves with Gregory patches, and prove how they join");
  command->add_option("mesh", options->from, "curve mesh to fill (docs/formats.md)")->required()->type_name("MESH");
  command->add_option("out", options->to, "model to write; '-': on standard output, and the summary on standard error")
      ->required()
      ->type_name("OUT");
  command
      ->add_option("--method", options->method,
                   "c1: C1 inside every face; former: the earlier method, for comparison [c1]")
      ->check(CLI::IsMember({"c1", "former"}))
      ->option_text("c1|former");
  command
      ->add_option(
          "--scale", options->scale,
          "node vectors of the basis patches as they are (none), or divided by their rounded lengths (rational); auto: "
          "rational where there are T-nodes or faces to be split [auto]")
      ->check(CLI::IsMember({"auto", "none", "rational"}))
      ->option_text("auto|none|rational");
  command
      ->add_option(
          "--repair", options->repair,
          "first make exact what is nearly so: tangents at a vertex in one plane, opposite control vectors, C1 at "
          "knots, ends on nodes, where they miss it by at most this angle")
      ->check(CLI::Range(0.0, 30.0))
      ->option_text("DEGREES");
  command->add_option("--jobs", options->jobs, "threads; the result does not depend on it [one per processor]")
      ->check(CLI::Range(1, 1024))
      ->option_text("N");
  add_decimals(*command, options->decimals);
  command->add_flag("--quiet", options->quiet, "print the summary only");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace patchproof::cli
