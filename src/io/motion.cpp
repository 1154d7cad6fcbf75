// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "json_walker.h"
#include "source_file.h"
#include "text_cursor.h"

namespace patchproof {
namespace {

enum Node {
  kRoot,
  kFormat,
  kVersion,
  kPace,
  kMotions,
  kMotion,
  kCurve,
  kPatch,
  kLocals,
  kLocal,
  kLocalPair,
  kLocalIndex,
  kTranslate,
  kAbout,
  kScale,
  kAxis,
  kRotate,
  kHalfTangent,
  kShear,
  kShearNumber,
  kNumber,
};

constexpr JsonRule kRules[] = {
    {kNoParent, "", kRoot, JsonType::object},
    {kRoot, "format", kFormat, JsonType::string, true},
    {kRoot, "version", kVersion, JsonType::integer, true},
    {kRoot, "pace", kPace, JsonType::string},
    {kRoot, "motions", kMotions, JsonType::array, true},
    {kMotions, "", kMotion, JsonType::object},
    {kMotion, "curve", kCurve, JsonType::integer},
    {kMotion, "patch", kPatch, JsonType::integer},
    {kMotion, "locals", kLocals, JsonType::array},
    {kLocals, "", kLocal, JsonType::integer},
    {kLocals, "", kLocalPair, JsonType::array},
    {kLocalPair, "", kLocalIndex, JsonType::integer},
    {kMotion, "about", kAbout, JsonType::array},
    {kMotion, "translate", kTranslate, JsonType::array},
    {kMotion, "scale", kScale, JsonType::array},
    {kMotion, "rotate", kRotate, JsonType::object},
    {kRotate, "axis", kAxis, JsonType::array, true},
    {kRotate, "half_tangent", kHalfTangent, JsonType::number, true},
    {kMotion, "shear", kShear, JsonType::object},
    {kShear, "xy", kShearNumber, JsonType::number},
    {kShear, "xz", kShearNumber, JsonType::number},
    {kShear, "yx", kShearNumber, JsonType::number},
    {kShear, "yz", kShearNumber, JsonType::number},
    {kShear, "zx", kShearNumber, JsonType::number},
    {kShear, "zy", kShearNumber, JsonType::number},
    {kTranslate, "", kNumber, JsonType::number},
    {kAbout, "", kNumber, JsonType::number},
    {kScale, "", kNumber, JsonType::number},
    {kAxis, "", kNumber, JsonType::number},
};

// Of whose root the model's numbers are; 1: of none.
int root_of(const Model<Quadratic>& model) {
  int root = 1;
  const auto numbers = [&](const std::vector<Quadratic>& all) {
    for (const Quadratic& x : all) root = std::max(root, x.root());
  };
  const auto points = [&](const std::vector<Vec<Quadratic, 4>>& all) {
    for (const Vec<Quadratic, 4>& p : all)
      for (const Quadratic& x : p.c) root = std::max(root, x.root());
  };
  const auto basis = [&](const FunctionBasis<Quadratic>& b) {
    if (b.knots()) numbers(b.knots()->knots());
  };
  const auto patch = [&](const BsplinePatch<Quadratic, 4>& s) {
    points(s.net());
    for (const Direction d : {Direction::u, Direction::v}) numbers(s.knots(d).knots());
  };
  for (const auto& c : model.curves) numbers(c.curve.knots().knots()), points(c.curve.points());
  for (const auto& p : model.patches) patch(p.surface);
  for (const auto& g : model.gregory_patches) patch(g.patch.u_surface()), patch(g.patch.v_surface());
  for (const auto& c : model.gerbs_curves) {
    numbers(c.curve.knots().knots());
    for (const auto& local : c.curve.locals()) points(local.points()), basis(local.basis());
  }
  for (const auto& g : model.gerbs_patches)
    for (const Direction d : {Direction::u, Direction::v}) {
      numbers(g.surface.knots(d).knots());
      for (int p = 0; p < g.surface.axis(Direction::u).distinct(); ++p)
        for (int q = 0; q < g.surface.axis(Direction::v).distinct(); ++q)
          points(g.surface.local(p, q).net()), basis(g.surface.local(p, q).basis(d));
    }
  for (const auto& solid : model.solids)
    for (const auto& control : solid.controls)
      for (const Quadratic& x : control.point.c) root = std::max(root, x.root());
  return root;
}

template <ExactField T>
class MotionVisitor final : public JsonVisitor {
 public:
  MotionVisitor(Decimals decimals, const Model<T>& model, ModelMotion<T>& out)
      : decimals_(decimals), model_(model), out_(out) {
    if constexpr (std::same_as<T, Quadratic>) root_ = root_of(model);
    out_.curves.resize(model.gerbs_curves.size());
    out_.patches.resize(model.gerbs_patches.size());
  }

