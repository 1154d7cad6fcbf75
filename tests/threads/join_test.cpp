// SPDX-License-Identifier: Apache-2.0
// Models that all threads certify, evaluate and write: one job to each call.
#include <sstream>

#include "patchproof/io/cad.h"
#include "patchproof/io/evaluate_model.h"
#include "patchproof/io/motion.h"
#include "patchproof/io/plot.h"
#include "patchproof/io/profile.h"
#include "patchproof/io/read.h"
#include "patchproof/io/report.h"
#include "patchproof/io/write.h"
#include "patchproof/join/certify.h"
#include "threads/said.h"
#include "threads/together.h"

namespace patchproof::test {
namespace {

constexpr double kNoLimit = 1e5;  // seconds: the sanitizer makes everything slow

ModelFile example(const std::string& name) {
  return read_model(std::string(PATCHPROOF_SOURCE_DIR "/examples/") + name).value();
}

template <class T>
std::vector<const BsplinePatch<T, 4>*> patches_of(const Model<T>& model) {
  std::vector<const BsplinePatch<T, 4>*> out;
  for (const auto& patch : model.patches) out.push_back(&patch.surface);
  return out;
}

std::string said_of(const Certificate& c) {
  Said out;
  for (const ExactClass* each : {&c.c0, &c.c1, &c.c2, &c.g1}) {
    out.add(each->verdict), out.add(each->reason);
    if (each->witness) out.add(each->witness->quantity), out.add(each->witness->values);
  }
  for (const EnclosedMaximum* each : {&c.gap, &c.angle, &c.plane_angle})
    out.add(each->lower), out.add(each->upper), out.add(each->at.point), out.add(each->converged);
  out.add(c.ratio), out.add(c.orientation), out.add(c.rung), out.add(c.degenerate.size());
  return out.text();
}

CertifyOptions one_job() {
  CertifyOptions options;
  options.request.require = Continuity::g1;
  options.request.gap_tolerance = 1e-3;
  options.request.seconds_per_join = kNoLimit;
  options.jobs = 1;
  return options;
}

std::string report_of(const ModelFile& file, const CertifyOptions& options) {
  const Report report = certify_model(file, options);
  std::ostringstream json, table;
  write_json(json, report);
  write_table(table, report);
  return json.str() + table.str();
}

TEST(ThreadsJoin, EdgesOfSharedPatchesAreMatchedAndCertified) {
  const ModelFile torus = example("torus_q.json"), octants = example("sphere_octants.json");
  const auto& model = std::get<Model<Rational>>(torus.model);
  const auto patches = patches_of(model);
  const EdgeMatch<Rational> match = match_edges(patches);
  ASSERT_GT(match.joins.size(), 0U);
  Request request;
  request.seconds_per_join = kNoLimit;
  const auto said_of_match = [](const auto& found) {
    Said out;
    for (const auto& join : found.joins)
      out.add(join.patch_a), out.add(join.patch_b), out.add(join.kind), out.add(join.pairing.a),
          out.add(join.pairing.b);
    out.add(found.unmatched.size()), out.add(found.collapsed.size()), out.add(found.diagonal), out.add(found.length);
    return out.text();
  };
  Together all;
  all.add("match", [&] { return said_of_match(match_edges(patches)); });
  all.add("match over Q(sqrt d)", [&] {
    return std::visit([&](const auto& m) { return said_of_match(match_edges(patches_of(m))); }, octants.model);
  });
  all.add("one join", [&] {
    const Join<Rational>& join = match.joins.front();
    return said_of(certify_join(*patches[join.patch_a], *patches[join.patch_b], join, request));
  });
  all.add("all joins", [&] {
    Said out;
    for (const Certificate& each : certify_joins(patches, match.joins, request, 1)) out.add(said_of(each));
    return out.text();
  });
  all.run();
}

TEST(ThreadsJoin, ModelsAreCertifiedByAll) {
  const std::vector<std::string> names{"sphere_octants.json",
                                       "seven/kink_between_samples.json",
                                       "seven/perpendicular_cylinders.json",
                                       "seven/split_moved_1e3.json",
                                       "toolbox/test15.json",
                                       "gerbs/cylinder_rational.json",
                                       "gerbs/blends_1.json"};
  std::vector<ModelFile> files;
  for (const std::string& name : names) files.push_back(example(name));
  CertifyOptions with_profile = one_job();
  with_profile.profile = &all_profiles().front();
  Together all;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const ModelFile& file = files[i];
    all.add(names[i], [&file] { return report_of(file, one_job()); });
    all.add(names[i] + ", profile", [&file, &with_profile] { return report_of(file, with_profile); });
  }
  all.run();
}

// Transcendental GERBS are certified by enclosures over tables that all ask for at once.
TEST(ThreadsJoin, BlendedModelsAreCertifiedByAll) {
  const ModelFile file = example("gerbs/plane.json");
  Together all;
  all.add("report", [&] { return report_of(file, one_job()); });
  all.run();
}

// A floor and a ramp that meet along an edge which the file describes.
CadModel floor_and_ramp() {
  const auto patch = [](const std::vector<std::array<int, 3>>& corners) {
    std::vector<Vec<Rational, 4>> net;
    for (const auto& [x, y, z] : corners) net.push_back({{Rational(x), Rational(y), Rational(z), Rational(1)}});
    const auto knots = KnotVector<Rational>::bezier(1);
    return BsplinePatch<Rational, 4>(knots, knots, std::move(net));
  };
  const auto along_v = [](int u) {
    const Rational at(u), one(1);
    return BsplineCurve<Rational, 3>::bezier({{{at, Rational(0), one}}, {{at, one, one}}});
  };
  CadModel model;
  model.path = "room.step", model.format = "step", model.units = "mm";
  model.faces = {{"#1", "plane", patch({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}})},
                 {"#2", "plane", patch({{1, 0, 0}, {1, 1, 0}, {2, 0, 1}, {2, 1, 2}})}};
  const CadUse floor{0, true, along_v(1)}, ramp{1, false, along_v(0)}, beyond{0, false, along_v(0)};
  model.edges = {{"#3", CadEdgeKind::shared, {floor, ramp}, 0, ""}, {"#4", CadEdgeKind::free, {beyond}, 0, ""}};
  return model;
}

