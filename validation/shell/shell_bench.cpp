// SPDX-License-Identifier: Apache-2.0
// shell_bench [COLUMNS ROWS [FILE.step]]: an egg crate of so many cells [46 46] is written as STEP, read and certified on one and
// on two threads. Prints times and memory; exits with 1 unless every join's bounds hold the angle that is known.
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "validation/shell/egg_crate.h"

namespace {

using namespace patchproof;

template <class Work>
double seconds(Work work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

// Of all threads: unlike the time on the wall, hardly moved by other programs.
double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto of = [](const timeval& t) { return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) / 1e6; };
  return of(usage.ru_utime) + of(usage.ru_stime);
}

// Joins whose bounds miss the known angle or are wide, or that are smooth and not certified below 1e-3 degrees.
int count_wrong(const shell::EggCrate& crate, const CadModel& model, const Report& report) {
  int wrong = 0;
  for (const ReportedJoin& join : report.joins) {
    const double truth = crate.angle_of(model, join);
    const EnclosedMaximum& angle = join.certificate.angle;
    const double rounding = 1e-9;  // degrees: of the file's decimals and of the doubles in the known angle
    const bool held = angle.lower <= truth + rounding && truth - rounding <= angle.upper;
    const bool tight = truth == 0 ? angle.upper < 1e-3 : angle.upper - angle.lower <= 0.01 * angle.upper;
    wrong += !held || !tight;
    if ((!held || !tight) && wrong <= 5)
      std::printf("wrong: join %d, angle %.12g, bounds [%.12g, %.12g]\n", join.id, truth, angle.lower, angle.upper);
  }
  return wrong;
}

}  // namespace

int main(int count, char** words) {
  shell::EggCrate crate{count > 2 ? std::atoi(words[1]) : 46, count > 2 ? std::atoi(words[2]) : 46, false};
  if (crate.columns < 1 || crate.rows < 1) {
    std::fputs("usage: shell_bench [COLUMNS ROWS [FILE.step]]\n", stderr);
    return 2;
  }
  const std::string path =
      count > 3
          ? words[3]
          : (std::filesystem::temp_directory_path() / ("egg_crate_" + std::to_string(getpid()) + ".step")).string();
  bool made = false;
  const double writing = seconds([&] { made = crate.write_step(path); });
  if (!made) {
    std::fprintf(stderr, "shell_bench: %s cannot be written\n", path.c_str());
    return 1;
  }
  std::printf("%d faces, %d joins, %.1f MB of STEP, made in %.1f s, %.0f MB of memory\n", crate.faces(), crate.joins(),
              static_cast<double>(std::filesystem::file_size(path)) / 1e6, writing, peak_megabytes());
  std::optional<Result<CadModel>> read;
  const double reading = seconds([&] { read.emplace(read_cad_model(path)); });
  if (count <= 3) std::filesystem::remove(path);
  if (!*read) {
    std::fprintf(stderr, "shell_bench: %s\n", read->error().text().c_str());
    return 1;
  }
  const CadModel& model = **read;
  std::printf("read in %.1f s (%.0f us for each face), %.0f MB\n", reading,
              1e6 * reading / static_cast<double>(model.faces.size()), peak_megabytes());
  int wrong = static_cast<int>(model.faces.size()) != crate.faces();
  for (const int jobs : {1, 2}) {
    CertifyOptions options;
    options.jobs = jobs;
    Report report;
    const double before = processor_seconds();
    const double certifying = seconds([&] { report = certify_cad(model, options); });
    const double each = 1e6 / static_cast<double>(report.joins.size());
    std::printf("%zu joins certified on %d thread%s in %.2f s: %.0f us each, %.0f us of a processor, %.0f MB\n",
                report.joins.size(), jobs, jobs == 1 ? "" : "s", certifying, each * certifying,
                each * (processor_seconds() - before), peak_megabytes());
    wrong += static_cast<int>(report.joins.size()) != crate.joins();
    wrong += count_wrong(crate, model, report);
  }
  std::printf("%d wrong\n", wrong);
  return wrong == 0 ? 0 : 1;
}
