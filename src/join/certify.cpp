// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/certify.h"

#include <atomic>

#include "join/witness.h"
#include "patchproof/deadline.h"
#include "patchproof/join/filter.h"
#include "patchproof/parallel.h"
#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/scalar/quadratic.h"

namespace patchproof {
namespace {

constexpr const char* rung_name(const Rational*) { return "integer"; }
constexpr const char* rung_name(const Quadratic*) { return "quadratic"; }

template <ExactField T>
class JoinCertifier {
  using R = proof_ring_t<T>;

 public:
  JoinCertifier(const BsplinePatch<T, 4>& a, const BsplinePatch<T, 4>& b, const Join<T>& join, const Request& request)
      : pieces_(join_pieces(a, b, join)),
        witnesses_(join, pieces_),
        request_(request),
        numerical_pairing_(join.pairing.kind == PairingKind::piecewise_linear) {
    for (const JoinPiece<T>& piece : pieces_) interval_.push_back(join_forms<Interval>(piece));
    fits_ = fits_interval_rung(interval_);
  }

  Certificate run() {
    certificate_ = nothing_known();
    try {
      decide_and_bound();
    } catch (const deadline_passed&) {  // what was decided until then holds
      say_time_is_up(certificate_);
      bound_what_is_left();
    }
    return std::move(certificate_);
  }

  // What is known without a look at the join.
  static Certificate nothing_known() {
    Certificate out;
    out.gap = {0, std::numeric_limits<double>::infinity(), {}, false};
    out.angle = {0, 180, {}, false};
    out.plane_angle = {0, 90, {}, false};
    out.rung = "interval";
    return out;
  }
  static void say_time_is_up(Certificate& out) {
    for (ExactClass* c : {&out.c0, &out.c1, &out.c2, &out.g1})
      if (c->verdict == Verdict::undecided && c->reason.empty()) c->reason = "the time for one join is up";
  }

 private:
  void decide_and_bound() {
    if (fits_ && interval_rung_refutes_c0(interval_)) {
      Budget quick = budget_;
      quick.nodes = kQuickNodes;
      set_gap(bound_gap(interval_, quick));
      if (!certificate_.gap.converged) bound_gap_exactly();
      decide_without_c0();
    } else if (std::all_of(exact().begin(), exact().end(), [](const JoinForms<R>& f) { return is_c0(f); })) {
      certificate_.c0.verdict = Verdict::proven;
      certificate_.gap = {0, 0, witnesses_.place(0, T(0)), true};
      decide_smoothness();
      if (certificate_.g1.verdict == Verdict::proven || orientation_known_) return;
    } else {
      bound_gap_exactly();
      decide_without_c0();
    }
    bound_angle();
  }

  // Intervals take no time worth speaking of, even where none is left.
  void bound_what_is_left() {
    Budget none = budget_;
    none.nodes = 0;
    EnclosedMaximum &gap = certificate_.gap, &angle = certificate_.angle, &plane = certificate_.plane_angle;
    if (gap.upper == std::numeric_limits<double>::infinity()) gap = located(bound_gap(interval_, none));
    if (numerical_pairing_) gap.lower = 0;
    if (angle.lower == 0 && angle.upper == 180)
      angle = located(interval_rung_bound_angle(interval_, Deviation::angle, none));
    if (angle.upper <= 90)
      plane = angle;
    else if (!plane.converged)
      plane.at = angle.at;
  }

  // Keeps the bounds that there are, and goes on to the witness, when the time is up.
  void bound_gap_exactly() {
    try {
      set_gap(bound_gap(exact(), budget_));
    } catch (const deadline_passed&) {  // decide_without_c0 may still find a witness
    }
  }

  const std::vector<JoinForms<R>>& exact() {
    if (exact_.empty()) {
      certificate_.rung = rung_name(static_cast<const T*>(nullptr));
      for (const JoinPiece<T>& piece : pieces_) exact_.push_back(join_forms<R>(piece));
    }
    return exact_;
  }

  EnclosedMaximum located(const DeviationBound& bound) {
    EnclosedMaximum maximum{bound.lower, bound.upper, {}, bound.converged};
    maximum.at = witnesses_.place(bound.piece, embed<T>(from_double(bound.t)));
    return maximum;
  }
  // A tolerance between the bounds: halve on until it is decided, as far as the budget goes.
  template <class Rebound>
  DeviationBound until_decided(DeviationBound bound, const std::optional<double>& tolerance, Rebound rebound) {
    Budget finer = budget_;
    for (const int bits : {20, 36, 48}) {
      if (!tolerance || *tolerance < bound.lower || bound.upper <= *tolerance) break;
      finer.tight_bits = bits;
      bound = rebound(finer);
    }
    return bound;
  }

