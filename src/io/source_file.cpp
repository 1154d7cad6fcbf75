// SPDX-License-Identifier: Apache-2.0
#include "source_file.h"

#include <sha2.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>

#include <fmt/format.h>

namespace patchproof {
namespace {

constexpr std::size_t kShownValues = 240;

std::string printable(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f)
      out += fmt::format("\\x{:02x}", byte);
    else
      out += c;
  }
  return out;
}

std::string shortened(std::string_view text) {
  if (text.size() <= kShownValues) return printable(text);
  const std::size_t half = kShownValues / 2;
  return printable(text.substr(0, half)) + " … " + printable(text.substr(text.size() - half)) +
         fmt::format(" ({} characters)", text.size());
}

}  // namespace

long SourceFile::line_of(std::string_view part) const {
  const std::less_equal<const char*> before;
  if (part.data() == nullptr || !before(bytes.data(), part.data()) || !before(part.data(), bytes.data() + bytes.size()))
    return 0;
  return 1 + std::count(bytes.data(), part.data(), '\n');
}

std::string SourceFile::place(std::string_view at, std::string_view pointer) const {
  std::string out = path;
  if (const long line = line_of(at)) out += fmt::format(":{}", line);
  if (!pointer.empty()) out += fmt::format(" at {}", pointer);
  return out;
}

Error SourceFile::error(ErrorCode code, std::string_view at, std::string message, std::string_view values,
                        std::string_view pointer) const {
  return Error{code, place(at, pointer), std::move(message), shortened(values)};
}

Result<std::string> load_file(const std::string& path) {
  namespace fs = std::filesystem;
  const auto refuse = [&path](ErrorCode code, std::string message) {
    return Error{code, path, std::move(message), ""};
  };
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  if (status.type() == fs::file_type::not_found) return refuse(ErrorCode::cannot_open, "no such file");
  if (failure) return refuse(ErrorCode::cannot_open, failure.message());
  if (status.type() == fs::file_type::directory) return refuse(ErrorCode::cannot_open, "a directory, not a file");
  // A pipe or a device may never end.
  if (status.type() != fs::file_type::regular) return refuse(ErrorCode::cannot_open, "not a regular file");

  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) return refuse(ErrorCode::cannot_open, std::strerror(errno));
  const auto size = fs::file_size(path, failure);
  if (failure) return refuse(ErrorCode::cannot_open, failure.message());
  if (size > static_cast<unsigned long long>(kMaxFileBytes))
    return refuse(ErrorCode::unsupported, fmt::format("{} bytes: files above 1 GiB are not read", size));
  // One byte more than the size: files under /proc announce 0 bytes, and a file may grow meanwhile.
  std::string bytes(static_cast<std::size_t>(size) + 1, '\0');
  std::size_t used = 0;
  while (const std::size_t got = std::fread(bytes.data() + used, 1, bytes.size() - used, file.get())) {
    used += got;
    if (used < bytes.size()) continue;
    if (used > static_cast<std::size_t>(kMaxFileBytes))
      return refuse(ErrorCode::unsupported, "files above 1 GiB are not read");
    bytes.resize(2 * used);
  }
  if (std::ferror(file.get())) return refuse(ErrorCode::cannot_open, "the file could not be read to its end");
  bytes.resize(used);
  return bytes;
}

bool begins_cad_file(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, 4096);
  const auto has = [&](std::string_view words) { return head.find(words) != std::string_view::npos; };
  // IGES: 80 columns, the 73rd of the first line is an S.
  return has("ISO-10303-21") || has("DBRep_DrawableShape") || has("CASCADE Topology") ||
         (head.size() > 80 && head[72] == 'S' && (head[80] == '\n' || head[80] == '\r'));
}

std::string sha256_of(std::string_view bytes) {
  char digits[SHA256_DIGEST_STRING_LENGTH];
  SHA256Data(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), digits);
  return digits;
}

}  // namespace patchproof
