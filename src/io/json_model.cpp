// SPDX-License-Identifier: Apache-2.0
// Our own JSON model (docs/formats.md, docs/model.schema.json). Curves and patches are delivered one by one as the file is
// walked through, so memory holds the finished ones and one that is not.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "json_model_rules.h"
#include "text_cursor.h"

namespace patchproof {
namespace {

using namespace json_model;

class ModelVisitor final : public JsonVisitor {
 public:
  ModelVisitor(const SourceFile& source, ModelSink& sink) : source_(source), sink_(sink) {}

  std::optional<Error> begin(int node, const JsonWalker& walker) override {
    if (node < kSplineNodes) return current_->begin(node, walker);
    if (node > kGerbs) {
      current_ = &gerbs_.spline();
      return gerbs_.begin(node, walker);
    }
    switch (node) {
      case kPatch:
        patch_.start(2, walker);
        enclosing_ = current_ = &patch_;
        construction_.reset();
        break;
      case kGregory: gregory_ = {"", walker.here(), walker.pointer(), {}, {}}; break;
      case kGerbsCurve: gerbs_.start(1, walker); break;
      case kGerbsPatch: gerbs_.start(2, walker); break;
      case kGregorySurface:
        patch_.start(2, walker);
        current_ = &patch_;
        break;
      case kCoons: return begin_construction(RawConstruction::Kind::coons, walker);
      case kTransfinite: return begin_construction(RawConstruction::Kind::transfinite, walker);
      case kGordon: return begin_construction(RawConstruction::Kind::gordon, walker);
      case kCurve:
        curve_.start(1, walker);
        current_ = &curve_;
        break;
      case kSolid:
        solid_.emplace();
        patch_.start(1, walker);  // its name
        current_ = &patch_;
        break;
      case kSolidBlending:
        solid_->at = walker.here();
        solid_->pointer = walker.pointer();
        blending_.start(1, walker);
        enclosing_ = current_ = &blending_;
        break;
      case kControlPoint:
        curve_.start_point(walker);
        current_ = &curve_;
        break;
      case kCurveList:
      case kParameters: list_ = walker.key(); break;
      case kJoin: join_ = {}; break;
      default: break;
    }
    return std::nullopt;
  }

  std::optional<Error> end(int node, const JsonWalker& walker) override {
    if (node < kSplineNodes) return current_->end(node, walker);
    if (node > kGerbs) return gerbs_.end(node, walker, source_);
    switch (node) {
      case kRoot: return finish(walker);
      case kPatch: return finish_patch(walker);
      case kGregory: return sink_.add(gregory_);
      case kGerbsCurve:
      case kGerbsPatch:
        enclosing_ = current_ = &patch_;
        if (std::optional<Error> error = gerbs_.finish(walker)) return error;
        return sink_.add(gerbs_.raw());
      case kGregorySurface:
        if (std::optional<Error> error = patch_.finish(source_, walker)) return error;
        (walker.key() == "u" ? gregory_.u_surface : gregory_.v_surface) = patch_.raw();
        break;
      case kTransfinite:
        construction_->blending = blending_.raw();
        enclosing_ = current_ = &patch_;
        break;
      case kSolidBlending:
        solid_->blending = blending_.raw();
        enclosing_ = current_ = &patch_;
        break;
      case kSolid:
        solid_->name = patch_.raw().name;
        solids_.push_back(std::move(*solid_));
        solid_.reset();
        break;
      case kCurve:
      case kControlPoint: return finish_curve(walker);
      case kCurveList: construction_->curves[list_]; break;  // also when it is empty
      case kParameters: construction_->parameters[list_]; break;
      case kJoin: joins_.push_back(join_); break;
      case kSideA: join_.patch_a = side_patch_, join_.edge_a = side_edge_, check_later('a'); break;
      case kSideB: join_.patch_b = side_patch_, join_.edge_b = side_edge_, check_later('b'); break;
      default: break;
    }
    return std::nullopt;
  }

