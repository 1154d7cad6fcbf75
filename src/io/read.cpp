// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "json_walker.h"
#include "model_builder.h"
#include "raw_spline.h"
#include "text_cursor.h"

namespace patchproof {
namespace {

struct Format {
  std::string_view name;
  std::string_view extension;  // without the dot; "" for none
  Reader reader;
};

constexpr Format kNewell{"newell", "", read_newell};
constexpr Format kBpt{"bpt", "bpt", read_bpt};
constexpr Format kBez{"bez", "bez", read_bez};
constexpr Format kG2{"g2", "g2", read_g2};
constexpr Format kGismo{"gismo", "xml", read_gismo};
constexpr Format kModel{"patchproof-model", "json", read_json_model};
constexpr Format kGeomdl{"geomdl", "json", read_geomdl};
constexpr Format kTinyspline{"tinyspline", "json", read_tinyspline};
constexpr Format kObj{"obj", "obj", read_obj};

// Ends the walk at the first key that tells the JSON formats apart.
class JsonKind final : public JsonVisitor {
 public:
  enum Node { kRoot, kFormat, kShape, kCoordinates, kObjects, kObject, kArchive };
  static constexpr JsonRule kRules[] = {{kNoParent, "", kRoot, JsonType::object},
                                        {kNoParent, "", kObjects, JsonType::array},
                                        {kRoot, "format", kFormat, JsonType::string},
                                        {kRoot, "shape", kShape, JsonType::object},
                                        {kRoot, "control_points", kCoordinates, JsonType::array},
                                        {kRoot, "archive3dm", kArchive, JsonType::integer},
                                        {kObjects, "", kObject, JsonType::object},
                                        {kObject, "archive3dm", kArchive, JsonType::integer}};
  std::optional<Error> begin(int node, const JsonWalker& walker) override {
    if (node == kShape) return found(kGeomdl, walker);
    return node == kCoordinates ? found(kTinyspline, walker) : std::nullopt;
  }
  std::optional<Error> leaf(int node, std::string_view text, const JsonWalker& walker) override {
    if (node == kFormat && text == "patchproof-curve-mesh")
      return walker.error(ErrorCode::unsupported,
                          "this is a mesh of curves, no model: patchproof fill makes one of it");
    if (node == kFormat) return found(kModel, walker);
    return walker.error(ErrorCode::unsupported,
                        "rhino3dm's JSON, packed binary data of openNURBS, is not read: export STEP or IGES");
  }

  std::optional<Format> format;

 private:
  std::optional<Error> found(const Format& which, const JsonWalker& walker) {
    format = which;
    return walker.error(ErrorCode::usage, "");
  }
};

Result<Format> recognise_json(const SourceFile& source) {
  JsonKind kind;
  const std::optional<Error> error = JsonWalker(source, JsonKind::kRules, UnknownKeys::skipped, kind).walk();
  if (kind.format) return *kind.format;
  if (error) return *error;
  return Error{
      ErrorCode::unknown_format, source.path,
      "a JSON file with neither \"format\" (patchproof-model), \"shape\" (geomdl) nor \"control_points\" (tinyspline)",
      ""};
}

std::string extension_of(std::string_view path) {
  const std::size_t dot = path.find_last_of("./\\");
  if (dot == std::string_view::npos || path[dot] != '.') return "";
  std::string out(path.substr(dot + 1));
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

std::size_t word_count(std::string_view line) {
  const SourceFile text{"", line};
  TextCursor cursor(text, TextCursor::Comments::none);
  std::size_t count = 0;
  while (!cursor.next().empty()) ++count;
  return count;
}

// Free-form geometry in an OBJ file has its type named, in a line of its own.
bool holds_curve_type(std::string_view bytes) {
  for (std::size_t at = bytes.find("cstype"); at != std::string_view::npos; at = bytes.find("cstype", at + 1))
    if (at == 0 || bytes[at - 1] == '\n' || bytes[at - 1] == '\r') return true;
  return false;
}

// The first two lines tell the text formats apart.
std::optional<Format> recognise_text(const SourceFile& source) {
  TextCursor cursor(source, TextCursor::Comments::hash);
  const std::string_view first = cursor.next_line(), second = cursor.next_line();
  if (word_count(first) >= 4) {
    TextCursor words(source, TextCursor::Comments::hash);
    const auto type = to_integer(words.next()), major = to_integer(words.next());
    if (type && major && *type >= 100 && *major == 1) return kG2;
    return std::nullopt;
  }
  if (!to_integer(first)) return std::nullopt;
  if (second.find(',') != std::string_view::npos) return kNewell;
  const std::size_t words = word_count(second);
  if (words == 2) return kBpt;
  if (words > 0 && words % 3 == 0) return kBez;
  return std::nullopt;
}

Result<Format> recognise(const SourceFile& source) {
  const std::size_t begin = source.bytes.find_first_not_of(" \t\r\n\v\f");
  if (begin == std::string_view::npos) return Error{ErrorCode::empty_input, source.path, "nothing but blanks", ""};
  const char c = source.bytes[begin];
  const std::string extension = extension_of(source.path);
  if (c == '{' || c == '[' || extension == kModel.extension) return recognise_json(source);
  if (begins_cad_file(source.bytes))
    return Error{ErrorCode::unsupported, source.path,
                 "a STEP, IGES or BREP file holds trimmed faces: certify reads it, and convert its surfaces", ""};
  if (c == '<' || extension == kGismo.extension) return kGismo;
  if (extension == kObj.extension || holds_curve_type(source.bytes)) return kObj;
  if (source.bytes.starts_with("3D Geometry File Format"))
    return Error{ErrorCode::unsupported, source.path, "Rhino's .3dm is not read: export STEP or IGES", ""};
  if (const std::optional<Format> format = recognise_text(source)) return *format;
  for (const Format& format : {kBpt, kBez, kG2})
    if (extension == format.extension) return format;
  return Error{ErrorCode::unknown_format, source.path,
               "neither JSON, G+Smo XML, .g2, .bpt, .bez, OBJ nor Newell's format (docs/formats.md)", ""};
}

// Either the model in `file`, or the error; `met_root` asks for a wider number type.
template <ExactField T>
std::optional<Error> read_as(const Format& format, const SourceFile& source, ModelFile& file, bool& met_root) {
  ModelBuilder<T> builder(source, file.decimals);
  std::optional<Error> error = format.reader(source, builder);
  met_root = builder.met_root();
  if (error) return error;
  file.notes = std::move(builder.notes);
  file.model = std::move(builder).finish();
  return std::nullopt;
}

}  // namespace

Result<ModelFile> read_model_text(std::string_view bytes, const std::string& path, Decimals decimals) {
  if (bytes.empty()) return Error{ErrorCode::empty_input, path, "the file is empty", ""};
  SourceFile source{path, bytes};
  if (constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf"; source.bytes.starts_with(kByteOrderMark))
    source.bytes.remove_prefix(kByteOrderMark.size());
  const Result<Format> format = recognise(source);
  if (!format) return format.error();

  ModelFile file{path, std::string(format->name), sha256_of(bytes), decimals, Model<Rational>{}, {}};
  bool met_root = false;
  std::optional<Error> error = read_as<Rational>(*format, source, file, met_root);
  if (error && met_root) error = read_as<Quadratic>(*format, source, file, met_root);
  if (error) return *error;
  return file;
}

Result<ModelFile> read_model(const std::string& path, Decimals decimals) {
  const Result<std::string> bytes = load_file(path);
  if (!bytes) return bytes.error();
  return read_model_text(*bytes, path, decimals);
}

}  // namespace patchproof