  void set_gap(DeviationBound bound) {
    if (bound.converged)
      bound = until_decided(bound, request_.gap_tolerance, [&](const Budget& b) { return bound_gap(exact(), b); });
    certificate_.gap = located(bound);
    gap_witness_ = {bound.piece, embed<T>(from_double(bound.t))};
  }

  // The paired points differ. Under a pairing that was found numerically this says nothing about the curves.
  void decide_without_c0() {
    if (numerical_pairing_) {
      for (ExactClass* c : {&certificate_.c0, &certificate_.c1, &certificate_.c2, &certificate_.g1})
        *c = {Verdict::undecided, "the edges run differently; their pairing was found numerically", std::nullopt};
      certificate_.gap.lower = 0;
      certificate_.gap.converged = false;
      return;
    }
    certificate_.c0 = {Verdict::refuted, "the edge curves differ",
                       witnesses_.find(Quantity::point_difference, gap_witness_)};
    for (ExactClass* c : {&certificate_.c1, &certificate_.c2, &certificate_.g1})
      *c = {Verdict::refuted, "not C0", std::nullopt};
  }

  void decide_smoothness() {
    decide_cross_derivatives();
    if (!reduce_normals()) {
      certificate_.g1 = {Verdict::undecided, "no normal up to second order along a whole edge", std::nullopt};
      return;
    }
    for (std::size_t i = 0; i < exact().size(); ++i)
      if (!is_coplanar(exact()[i], normals_[i].first, normals_[i].second)) {
        certificate_.g1 = {Verdict::refuted, "the tangent planes differ",
                           witnesses_.find(Quantity::coplanarity, {static_cast<int>(i), T(1) / T(2)})};
        if (!certificate_.g1.witness)  // only a limit normal tells them apart
          certificate_.g1.reason = "the limit tangent planes differ";
        return;
      }
    decide_orientation();
  }

  // False when a side has no normal up to second order on some piece.
  bool reduce_normals() {
    if (!normals_.empty()) return normals_found_;
    for (std::size_t i = 0; i < exact().size(); ++i) {
      normals_.emplace_back(reduce_normal(exact()[i].a), reduce_normal(exact()[i].b));
      note_degeneracies('a', normals_.back().first, pieces_[i]);
      note_degeneracies('b', normals_.back().second, pieces_[i]);
      normals_found_ = normals_found_ && normals_.back().first.found() && normals_.back().second.found();
    }
    return normals_found_;
  }

  void decide_cross_derivatives() {
    bool equal = true, constant = true, determined = false;
    std::optional<T> ratio;
    int differing = 0;
    for (std::size_t i = 0; i < exact().size(); ++i) {
      const CrossMatch<R> match = match_cross_derivatives(exact()[i]);
      if (equal && !match.equal) equal = false, differing = static_cast<int>(i);
      if (!match.determined) continue;
      determined = true;
      if (!match.ratio) {
        constant = false;
        continue;
      }
      const T lambda = embed<T>(match.ratio->first) / embed<T>(match.ratio->second);
      if (ratio && !(*ratio == lambda)) constant = false;
      ratio = lambda;
    }
    if (determined && constant && *scalar_traits<T>::sign(*ratio) == Sign::positive)
      certificate_.ratio = to_text(*ratio);
    if (!equal) {
      const std::string reason = certificate_.ratio
                                     ? "cross-boundary derivatives differ by the constant factor " + *certificate_.ratio
                                     : "cross-boundary derivatives differ";
      certificate_.c1 = {Verdict::refuted, reason,
                         witnesses_.find(Quantity::first_derivative, {differing, T(1) / T(2)})};
      certificate_.c2 = {Verdict::refuted, "not C1", std::nullopt};
      return;
    }
    certificate_.c1.verdict = Verdict::proven;
    for (std::size_t i = 0; i < exact().size(); ++i)
      if (!is_c2(exact()[i])) {
        certificate_.c2 = {Verdict::refuted, "second cross-boundary derivatives differ",
                           witnesses_.find(Quantity::second_derivative, {static_cast<int>(i), T(1) / T(2)})};
        return;
      }
    certificate_.c2.verdict = Verdict::proven;
  }