  std::optional<Error> leaf(int node, std::string_view text, const JsonWalker& walker) override {
    if (node < kSplineNodes) return current_->leaf(node, text, walker);
    if (node > kGerbs) return gerbs_.leaf(node, text, walker);
    switch (node) {
      case kFormat:
        if (text != "patchproof-model")
          return walker.error(ErrorCode::unknown_format, "the format should be \"patchproof-model\"", text);
        break;
      case kVersion:
        if (text != "1") return walker.error(ErrorCode::unsupported, "only version 1 of the format is read", text);
        break;
      case kUnits: sink_.units = text; break;
      case kGregoryName: gregory_.name = text; break;
      case kAlong:
        if (text != "u" && text != "v")
          return walker.error(ErrorCode::syntax, "a blending runs along \"u\" or \"v\"", text);
        construction_->along_u = text == "u";
        break;
      case kSolidPatch: solid_->controls.push_back({text, {}}); break;
      case kParameter: construction_->parameters[list_].push_back(text); break;
      case kReversed: join_.reversed = text == "true"; break;
      case kSidePatch: {
        const std::optional<long> index = to_integer(text);
        if (!index || *index < 0 || *index > 0x7fffffff)
          return walker.error(ErrorCode::bad_reference, "patches are counted from 0", text);
        side_patch_ = static_cast<int>(*index);
        side_text_ = text;
        break;
      }
      case kSideEdge: {
        constexpr std::string_view kEdges[] = {"u_min", "u_max", "v_min", "v_max"};
        const auto found = std::find(std::begin(kEdges), std::end(kEdges), text);
        if (found == std::end(kEdges))
          return walker.error(ErrorCode::bad_reference, "an edge is u_min, u_max, v_min or v_max", text);
        side_edge_ = static_cast<EdgeName>(found - std::begin(kEdges));
        break;
      }
      default: break;
    }
    return std::nullopt;
  }

 private:
  std::optional<Error> begin_construction(RawConstruction::Kind kind, const JsonWalker& walker) {
    if (construction_) return walker.error(ErrorCode::syntax, "a patch is made in one way only");
    construction_.emplace();
    construction_->kind = kind;
    construction_->at = walker.here();
    construction_->pointer = walker.pointer();
    if (kind == RawConstruction::Kind::transfinite) {
      blending_.start(1, walker);
      enclosing_ = current_ = &blending_;
    }
    return std::nullopt;
  }

  std::optional<Error> finish_patch(const JsonWalker& walker) {
    if (!construction_) {
      if (std::optional<Error> error = patch_.finish(source_, walker)) return error;
      return sink_.add(patch_.raw());
    }
    if (!patch_.is_empty())
      return walker.error(ErrorCode::syntax, "a patch that is made from curves has no degree, knots and points itself");
    construction_->name = patch_.raw().name;
    const std::optional<Error> error = sink_.add(*construction_);
    construction_.reset();
    return error;
  }

  // A curve of the model, or one of a construction: under its own key, or in the list last begun.
  std::optional<Error> finish_curve(const JsonWalker& walker) {
    if (std::optional<Error> error = curve_.finish(source_, walker)) return error;
    current_ = enclosing_;
    if (solid_) {
      solid_->controls.push_back({"", curve_.raw()});
      return std::nullopt;
    }
    if (!construction_) return sink_.add(curve_.raw());
    construction_->curves[walker.key().empty() ? list_ : walker.key()].push_back(curve_.raw());
    return std::nullopt;
  }

  // Joins may stand before the patches: the largest index is compared with their number at the end.
  void check_later(char side) {
    if (!largest_ || side_patch_ > largest_->patch) largest_ = Reference{side_patch_, side_text_, joins_.size(), side};
  }

  std::optional<Error> finish(const JsonWalker& walker) {
    const std::size_t patches = sink_.patch_count() + sink_.gregory_patch_count() + sink_.gerbs_patch_count();
    if (patches == 0 && sink_.curve_count() == 0 && sink_.gerbs_count() == 0)
      return walker.error(ErrorCode::wrong_count, "the model has neither patches nor curves");
    if (largest_ && static_cast<std::size_t>(largest_->patch) >= patches)
      return source_.error(ErrorCode::bad_reference, largest_->text,
                           patches == 0 ? std::string("the model has no patches, only curves")
                                        : fmt::format("the model has patches 0 … {}", patches - 1),
                           largest_->text, fmt::format("/joins/{}/{}/patch", largest_->join, largest_->side));
    for (const RawSolid& solid : solids_)
      if (std::optional<Error> error = sink_.add(solid)) return error;
    sink_.joins = std::move(joins_);
    return std::nullopt;
  }

  const SourceFile& source_;
  ModelSink& sink_;
  JsonSpline patch_, blending_, curve_;
  JsonSpline* current_ = &patch_;    // which of them is being read
  JsonSpline* enclosing_ = &patch_;  // and which one after the curve
  std::optional<RawConstruction> construction_;
  RawGregory gregory_;
  JsonGerbs gerbs_;
  std::optional<RawSolid> solid_;
  std::vector<RawSolid> solids_;  // delivered at the end: they refer to patches
  std::string list_;              // the key of the list last begun in it
  std::vector<DeclaredJoin> joins_;
  struct Reference {
    int patch;
    std::string_view text;
    std::size_t join;
    char side;
  };
  std::optional<Reference> largest_;
  DeclaredJoin join_{};
  int side_patch_ = 0;
  EdgeName side_edge_ = EdgeName::u_min;
  std::string_view side_text_;
};

}  // namespace

std::optional<Error> read_json_model(const SourceFile& source, ModelSink& sink) {
  ModelVisitor visitor(source, sink);
  return JsonWalker(source, kRules, UnknownKeys::refused, visitor).walk();
}

}  // namespace patchproof
