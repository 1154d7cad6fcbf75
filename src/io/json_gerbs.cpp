// SPDX-License-Identifier: Apache-2.0
#include "json_gerbs.h"

namespace patchproof {

void JsonGerbs::start(int directions, const JsonWalker& walker) {
  *this = JsonGerbs();
  raw_.directions = directions;
  raw_.at = walker.here();
  raw_.pointer = walker.pointer();
}

std::optional<Error> JsonGerbs::begin(int node, const JsonWalker& walker) {
  switch (node) {
    case kGerbsKnots:
      if (knot_vectors_ == raw_.directions)
        return walker.error(ErrorCode::wrong_count, "a patch has two lists of knots, for u and for v");
      break;
    case kLocalCurve:
    case kLocalPatch:
    case kBlendedCurve:
      local_ = {};
      local_.at = walker.here();
      local_.pointer = walker.pointer();
      row_ = 0;
      spline_.start(node == kLocalPatch ? 2 : 1, walker);
      break;
    case kMapRow:
      if (row_ == 3) return walker.error(ErrorCode::wrong_count, "a map has three rows of four numbers");
      break;
    default: break;
  }
  return std::nullopt;
}

std::optional<Error> JsonGerbs::end(int node, const JsonWalker& walker, const SourceFile& source) {
  switch (node) {
    case kGerbsKnots: ++knot_vectors_, has_knots_ = true; break;
    case kGerbsKnotVectors:
      if (knot_vectors_ != 2)
        return walker.error(ErrorCode::wrong_count, "two lists of knots should stand here",
                            std::to_string(knot_vectors_));
      break;
    case kClosedDirections:
      if (closed_ != 2)
        return walker.error(ErrorCode::wrong_count, "two answers should stand here", std::to_string(closed_));
      break;
    case kMapRow:
      if (local_.map.size() != 4 * static_cast<std::size_t>(++row_))
        return walker.error(ErrorCode::wrong_count, "a map has three rows of four numbers",
                            std::to_string(local_.map.size()));
      break;
    case kMap:
      if (row_ != 3)
        return walker.error(ErrorCode::wrong_count, "a map has three rows of four numbers", std::to_string(row_));
      break;
    case kLocals:
    case kLocalPatches: has_locals_ = true; break;
    case kLocalCurve:
    case kLocalPatch:
    case kBlendedCurve:
      if (local_.same_as.empty()) {
        if (std::optional<Error> error = spline_.finish(source, walker)) return error;
        local_.spline = spline_.raw();
      } else if (!spline_.is_empty() || local_.trigonometric[0] || local_.trigonometric[1]) {
        return walker.error(ErrorCode::syntax, "what is the same as another has no degree, knots and points itself");
      }
      (node == kBlendedCurve ? raw_.blended[walker.key()] : raw_.locals.emplace_back()) = local_;
      break;
    default: break;
  }
  return std::nullopt;
}

std::optional<Error> JsonGerbs::leaf(int node, std::string_view text, const JsonWalker& walker) {
  switch (node) {
    case kGerbsName: raw_.name = text; break;
    case kBFunction: raw_.b_function = text; break;
    case kGerbsKnot: raw_.knots[knot_vectors_].push_back(text); break;
    case kClosed:
      if (closed_ == raw_.directions) return walker.error(ErrorCode::wrong_count, "a patch has two directions", text);
      raw_.closed[closed_++] = text == "true";
      break;
    case kTrigonometric:
      if (text.empty()) return walker.error(ErrorCode::syntax, "a direction should stand here", text);
      for (const char direction : text) {
        const std::size_t d = std::string_view(raw_.directions == 1 ? "t" : "uv").find(direction);
        if (d == std::string_view::npos)
          return walker.error(
              ErrorCode::syntax,
              raw_.directions == 1 ? "a curve's direction is \"t\"" : "directions are \"u\", \"v\" and \"uv\"", text);
        if (local_.trigonometric[d]) return walker.error(ErrorCode::syntax, "a direction stands here twice", text);
        local_.trigonometric[d] = true;
      }
      break;
    case kSameAs: local_.same_as = text; break;
    case kMapNumber: local_.map.push_back(text); break;
    case kOverlap: raw_.overlap = text; break;
    default: break;
  }
  return std::nullopt;
}

std::optional<Error> JsonGerbs::finish(const JsonWalker& walker) {
  if (raw_.is_blend()) {
    if (has_knots_ || has_locals_ || closed_ > 0)
      return walker.error(ErrorCode::syntax, "a blend of two curves has neither knots nor local curves itself");
    return std::nullopt;
  }
  if (!has_knots_) return walker.error(ErrorCode::syntax, "the key \"knots\" is missing");
  if (!has_locals_) return walker.error(ErrorCode::syntax, "the key \"locals\" is missing");
  return std::nullopt;
}

}  // namespace patchproof