  void note_degeneracies(char side, const ReducedNormal<R>& normal, const JoinPiece<T>& piece) {
    const auto add = [&](const T& begin, const T& end, const std::string& what) {
      const auto at = [&](const T& t) { return nearest_double(T(piece.a_begin + t * (piece.a_end - piece.a_begin))); };
      certificate_.degenerate.push_back({side, at(begin), at(end), what});
    };
    if (!normal.found()) {
      add(T(0), T(1), "no normal up to second order");
      return;
    }
    if (normal.order == NormalOrder::second)
      add(T(0), T(1), "the normal vanishes along the line; its second-order limit is used");
    if (normal.ends.at_zero > 0) add(T(0), T(0), "the normal vanishes; its limit is used");
    if (normal.ends.at_one > 0) add(T(1), T(1), "the normal vanishes; its limit is used");
    if (normal.has_factor())
      for (const auto& [begin, end] : isolate_roots(over_field(normal.factor), T(T(1) / T(1 << 20))))
        add(begin, end, "the normal vanishes; its limit is used");
  }

  // Coplanar normals: the signs of n_A · n_B between the zeros of the divided factors.
  void decide_orientation() {
    bool smooth = false, cusp = false;
    std::pair<int, T> cusp_at{0, T(1) / T(2)};
    for (std::size_t i = 0; i < normals_.size(); ++i) {
      const auto& [a, b] = normals_[i];
      const BinaryForm<T> factor = over_field(a.factor) * over_field(b.factor), side = over_field(dot(a.n, b.n));
      std::vector<T> samples{T(1) / T(2)};
      if (factor.degree() > 0) {
        samples.clear();
        T left(0);
        for (const auto& [begin, end] : isolate_roots(factor, T(T(1) / T(1 << 20)))) {
          samples.push_back((left + begin) / T(2));
          left = end;
        }
        samples.push_back((left + T(1)) / T(2));
      }
      for (const T& t : samples) {
        const Sign sign = *scalar_traits<T>::sign(factor(t) * side(t));
        if (sign == Sign::negative) smooth = true;
        if (sign == Sign::positive) cusp = true, cusp_at = {static_cast<int>(i), t};
      }
    }
    orientation_known_ = true;
    certificate_.angle = certificate_.plane_angle = {0, 0, witnesses_.place(0, T(0)), true};
    if (smooth && !cusp) {
      certificate_.g1.verdict = Verdict::proven;
      certificate_.orientation = Orientation::smooth;
      return;
    }
    certificate_.orientation = smooth ? Orientation::mixed : Orientation::cusp;
    certificate_.g1 = {Verdict::refuted,
                       smooth ? "the patches change sides along the edge" : "the patches fold back on each other",
                       witnesses_.find(Quantity::normal_product, cusp_at)};
    certificate_.angle = {180, 180, witnesses_.place(cusp_at.first, cusp_at.second), true};
    certificate_.plane_angle.at = certificate_.angle.at;  // the planes coincide: exactly 0
  }

  void bound_angle() {
    Budget quick = budget_;
    quick.nodes = kQuickNodes;
    DeviationBound bound;
    bound.converged = false;
    if (fits_) bound = interval_rung_bound_angle(interval_, Deviation::angle, quick);
    const std::optional<double>& tolerance = request_.angle_tolerance;
    const bool decided = !tolerance || *tolerance < bound.lower || bound.upper <= *tolerance;
    if (bound.converged && bound.upper < 90 && decided) {
      certificate_.orientation = Orientation::smooth;
      certificate_.angle = certificate_.plane_angle = located(bound);
      return;
    }
    if (fits_) certificate_.angle = located(bound);  // until something better is known
    if (!reduce_normals()) {
      certificate_.angle = {0, 180, witnesses_.place(0, T(0)), false};
      certificate_.plane_angle = {0, 90, witnesses_.place(0, T(0)), false};
      return;
    }
    const auto exactly = [&](const Budget& b) { return exact_rung_bound_angle(normals_, Deviation::angle, b); };
    if (!bound.converged || bound.upper >= 180) bound = exactly(budget_);
    if (bound.converged) bound = until_decided(bound, tolerance, exactly);
    certificate_.orientation = bound.upper < 90 ? Orientation::smooth : orientation_of_normals();
    certificate_.angle = certificate_.plane_angle = located(bound);
    if (!(bound.upper <= 90))
      certificate_.plane_angle = located(exact_rung_bound_angle(normals_, Deviation::plane_angle, budget_));
  }