  std::optional<Error> begin(int node, const JsonWalker& walker) override {
    switch (node) {
      case kMotion:
        motion_ = {};
        curve_.reset(), patch_.reset();
        locals_.clear();
        has_locals_ = false;
        break;
      case kLocals: has_locals_ = true; break;
      case kLocalPair: locals_.push_back({{}, walker.pointer(), {}}); break;
      case kTranslate:
      case kAbout:
      case kScale:
      case kAxis: count_ = 0; break;
      default: break;
    }
    return std::nullopt;
  }

  std::optional<Error> end(int node, const JsonWalker& walker) override {
    switch (node) {
      case kTranslate: return three(motion_.translation, walker);
      case kScale: return three(motion_.scale, walker);
      case kAbout: return three(motion_.about.emplace(), walker);
      case kAxis:
        if (auto error = three(motion_.axis, walker)) return error;
        if (motion_.axis == Vec<T, 3>{})
          return walker.error(ErrorCode::bad_number, "an axis of length 0 has no direction");
        break;
      case kMotion: return finish(walker);
      default: break;
    }
    return std::nullopt;
  }

  std::optional<Error> leaf(int node, std::string_view text, const JsonWalker& walker) override {
    switch (node) {
      case kFormat:
        if (text != "patchproof-motion")
          return walker.error(ErrorCode::unknown_format, "the format should be \"patchproof-motion\"", text);
        break;
      case kVersion:
        if (text != "1") return walker.error(ErrorCode::unsupported, "only version 1 of the format is read", text);
        break;
      case kPace: return read_pace(text, walker);
      case kCurve: curve_ = Reference{std::string(text), walker.pointer(), {}}; break;
      case kPatch: patch_ = Reference{std::string(text), walker.pointer(), {}}; break;
      case kLocal: locals_.push_back({std::string(text), walker.pointer(), {to_integer(text).value_or(-1)}}); break;
      case kLocalIndex:
        locals_.back().text += (locals_.back().indices.empty() ? "" : ", ") + std::string(text);
        locals_.back().indices.push_back(to_integer(text).value_or(-1));
        break;
      case kNumber:
        if (count_ == 3) return walker.error(ErrorCode::wrong_count, "three numbers should stand here", text);
        return number(text, walker, three_[count_++]);
      case kHalfTangent: return number(text, walker, motion_.half_tangent);
      case kShearNumber:
        return number(text, walker,
                      motion_.shear[walker.key()[0] - 'x'][static_cast<std::size_t>(walker.key()[1] - 'x')]);
      default: break;
    }
    return std::nullopt;
  }

 private:
  // A number, or a pair of them, to be looked up when the whole motion is read.
  struct Reference {
    std::string text, pointer;
    std::vector<long> indices;
  };

