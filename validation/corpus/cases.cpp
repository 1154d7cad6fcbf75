// SPDX-License-Identifier: Apache-2.0
#include "validation/corpus/cases.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "patchproof/patch/denominator.h"
#include "validation/corpus/random.h"
#include "validation/corpus/truth.h"

namespace patchproof::validation {
namespace {

enum class Degrees { one_to_nine, one_to_five, each_in_turn, fifteen, two };
enum class Knots { bezier, uneven, nearly_equal, repeated, torn, unclamped, wide_and_far };
enum class Points { lattice, huge, tiny, far, alternating, mixed_sizes };
enum class Weights { perhaps, near_zero, vanishing, some_zero, mixed_signs, touching };

struct Recipe {
  Group group;
  int cases;
  Degrees degrees;
  Knots knots;
  Points points;
  Weights weights;
};

const std::vector<Recipe>& recipes() {
  using D = Degrees;
  using K = Knots;
  using P = Points;
  using W = Weights;
  static const std::vector<Recipe> all{
      {{"random", "degrees 1 to 9, knots with spans of 1 : 6"}, 8, D::one_to_nine, K::uneven, P::lattice, W::perhaps},
      {{"bezier", "one patch, each degree from 1 to 9"}, 18, D::each_in_turn, K::bezier, P::lattice, W::perhaps},
      {{"degree_15", "degree 15"}, 2, D::fifteen, K::bezier, P::lattice, W::perhaps},
      {{"nearly_equal_knots", "knots 1 ulp to 1e-9 apart"}, 8, D::one_to_five, K::nearly_equal, P::lattice, W::perhaps},
      {{"repeated_knots", "inner knots of multiplicity 2 to the degree"},
       6,
       D::one_to_nine,
       K::repeated,
       P::lattice,
       W::perhaps},
      {{"torn", "inner knots of multiplicity degree + 1: both sides"},
       6,
       D::one_to_five,
       K::torn,
       P::lattice,
       W::perhaps},
      {{"unclamped", "knots simple at the ends"}, 6, D::one_to_five, K::unclamped, P::lattice, W::perhaps},
      {{"domain", "domains 1e-100 and 1e100 wide, and 1e6 to 1e12 away from 0"},
       6,
       D::one_to_five,
       K::wide_and_far,
       P::lattice,
       W::perhaps},
      {{"huge", "coordinates of 1e150"}, 4, D::one_to_five, K::uneven, P::huge, W::perhaps},
      {{"tiny", "coordinates of 1e-150"}, 4, D::one_to_five, K::uneven, P::tiny, W::perhaps},
      {{"offset", "1e6 to 1e12 away from the origin"}, 8, D::one_to_five, K::uneven, P::far, W::perhaps},
      {{"alternating", "control values of alternating sign that cancel"},
       6,
       D::one_to_five,
       K::uneven,
       P::alternating,
       W::perhaps},
      {{"mixed_sizes", "control values from 1e-12 to 1e12 in one net"},
       6,
       D::one_to_five,
       K::uneven,
       P::mixed_sizes,
       W::perhaps},
      {{"near_zero_weights", "weights of 1 beside 1e-3 to 1e-300"},
       6,
       D::one_to_five,
       K::uneven,
       P::lattice,
       W::near_zero},
      {{"vanishing_weights", "weights of 1 beside 2^-53 to 2^-1074"},
       6,
       D::one_to_five,
       K::uneven,
       P::lattice,
       W::vanishing},
      {{"zero_weights", "weights of 0"}, 4, D::one_to_five, K::uneven, P::lattice, W::some_zero},
      {{"mixed_sign_weights", "negative weights, the denominator without zeros"},
       6,
       D::one_to_five,
       K::uneven,
       P::lattice,
       W::mixed_signs},
      {{"touching_denominator", "a denominator that comes as near to 0 as 1e-2 to 1e-8"},
       4,
       D::two,
       K::bezier,
       P::lattice,
       W::touching},
  };
  return all;
}

int degree(Degrees d, int k, Random& random) {
  switch (d) {
    case Degrees::one_to_nine: return random.integer(1, 9);
    case Degrees::one_to_five: return random.integer(1, 5);
    case Degrees::each_in_turn: return 1 + k / 2;
    case Degrees::fifteen: return 15;
    case Degrees::two: return 2;
  }
  return 3;
}

// The inner breaks, each with its multiplicity, and what lies outside: the knots of one direction.
std::vector<double> make_knots(Knots style, int p, int k, Random& random) {
  double begin = 0, width = 1;
  if (style == Knots::wide_and_far) {
    static const std::array<std::array<double, 2>, 6> domains{
        {{0, 1e-100}, {-3e100, 1e100}, {1e6, 1}, {-1e9, 2}, {1e12, 10}, {0.1, 1e3}}};
    begin = domains[k % domains.size()][0];
    width = domains[k % domains.size()][1];
  }
  const int spans = style == Knots::bezier ? 1 : random.integer(2, 5);
  std::vector<double> lengths(spans), knots(p + 1, begin);
  double sum = 0;
  for (double& l : lengths) sum += l = random.between(0.3, 1.8);
  double at = 0;
  for (int s = 0; s + 1 < spans; ++s) {
    at += lengths[s];
    double inner = begin + width * (at / sum);
    if (style == Knots::nearly_equal && s > 0) {
      static const std::array<double, 5> gaps{0, 1e-15, 1e-13, 1e-11, 1e-9};  // 0: the next double
      inner = std::nextafter(knots.back(), 2) + random.one_of(gaps);
    }
    const int times = style == Knots::repeated ? random.integer(std::min(2, p), p) : style == Knots::torn ? p + 1 : 1;
    knots.insert(knots.end(), times, inner);
  }
  knots.insert(knots.end(), p + 1, begin + width);
  if (style == Knots::unclamped)
    for (int i = p - 1; i >= 0; --i) {
      knots[i] = knots[i + 1] - random.between(0.1, 0.3);
      const std::size_t last = knots.size() - 1 - i;
      knots[last] = knots[last - 1] + random.between(0.1, 0.3);
    }
  return knots;
}

std::vector<double> make_points(Points style, int count_u, int count_v, int k, Random& random) {
  static const std::array<double, 4> distances{1e6, 1e8, 1e10, 1e12};
  std::vector<double> out;
  for (int i = 0; i < count_u; ++i)
    for (int j = 0; j < count_v; ++j) {
      std::array<double, 3> p{i + random.between(-0.3, 0.3), j + random.between(-0.3, 0.3), random.between(-2, 2)};
      for (int c = 0; c < 3; ++c) {
        double& x = p[c];
        if (style == Points::huge) x *= 1e150;
        if (style == Points::tiny) x *= 1e-150;
        if (style == Points::far) x += (c == 1 ? -1 : 1) * distances[k % distances.size()];
        if (style == Points::alternating) x = ((i + j) % 2 ? -1 : 1) * random.between(0.99, 1.01);
        if (style == Points::mixed_sizes) x *= std::ldexp(1.0, random.integer(-40, 40));
      }
      out.insert(out.end(), p.begin(), p.end());
    }
  return out;
}

std::vector<double> draw_weights(Weights style, int count_u, int count_v, int k, Random& random) {
  static const std::array<double, 4> small{1e-3, 1e-8, 1e-16, 1e-300}, distances{1e-2, 1e-4, 1e-6, 1e-8};
  static const std::array<int, 6> vanishing{-53, -60, -300, -900, -1022, -1073};
  std::vector<double> out;
  for (int i = 0; i < count_u; ++i)
    for (int j = 0; j < count_v; ++j) {
      double w = random.between(0.5, 2);
      const bool at_corner = (i == 0 || i == count_u - 1) && (j == 0 || j == count_v - 1);
      if (style == Weights::near_zero && random.coin()) w *= small[k % small.size()];
      if (style == Weights::some_zero && !at_corner && random.coin()) w = 0;
      if (style == Weights::mixed_signs && !at_corner && random.integer(0, 2) == 0) w *= -random.between(0.01, 0.7);
      // (1 − u)² − 2(1 − d)u(1 − u) + u² is d/2 at 1/2.
      if (style == Weights::vanishing && random.coin()) w = std::ldexp(w, vanishing[k % vanishing.size()]);
      if (style == Weights::touching) w = i == 1 ? distances[k % distances.size()] - 1 : 1;
      out.push_back(w);
    }
  return out;
}

// Drawn anew until the denominator is proven to have no zero. `fixed` weights can be proven at once.
std::vector<double> make_weights(Weights style, const std::vector<double>& knots_u, int p,
                                 const std::vector<double>& knots_v, int q, int k, Random& random) {
  const int count_u = static_cast<int>(knots_u.size()) - p - 1, count_v = static_cast<int>(knots_v.size()) - q - 1;
  if (style == Weights::perhaps && k % 2 == 0) return {};
  const std::vector<double> any(3 * static_cast<std::size_t>(count_u) * count_v);
  for (int attempt = 0;; ++attempt) {
    std::vector<double> weights = draw_weights(style, count_u, count_v, k, random);
    // Each attempt is milder than the one before, so that one of the first succeeds.
    for (double& w : weights) {
      if (style == Weights::mixed_signs && w < 0) w = std::ldexp(w, -attempt);
      if (style == Weights::some_zero && w == 0 && attempt > 0 && random.integer(0, attempt) > 0) w = 1;
    }
    if (std::all_of(weights.begin(), weights.end(), [](double w) { return w > 0; })) return weights;  // a mean of them
    const auto patch = exact_patch({p, q, knots_u, knots_v, any, weights});
    const DenominatorSign sign = certify_denominator(patch, {6, 24}).sign;
    if (sign == DenominatorSign::positive) return weights;
  }
}

// Both ends and the doubles next to them; up to three inner breaks and their neighbours.
std::vector<double> special_parameters(int p, const std::vector<double>& knots) {
  const double begin = knots[p], end = knots[knots.size() - 1 - p];
  std::vector<double> out{begin, end, std::nextafter(begin, end), std::nextafter(end, begin)};
  std::vector<double> inner;
  for (std::size_t i = p; i + p < knots.size(); ++i)
    if (begin < knots[i] && knots[i] < end && (inner.empty() || inner.back() != knots[i])) inner.push_back(knots[i]);
  for (std::size_t i = 0; i < inner.size() && i < 3; ++i)
    for (const double t : {inner[i], std::nextafter(inner[i], begin), std::nextafter(inner[i], end)})
      if (begin <= t && t <= end) out.push_back(t);
  return out;
}

double inside(int p, const std::vector<double>& knots, Random& random) {
  const double begin = knots[p], end = knots[knots.size() - 1 - p];
  return std::clamp(random.between(begin, end), begin, end);
}

std::vector<double> some_sorted(const std::vector<double>& special, int p, const std::vector<double>& knots,
                                Random& random) {
  std::vector<double> out{special[0], special[1], random.one_of(special)};
  for (int i = 0; i < 2; ++i) out.push_back(inside(p, knots, random));
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

Random random_of(const CorpusOptions& options, std::size_t group, int k, int salt) {
  Random mixed(options.seed * 1'000'003 + group * 1009 + static_cast<std::uint64_t>(k) * 17 + salt);
  return Random(mixed.bits());
}

}  // namespace

const std::vector<Group>& groups() {
  static const std::vector<Group> all = [] {
    std::vector<Group> out;
    for (const Recipe& r : recipes()) out.push_back(r.group);
    return out;
  }();
  return all;
}

std::vector<SurfaceCase> surface_cases(const CorpusOptions& options) {
  std::vector<SurfaceCase> out;
  for (std::size_t g = 0; g < recipes().size(); ++g)
    for (int k = 0; k < recipes()[g].cases; ++k) {
      const Recipe& r = recipes()[g];
      if (!options.group.empty() && options.group != r.group.name) continue;
      Random random = random_of(options, g, k, 0);
      SurfaceCase c;
      c.group = r.group.name;
      c.name = c.group + "/surface/" + std::to_string(k);
      c.degree_u = degree(r.degrees, k, random);
      c.degree_v = r.degrees == Degrees::fifteen && k == 1 ? 2 : degree(r.degrees, k, random);
      c.knots_u = make_knots(r.knots, c.degree_u, k, random);
      c.knots_v = make_knots(r.knots, c.degree_v, k, random);
      c.weights = make_weights(r.weights, c.knots_u, c.degree_u, c.knots_v, c.degree_v, k, random);
      c.points = make_points(r.points, static_cast<int>(c.knots_u.size()) - c.degree_u - 1,
                             static_cast<int>(c.knots_v.size()) - c.degree_v - 1, k, random);
      const auto special_u = special_parameters(c.degree_u, c.knots_u),
                 special_v = special_parameters(c.degree_v, c.knots_v);
      const auto add = [&](double u, double v) {
        c.u.push_back(u);
        c.v.push_back(v);
      };
      for (const double u : special_u) add(u, inside(c.degree_v, c.knots_v, random));
      for (const double v : special_v) add(random.one_of(special_u), v);
      for (int i = 0; i < options.count; ++i)
        add(inside(c.degree_u, c.knots_u, random), inside(c.degree_v, c.knots_v, random));
      c.grid_u = some_sorted(special_u, c.degree_u, c.knots_u, random);
      c.grid_v = some_sorted(special_v, c.degree_v, c.knots_v, random);
      c.side = r.knots == Knots::torn && k % 2 == 1 ? Side::left : Side::right;
      out.push_back(std::move(c));
    }
  return out;
}

std::vector<CurveCase> curve_cases(const CorpusOptions& options) {
  std::vector<CurveCase> out;
  const std::vector<double> once{0, 1};  // degree 0: a curve as a surface of one row, for its weights
  for (std::size_t g = 0; g < recipes().size(); ++g)
    for (int k = 0; k < recipes()[g].cases; ++k) {
      const Recipe& r = recipes()[g];
      if (!options.group.empty() && options.group != r.group.name) continue;
      Random random = random_of(options, g, k, 7);
      CurveCase c;
      c.group = r.group.name;
      c.name = c.group + "/curve/" + std::to_string(k);
      c.degree = degree(r.degrees, k, random);
      c.knots = make_knots(r.knots, c.degree, k, random);
      c.weights = make_weights(r.weights, c.knots, c.degree, once, 0, k, random);
      c.points = make_points(r.points, static_cast<int>(c.knots.size()) - c.degree - 1, 1, k, random);
      c.t = special_parameters(c.degree, c.knots);
      for (int i = 0; i < options.count; ++i) c.t.push_back(inside(c.degree, c.knots, random));
      c.side = r.knots == Knots::torn && k % 2 == 1 ? Side::left : Side::right;
      out.push_back(std::move(c));
    }
  return out;
}

}  // namespace patchproof::validation