TEST(ThreadsJoin, CadModelsAreCertifiedByAll) {
  const CadModel model = floor_and_ramp();
  Together all;
  for (const double smooth_below : {5.0, 170.0})
    all.add("report", [&, smooth_below] {
      CertifyOptions options = one_job();
      options.smooth_below = smooth_below;
      std::ostringstream json;
      write_json(json, certify_cad(model, options));
      return json.str();
    });
  all.run();
}

TEST(ThreadsJoin, OneMotionMovesOneModelForAll) {
  const ModelFile file = example("gerbs/heart.json");
  const auto& model = std::get<Model<Rational>>(file.model);
  const auto motion = read_motion(PATCHPROOF_SOURCE_DIR "/examples/gerbs/heart_beat.motion.json", model).value();
  Together all;
  for (const int k : {0, 3, 7}) all.add("frame", [&, k] { return write_model_json(frame(model, motion, k, 12)); });
  all.run();
}

#ifndef __SANITIZE_THREAD__  // TBB is not built for the sanitizer, which would see races where TBB hands work over
TEST(ThreadsJoin, CallsWithManyJobsDoNotDisturbEachOther) {
  const ModelFile file = example("torus_q.json");
  Together all;
  for (const int jobs : {0, 1, 2, 5})
    all.add("jobs", [&, jobs] {
      CertifyOptions options = one_job();
      options.jobs = jobs;
      return report_of(file, options);
    });
  all.run();
}
#endif

TEST(ThreadsJoin, ModelsAreReadEvaluatedAndWrittenByAll) {
  const std::vector<std::string> names{"torus.json",         "sphere_octants.json", "gerbs/heart.json",
                                       "toolbox/solid.json", "toolbox/conics.json", "gerbs/torus.json"};
  std::vector<ModelFile> files;
  for (const std::string& name : names) files.push_back(example(name));
  PlotOptions coarse;
  coarse.cells = 2;
  Together all;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const ModelFile& file = files[i];
    all.add(names[i] + ": read", [&names, i] {
      const ModelFile again = example(names[i]);
      return say(again.sha256, again.format, again.notes,
                 std::visit([](const auto& m) { return write_model_json(m); }, again.model));
    });
    all.add(names[i] + ": written", [&file] {
      return std::visit([](const auto& m) { return say(write_model_json(m), write_model_g2(m).has_value()); },
                        file.model);
    });
    all.add(names[i] + ": drawn", [&file, &coarse] {
      return std::visit(
          [&coarse](const auto& m) {
            return say(plot(m, PlotFormat::svg, coarse), plot(m, PlotFormat::obj, coarse),
                       plot(m, PlotFormat::glb, coarse), plot(m, PlotFormat::vtu, coarse));
          },
          file.model);
    });
    all.add(names[i] + ": evaluated", [&file] {
      return std::visit(
          []<class T>(const Model<T>& m) {
            const RoundingGuard guard;
            Said out;
            for (const PartKind kind : {PartKind::patch, PartKind::curve, PartKind::solid})
              for (int n = 0; n < std::min(2, part_count(m, kind)); ++n) {
                ModelPlace<T> place;
                const auto domain = domain_of(m, ModelPart{kind, n}).value();
                for (const auto& [from, to] : domain) place.at.push_back((from + to + to) / T(3));
                const auto values = evaluate_part<Interval>(m, ModelPart{kind, n}, place, 2);
                if (!values) out.add(values.error().text());
                if (values)
                  for (const auto& row : values->rows) out.add(row.value);
              }
            return out.text();
          },
          file.model);
    });
  }
  all.add("errors", [] {
    return say(
        read_model(PATCHPROOF_SOURCE_DIR "/examples/none.json").error().text(),
        read_model_text("{\"format\":\"patchproof-model\",\"version\":1,\"patches\":[{}]}", "bad.json").error().text());
  });
  all.run();
}

}  // namespace
}  // namespace patchproof::test