  std::optional<Error> number(std::string_view text, const JsonWalker& walker, T& value) {
    Result<T> read = parse_scalar<T>(text, decimals_);
    if (!read)
      return walker.error(read.error().code,
                          mentions_root(text) && std::same_as<T, Rational>
                              ? "the model's numbers are rational, and so must be those of its motion"
                              : read.error().message,
                          text);
    if (const double size = std::abs(nearest_double(*read)); !(size <= 1e100))
      return walker.error(ErrorCode::bad_number, "numbers of a motion are at most 10^100 in size", text);
    if constexpr (std::same_as<T, Quadratic>)
      if (const int root = read->root(); root != 1 && root != root_) {
        if (root_ != 1)
          return walker.error(ErrorCode::mixed_roots, "the model and its motion hold two different square roots",
                              fmt::format("sqrt({}) and {}", root_, text));
        root_ = root;
      }
    value = std::move(*read);
    return std::nullopt;
  }

  std::optional<Error> three(Vec<T, 3>& value, const JsonWalker& walker) {
    if (count_ != 3)
      return walker.error(ErrorCode::wrong_count, "three numbers should stand here", std::to_string(count_));
    value = three_;
    return std::nullopt;
  }

  std::optional<Error> read_pace(std::string_view text, const JsonWalker& walker) {
    Result<BFunction> pace = BFunction::parse(text);
    if (!pace) {
      std::string message = pace.error().message;
      if (!pace.error().where.empty()) message = pace.error().where + ": " + message;
      return walker.error(pace.error().code, message, text);
    }
    if (!pace->is_exact())
      return walker.error(ErrorCode::unsupported,
                          "a pace must have exact values: polynomial, beta, rational, bernstein", text);
    out_.pace = std::move(*pace);
    return std::nullopt;
  }

  static Error at(const JsonWalker& walker, const Reference& what, ErrorCode code, std::string message) {
    Error error = walker.error(code, std::move(message), what.text);
    if (const auto place = error.where.rfind(" at /"); place != std::string::npos)
      error.where = error.where.substr(0, place) + " at " + what.pointer;
    return error;
  }

  // The number among the GERBS curves or patches, of which there are `count` after `before` others.
  std::optional<Error> find(const JsonWalker& walker, const Reference& what, const char* kinds, std::size_t before,
                            std::size_t count, std::size_t& index) const {
    const std::optional<long> read = to_integer(what.text);
    const long first = static_cast<long>(before), end = first + static_cast<long>(count);
    if (!read || *read < first || *read >= end)
      return at(walker, what, ErrorCode::bad_reference,
                count == 0 ? fmt::format("the model has no GERBS {}", kinds)
                           : fmt::format("the GERBS {} of the model have the numbers {} … {}", kinds, first, end - 1));
    index = static_cast<std::size_t>(*read - first);
    return std::nullopt;
  }

  std::optional<Error> finish(const JsonWalker& walker) {
    if (curve_.has_value() == patch_.has_value())
      return walker.error(ErrorCode::syntax, "a motion is one of a \"curve\" or of a \"patch\"");
    const std::size_t directions = curve_ ? 1 : 2;
    std::size_t index = 0;
    std::array<int, 2> counts{1, 1};
    if (curve_) {
      if (auto error = find(walker, *curve_, "curves", model_.curves.size(), model_.gerbs_curves.size(), index))
        return error;
      const GerbsCurve<T, 4>& c = model_.gerbs_curves[index].curve;
      counts[0] = static_cast<int>(c.locals().size()) - (c.is_closed() ? 1 : 0);
    } else {
      if (auto error = find(walker, *patch_, "patches", model_.patches.size(), model_.gerbs_patches.size(), index))
        return error;
      const GerbsSurface<T, 4>& s = model_.gerbs_patches[index].surface;
      counts = {s.axis(Direction::u).distinct(), s.axis(Direction::v).distinct()};
    }
    std::vector<LocalMotion<T>>& all = curve_ ? out_.curves[index] : out_.patches[index];
    for (const Reference& local : locals_) {
      if (local.indices.size() != directions)
        return at(walker, local, ErrorCode::wrong_count,
                  curve_ ? "a local curve has one number" : "a local patch has two numbers, [row, column]");
      for (std::size_t d = 0; d < directions; ++d)
        if (local.indices[d] < 0 || local.indices[d] >= counts[d])
          return at(walker, local, ErrorCode::bad_reference,
                    directions == 1 ? fmt::format("local curves have the numbers 0 … {}", counts[0] - 1)
                                    : fmt::format("local patches are [0 … {}, 0 … {}]", counts[0] - 1, counts[1] - 1));
      all.push_back(
          {static_cast<int>(local.indices[0]), directions == 2 ? static_cast<int>(local.indices[1]) : 0, motion_});
    }
    if (!has_locals_)
      for (int p = 0; p < counts[0]; ++p)
        for (int q = 0; q < counts[1]; ++q) all.push_back({p, q, motion_});
    return std::nullopt;
  }

