// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>

#include "cli/commands.h"
#include "cli/interrupt.h"

namespace patchproof::cli {

int report_error(const Error& error) {
  std::fprintf(stderr, "patchproof: %s\n", error.text().c_str());
  return kBadInput;
}

void add_decimals(CLI::App& command, Decimals& decimals) {
  const std::map<std::string, Decimals> names{{"exact", Decimals::exact}, {"binary64", Decimals::binary64}};
  command.add_option("--decimals", decimals, "read decimals as exact fractions, or as the nearest doubles")
      ->transform(CLI::CheckedTransformer(names))
      ->option_text("exact|binary64 [exact]");
}

int write_output(const std::string& path, const std::string& text) {
  if (path == "-") {
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    return written
               ? 0
               : report_error({ErrorCode::cannot_open, "standard output", "cannot be written", std::strerror(errno)});
  }
  // A device or a pipe takes the bytes itself: renaming a file over it would replace it.
  std::error_code ignored;
  const auto kind = std::filesystem::status(path, ignored).type();
  const bool special = kind != std::filesystem::file_type::regular && kind != std::filesystem::file_type::not_found &&
                       kind != std::filesystem::file_type::directory;
  // A link is followed; the temporary file has a name that nobody else uses.
  const std::filesystem::path followed = std::filesystem::weakly_canonical(path, ignored);
  const std::string whole = ignored || followed.empty() ? path : followed.string();
  const std::string target = special ? path : whole + ".partial-" + std::to_string(getpid());
  const auto failed = [&] {
    const Error error{ErrorCode::cannot_open, path, "cannot be written", std::strerror(errno)};
    if (!special) std::remove(target.c_str());
    return report_error(error);
  };
  std::optional<Unfinished> unfinished;
  if (!special) unfinished.emplace(target);
  std::FILE* file = std::fopen(target.c_str(), "wb");
  if (!file) return failed();
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (std::fclose(file) != 0 || !written) return failed();
  if (!special && std::rename(target.c_str(), whole.c_str()) != 0) return failed();
  return 0;
}

}  // namespace patchproof::cli