  // By the sign of n_A · n_B over the whole join: unknown when it is not certainly one sign and does not certainly change.
  Orientation orientation_of_normals() const {
    std::optional<Sign> sign;
    for (const auto& [a, b] : normals_) {
      const BinaryForm<R> side = dot(a.n, b.n);
      const auto factor = odd_part(over_field(a.factor * b.factor));
      const bool one_sign =
          !vanishes(side) && detail::certainly_zero_free(detail::enclose_vector(FormVector<R>{side, {}, {}}));
      if (!one_sign) {
        const auto ends = over_field(side);
        const bool changes = factor.degree() == 0 && !ends.is_empty() &&
                             *scalar_traits<T>::sign(T(ends(T(0)) * ends(T(1)))) == Sign::negative;
        return changes ? Orientation::mixed : Orientation::unknown;
      }
      if (!isolate_roots(factor, T(1)).empty()) return Orientation::mixed;
      const bool turned = *scalar_traits<T>::sign(factor[0]) == Sign::negative;
      const Sign here = *scalar_traits<R>::sign(turned ? R(-side[0]) : side[0]);
      if (sign && *sign != here) return Orientation::mixed;
      sign = here;
    }
    return *sign == Sign::negative ? Orientation::smooth : Orientation::cusp;
  }

  // Bounds that need more subdivisions than this are near the rounding of the intervals: the exact forms take over.
  static constexpr int kQuickNodes = 400;

  std::vector<JoinPiece<T>> pieces_;
  WitnessFinder<T> witnesses_;
  const Request& request_;
  const bool numerical_pairing_;
  Budget budget_;
  std::vector<JoinForms<Interval>> interval_;
  bool fits_ = false;
  std::vector<JoinForms<R>> exact_;
  std::vector<std::pair<ReducedNormal<R>, ReducedNormal<R>>> normals_;
  bool normals_found_ = true;
  std::pair<int, T> gap_witness_{0, T(0)};
  bool orientation_known_ = false;
  Certificate certificate_;
};

}  // namespace

template <ExactField T>
Certificate certify_join(const BsplinePatch<T, 4>& a, const BsplinePatch<T, 4>& b, const Join<T>& join,
                         const Request& request) {
  const RoundingGuard guard;
  const DeadlineScope scope(seconds_from_now(request.seconds_per_join));
  try {
    return JoinCertifier<T>(a, b, join, request).run();
  } catch (const deadline_passed&) {  // before there is anything to bound
    Certificate out = JoinCertifier<T>::nothing_known();
    JoinCertifier<T>::say_time_is_up(out);
    return out;
  }
}

template <ExactField T>
std::vector<Certificate> certify_joins(const std::vector<const BsplinePatch<T, 4>*>& patches,
                                       const std::vector<Join<T>>& joins, const Request& request, int jobs,
                                       const std::function<void(std::size_t)>& progress) {
  std::vector<Certificate> certificates(joins.size());
  std::atomic<std::size_t> done{0};
  for_each_item(jobs, joins.size(), [&](std::size_t i) {
    certificates[i] = certify_join(*patches[joins[i].patch_a], *patches[joins[i].patch_b], joins[i], request);
    const std::size_t now = ++done;
    if (progress) progress(now);
  });
  return certificates;
}

template Certificate certify_join(const BsplinePatch<Rational, 4>&, const BsplinePatch<Rational, 4>&,
                                  const Join<Rational>&, const Request&);
template Certificate certify_join(const BsplinePatch<Quadratic, 4>&, const BsplinePatch<Quadratic, 4>&,
                                  const Join<Quadratic>&, const Request&);
template std::vector<Certificate> certify_joins(const std::vector<const BsplinePatch<Rational, 4>*>&,
                                                const std::vector<Join<Rational>>&, const Request&, int,
                                                const std::function<void(std::size_t)>&);
template std::vector<Certificate> certify_joins(const std::vector<const BsplinePatch<Quadratic, 4>*>&,
                                                const std::vector<Join<Quadratic>>&, const Request&, int,
                                                const std::function<void(std::size_t)>&);

}  // namespace patchproof