  const Decimals decimals_;
  const Model<T>& model_;
  ModelMotion<T>& out_;
  AffineMotion<T> motion_;
  std::optional<Reference> curve_, patch_;
  std::vector<Reference> locals_;
  bool has_locals_ = false;
  Vec<T, 3> three_;
  int count_ = 0;
  int root_ = 1;  // of the numbers so far, the model's first
};

}  // namespace

template <ExactField T>
Result<ModelMotion<T>> read_motion_text(std::string_view bytes, const std::string& path, const Model<T>& model,
                                        Decimals decimals) {
  if (bytes.find_first_not_of(" \t\r\n\v\f") == std::string_view::npos)
    return Error{ErrorCode::empty_input, path, bytes.empty() ? "the file is empty" : "nothing but blanks", ""};
  ModelMotion<T> out{BFunction::polynomial(0).value(), {}, {}};
  const SourceFile source{path, bytes};
  MotionVisitor<T> visitor(decimals, model, out);
  if (std::optional<Error> error = JsonWalker(source, kRules, UnknownKeys::refused, visitor).walk()) return *error;
  return out;
}

template <ExactField T>
Result<ModelMotion<T>> read_motion(const std::string& path, const Model<T>& model, Decimals decimals) {
  const Result<std::string> bytes = load_file(path);
  if (!bytes) return bytes.error();
  return read_motion_text(*bytes, path, model, decimals);
}

template <ExactField T>
Model<T> frame(const Model<T>& model, const ModelMotion<T>& motion, int k, int n) {
  const T phase = embed<T>(frame_phase(motion.pace, k, n));
  Model<T> out = model;
  for (std::size_t i = 0; i < out.gerbs_curves.size(); ++i) {
    auto& curve = out.gerbs_curves[i];
    curve.curve = moved(curve.curve, motion.curves[i], phase);
    for (const auto& local : curve.curve.locals())
      for (const Vec<T, 4>& p : local.points())
        if (!(p[2] == T(0))) curve.dimension = 3;
  }
  for (std::size_t i = 0; i < out.gerbs_patches.size(); ++i)
    out.gerbs_patches[i].surface = moved(out.gerbs_patches[i].surface, motion.patches[i], phase);
  return out;
}

template Result<ModelMotion<Rational>> read_motion(const std::string&, const Model<Rational>&, Decimals);
template Result<ModelMotion<Quadratic>> read_motion(const std::string&, const Model<Quadratic>&, Decimals);
template Result<ModelMotion<Rational>> read_motion_text(std::string_view, const std::string&, const Model<Rational>&,
                                                        Decimals);
template Result<ModelMotion<Quadratic>> read_motion_text(std::string_view, const std::string&, const Model<Quadratic>&,
                                                         Decimals);
template Model<Rational> frame(const Model<Rational>&, const ModelMotion<Rational>&, int, int);
template Model<Quadratic> frame(const Model<Quadratic>&, const ModelMotion<Quadratic>&, int, int);

}  // namespace patchproof
