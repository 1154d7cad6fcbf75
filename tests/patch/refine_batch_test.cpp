// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/refine_batch.h"

#include "patchproof/patch/bezier_patch.h"
#include "patchproof/patch/patch_knots.h"
#include "support/strained_knots.h"

namespace patchproof {
namespace {

using namespace patchproof::test;
using Numbers = std::vector<double>;

struct Surface {
  int degree_u, degree_v;
  Numbers knots_u, knots_v, points, weights;

  SurfaceRefinement::Knots knots() const { return {degree_u, degree_v, knots_u, knots_v}; }
  KnotVector<double> along(Direction d) const {
    return d == Direction::u ? KnotVector<double>::make(degree_u, knots_u).value()
                             : KnotVector<double>::make(degree_v, knots_v).value();
  }
  int size() const { return weights.empty() ? 3 : 4; }
};

// The homogeneous control points, exactly.
std::vector<Vec<Rational, 4>> exact_net(const Surface& s) {
  std::vector<Vec<Rational, 4>> out(s.points.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Rational w = s.weights.empty() ? Rational(1) : from_double(s.weights[i]);
    for (std::size_t c = 0; c < 3; ++c) out[i][c] = w * from_double(s.points[3 * i + c]);
    out[i][3] = w;
  }
  return out;
}

// The formula of the header over any scalar, in the order of the output.
template <class T, std::size_t N>
std::vector<Vec<T, N>> refined(const RefinementBand<T>& u, int pieces_u, const RefinementBand<T>& v, int pieces_v,
                               const std::vector<Vec<T, N>>& net) {
  const auto along_v = detail::map_lines(net, u.old_count, v.old_count, Direction::v,
                                         [&](std::vector<Vec<T, N>> line) { return apply_band(v, line); });
  const auto all = detail::map_lines(along_v.points, u.old_count, v.rows(), Direction::u,
                                     [&](std::vector<Vec<T, N>> line) { return apply_band(u, line); });
  std::vector<Vec<T, N>> out;
  const int rows_u = u.rows() / pieces_u, rows_v = v.rows() / pieces_v;
  for (int a = 0; a < pieces_u; ++a)
    for (int b = 0; b < pieces_v; ++b)
      for (int i = 0; i < rows_u; ++i)
        for (int j = 0; j < rows_v; ++j)
          out.push_back(all.points[static_cast<std::size_t>(a * rows_u + i) * v.rows() + b * rows_v + j]);
  return out;
}

Numbers some_numbers(std::size_t count, int kind, WildNumbers& wild) {
  Numbers out;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = wild.moderate(4);
    out.push_back(kind == 0   ? x
                  : kind == 1 ? x + 1.0e6
                  : kind == 2 ? x * 1e150
                  : kind == 3 ? x * 1e-150
                  : kind == 4 ? x * 0x1p-1070
                              : (wild.below(2) != 0 ? x : x * 1e-300));
  }
  return out;
}

Surface make_surface(int p, int q, const Numbers& knots_u, const Numbers& knots_v, int kind, bool rational,
                     WildNumbers& wild) {
  Surface s{p, q, knots_u, knots_v, {}, {}};
  const std::size_t count = (knots_u.size() - p - 1) * (knots_v.size() - q - 1);
  s.points = some_numbers(3 * count, kind, wild);
  if (rational) s.weights = some_numbers(count, kind == 2 ? 0 : kind, wild);  // of both signs
  return s;
}

std::vector<Surface> strained_surfaces(WildNumbers& wild) {
  std::vector<Surface> out;
  for (const auto& [p, q] : {std::pair(3, 3), {1, 2}, {2, 5}, {0, 3}, {4, 4}, {6, 1}, {7, 3}}) {
    const auto us = strained_double_knots(p, wild), vs = strained_double_knots(q, wild);
    for (int i = 0; i < 12; ++i)
      out.push_back(make_surface(p, q, us[wild.below(static_cast<int>(us.size()))],
                                 vs[wild.below(static_cast<int>(vs.size()))], i / 2, i % 2 == 1, wild));
  }
  return out;
}

// An insertion and a Bézier extraction of the surface.
std::vector<SurfaceRefinement> refinements(const Surface& s, WildNumbers& wild) {
  return {SurfaceRefinement::make_insertion(s.knots(), strained_insertion(s.along(Direction::u), 5, wild),
                                            strained_insertion(s.along(Direction::v), 6, wild))
              .value(),
          SurfaceRefinement::make_bezier(s.knots()).value()};
}

Numbers applied(const SurfaceRefinement& r, const Surface& s, InstructionSet set) {
  Numbers out(r.point_count() * s.size() + 2, 123.25);
  const std::span<double> inside(out.data() + 1, out.size() - 2);
  EXPECT_TRUE(r.apply(s.points, s.weights, inside, set).has_value());
  EXPECT_TRUE(out.front() == 123.25 && out.back() == 123.25) << "wrote beside the output";
  return Numbers(inside.begin(), inside.end());
}

RefinementBand<Rational> exact_band(const SurfaceRefinement& r, const Surface& s, Direction d) {
  const KnotVector<Rational> old = exact_knots(s.along(d));
  if (r.pieces(d) > 1 || r.knots(d).size() < s.along(d).knots().size()) return bezier_band<Rational>(old);
  return refinement_band<Rational>(old, exact_knots(KnotVector<double>::make(old.degree(), r.knots(d)).value()));
}

TEST(RefineBatch, Law1And2_WithinTheBoundOnEveryInstructionSet) {
  WildNumbers wild(81);
  Rational worst(0);
  for (const Surface& s : strained_surfaces(wild))
    for (const SurfaceRefinement& r : refinements(s, wild)) {
      const auto u = exact_band(r, s, Direction::u), v = exact_band(r, s, Direction::v);
      const auto net = exact_net(s);
      std::vector<Vec<Rational, 4>> sizes = net;
      Rational largest(0), largest_weight(0);
      for (auto& point : sizes)
        for (std::size_t c = 0; c < 4; ++c) {
          point[c] = abs(point[c]);
          if (c < 3) largest = std::max(largest, point[c]);
          if (c == 3) largest_weight = std::max(largest_weight, point[c]);
        }
      const auto exact = refined(u, r.pieces(Direction::u), v, r.pieces(Direction::v), net);
      const auto sums = refined(u, r.pieces(Direction::u), v, r.pieces(Direction::v), sizes);
      ASSERT_EQ(exact.size(), r.point_count());

      const int n = 6 * (s.degree_u + s.degree_v) + 2, a = s.degree_u + 2, b = s.degree_v + 2;
      Numbers out(exact.size() * s.size());
      const RefinementBounds bounds = r.apply(s.points, s.weights, out).value();
      const auto underflow = [&](const Rational& size) {
        return Rational(Rational(a * a + b * b) * (1 + size) * power_of_two(-1074));
      };
      EXPECT_GE(from_double(bounds.coordinate), gamma(n + (s.weights.empty() ? 0 : 1)) * largest + underflow(largest));
      if (!s.weights.empty()) {
        EXPECT_GE(from_double(bounds.weight), gamma(n) * largest_weight + underflow(largest_weight));
      }
      for (const InstructionSet set : available_instruction_sets()) {
        SCOPED_TRACE(to_string(set));
        const Numbers computed = applied(r, s, set);
        for (std::size_t i = 0; i < exact.size(); ++i)
          for (int c = 0; c < s.size(); ++c) {
            const Rational error = abs(Rational(from_double(computed[i * s.size() + c]) - exact[i][c]));
            const Rational relative = gamma(n + (c < 3 && !s.weights.empty() ? 1 : 0)) * sums[i][c];
            const Rational bound = relative + underflow(c < 3 ? largest : largest_weight);
            ASSERT_LE(error, bound) << "number " << c << " of point " << i;
            if (relative > power_of_two(-900)) worst = std::max(worst, Rational(error / bound));
          }
      }
    }
  RecordProperty("worst_error_over_bound", std::to_string(nearest_double(worst)));
  EXPECT_GT(worst, Rational(1) / Rational(100)) << "the bound is far from what happens";
}

// a_0 x_0, then a_k x_k added in order, fused or not.
std::vector<Vec<double, 4>> line_times(const RefinementBand<double>& band, const std::vector<Vec<double, 4>>& line,
                                       bool fused) {
  std::vector<Vec<double, 4>> out(band.rows());
  for (int i = 0; i < band.rows(); ++i)
    for (std::size_t c = 0; c < 4; ++c) {
      double sum = band.row(i)[0] * line[band.first[i]][c];
      for (int k = 1; k <= band.degree; ++k) {
        const double a = band.row(i)[k], x = line[band.first[i] + k][c];
        sum = fused ? std::fma(a, x, sum) : sum + a * x;
      }
      out[i][c] = sum;
    }
  return out;
}

TEST(RefineBatch, Law3_TheSameBitsWhateverTheSetAndTheSize) {
  WildNumbers wild(82);
  std::vector<Surface> all = strained_surfaces(wild);
  // Nets larger than any tile in either direction, of all degrees with a kernel of their own and others.
  for (int p = 0; p <= 6; ++p)
    for (const bool rational : {false, true}) {
      Numbers knots;
      for (int i = 0; i < 330; ++i) knots.push_back(i / (1 + wild.below(3)) + 100 * (i / 100));
      std::sort(knots.begin(), knots.end());
      const Numbers few(knots.begin() + 90, knots.begin() + 110 + 2 * p);
      all.push_back(make_surface(3, p, few, knots, 0, rational, wild));
      all.push_back(make_surface(p, 2, knots, few, 0, rational, wild));
    }
  for (const Surface& s : all)
    for (const SurfaceRefinement& r : refinements(s, wild))
      for (const InstructionSet set : available_instruction_sets()) {
        SCOPED_TRACE(to_string(set));
        const Numbers computed = applied(r, s, set);
        std::vector<Vec<double, 4>> net(s.points.size() / 3);
        for (std::size_t i = 0; i < net.size(); ++i) {
          const double w = s.weights.empty() ? 1 : s.weights[i];
          net[i] = {{w * s.points[3 * i], w * s.points[3 * i + 1], w * s.points[3 * i + 2], w}};
        }
        const auto &u = r.band(Direction::u), &v = r.band(Direction::v);
        const auto along = [&](const RefinementBand<double>& band) {
          return [&, fused = fuses_multiply_add(set)](std::vector<Vec<double, 4>> line) {
            return line_times(band, line, fused);
          };
        };
        const auto along_v = detail::map_lines(net, u.old_count, v.old_count, Direction::v, along(v));
        const auto expected = detail::map_lines(along_v.points, u.old_count, v.rows(), Direction::u, along(u)).points;
        const int rows_u = r.count(Direction::u), rows_v = r.count(Direction::v), pieces_v = r.pieces(Direction::v);
        for (int i = 0; i < u.rows(); ++i)
          for (int j = 0; j < v.rows(); ++j) {
            const std::size_t piece = static_cast<std::size_t>(i / rows_u) * pieces_v + j / rows_v;
            const std::size_t at = (piece * rows_u + i % rows_u) * rows_v + j % rows_v;
            for (int c = 0; c < s.size(); ++c)
              ASSERT_EQ(computed[at * s.size() + c], expected[static_cast<std::size_t>(i) * v.rows() + j][c])
                  << i << " " << j << " " << c << " of degrees " << s.degree_u << ", " << s.degree_v;
          }
      }
}

TEST(RefineBatch, Law4_NeighbouringPiecesShareTheirEdge) {
  WildNumbers wild(83);
  int meetings = 0;
  for (const Surface& s : strained_surfaces(wild)) {
    const auto r = SurfaceRefinement::make_bezier(s.knots()).value();
    const Numbers out = applied(r, s, InstructionSet::fastest);
    const int p = s.degree_u, q = s.degree_v, nu = r.pieces(Direction::u), nv = r.pieces(Direction::v);
    const auto number = [&](int a, int b, int i, int j, int c) {
      return out[((static_cast<std::size_t>(a * nv + b) * (p + 1) + i) * (q + 1) + j) * s.size() + c];
    };
    for (int a = 0; a < nu; ++a)
      for (int b = 0; b < nv; ++b)
        for (int c = 0; c < s.size(); ++c) {
          if (a + 1 < nu && s.along(Direction::u).multiplicity(r.knots(Direction::u)[a + 1]) <= p) {
            for (int j = 0; j <= q; ++j, ++meetings) ASSERT_EQ(number(a, b, p, j, c), number(a + 1, b, 0, j, c));
          }
          if (b + 1 < nv && s.along(Direction::v).multiplicity(r.knots(Direction::v)[b + 1]) <= q) {
            for (int i = 0; i <= p; ++i, ++meetings) ASSERT_EQ(number(a, b, i, q, c), number(a, b + 1, i, 0, c));
          }
        }
  }
  EXPECT_GT(meetings, 1000);
}

TEST(RefineBatch, Law5_TheFormulaIsTheExactTemplates) {
  WildNumbers wild(84);
  for (const Surface& s : strained_surfaces(wild)) {
    const BsplinePatch<Rational, 4> patch(exact_knots(s.along(Direction::u)), exact_knots(s.along(Direction::v)),
                                          exact_net(s));
    const auto all = refinements(s, wild);
    const auto finer = [&](Direction d) {
      return exact_knots(
          KnotVector<double>::make(d == Direction::u ? s.degree_u : s.degree_v, all[0].knots(d)).value());
    };
    const auto inserted = refine(refine(patch, Direction::u, finer(Direction::u)), Direction::v, finer(Direction::v));
    const auto mine =
        refined(refinement_band<Rational>(patch.knots(Direction::u), finer(Direction::u)), 1,
                refinement_band<Rational>(patch.knots(Direction::v), finer(Direction::v)), 1, patch.net());
    ASSERT_EQ(mine.size(), inserted.net().size());
    for (std::size_t i = 0; i < mine.size(); ++i) ASSERT_EQ(mine[i].c, inserted.net()[i].c);

    const auto pieces = extract_bezier(patch);
    const auto own =
        refined(bezier_band<Rational>(patch.knots(Direction::u)), all[1].pieces(Direction::u),
                bezier_band<Rational>(patch.knots(Direction::v)), all[1].pieces(Direction::v), patch.net());
    std::size_t next = 0;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const int a = static_cast<int>(k) / all[1].pieces(Direction::v),
                b = static_cast<int>(k) % all[1].pieces(Direction::v);
      EXPECT_EQ(pieces[k].box.u_begin, from_double(all[1].knots(Direction::u)[a]));
      EXPECT_EQ(pieces[k].box.v_end, from_double(all[1].knots(Direction::v)[b + 1]));
      for (const auto& point : pieces[k].bezier.net()) ASSERT_EQ(own[next++].c, point.c);
    }
    EXPECT_EQ(next, own.size());
  }
}

TEST(RefineBatch, CurvesAreLinesOfANet) {
  WildNumbers wild(85);
  for (int p = 1; p <= 5; ++p)
    for (const Numbers& knots : strained_double_knots(p, wild)) {
      const auto old = KnotVector<double>::make(p, knots).value();
      const std::size_t n = old.control_count();
      const Numbers points = some_numbers(3 * n, 1, wild), weights = some_numbers(n, 0, wild);
      const Numbers added = strained_insertion(old, 5, wild);
      const auto bezier = CurveRefinement::make_bezier(p, knots).value();
      const auto insertion = CurveRefinement::make_insertion(p, knots, added).value();
      EXPECT_EQ(bezier.point_count(), (p + std::size_t(1)) * bezier.pieces());
      EXPECT_EQ(insertion.point_count(), n + added.size());
      const KnotVector<Rational> exact_old = exact_knots(old);
      const auto finer = exact_knots(KnotVector<double>::make(p, insertion.knots()).value());
      for (const auto& [r, band] : {std::pair(bezier, bezier_band<Rational>(exact_old)),
                                    std::pair(insertion, refinement_band<Rational>(exact_old, finer))}) {
        Numbers out(4 * r.point_count());
        const RefinementBounds bounds = r.apply(points, weights, out).value();
        std::vector<Vec<Rational, 4>> line(n);
        for (std::size_t i = 0; i < n; ++i) {
          line[i][3] = from_double(weights[i]);
          for (std::size_t c = 0; c < 3; ++c) line[i][c] = line[i][3] * from_double(points[3 * i + c]);
        }
        const auto exact = apply_band(band, line);
        ASSERT_EQ(exact.size(), r.point_count());
        for (std::size_t i = 0; i < exact.size(); ++i)
          for (std::size_t c = 0; c < 4; ++c)
            ASSERT_LE(abs(Rational(from_double(out[4 * i + c]) - exact[i][c])),
                      from_double(c < 3 ? bounds.coordinate : bounds.weight));
      }
    }
}

TEST(RefineBatch, DivisionByWeights) {
  const Numbers homogeneous{2, 4, 6, 2, 1, 2, 3, 3};
  Numbers points(6), weights(2);
  divide_by_weights(homogeneous, points, weights);
  EXPECT_EQ(points, (Numbers{1, 2, 3, 1.0 / 3, 2.0 / 3, 1}));
  EXPECT_EQ(weights, (Numbers{2, 3}));
}

TEST(RefineBatch, Errors) {
  const Numbers knots{0, 0, 1, 2, 2}, points(27, 1.0), nan{kInfinity - kInfinity}, far{2.5}, middle{1};
  const auto code = [](const auto& result) { return result.error().code; };
  const auto insertion = [&](const Numbers& u, const Numbers& added) {
    return SurfaceRefinement::make_insertion({1, 1, u, knots}, added, {});
  };
  EXPECT_EQ(code(insertion(knots, far)), ErrorCode::outside_domain);
  EXPECT_EQ(code(insertion(knots, nan)), ErrorCode::outside_domain);
  EXPECT_EQ(code(insertion({0, 0, 2, 1, 2}, {})), ErrorCode::decreasing_knots);
  EXPECT_EQ(code(insertion({0, 0, 0, 0}, {})), ErrorCode::empty_domain);
  EXPECT_EQ(code(insertion({0, 0, 1}, {})), ErrorCode::wrong_count);
  EXPECT_EQ(code(insertion({0, 0, kInfinity, kInfinity}, {})), ErrorCode::bad_number);
  EXPECT_EQ(code(insertion({-kLargest, -kLargest, kLargest, kLargest}, {})), ErrorCode::bad_number);
  EXPECT_EQ(code(SurfaceRefinement::make_bezier({1, -1, knots, knots})), ErrorCode::bad_degree);

  const auto r = insertion(knots, middle).value();
  for (const InstructionSet set : available_instruction_sets()) {
    Numbers out(4 * 3 * 4, 7.5);
    const auto all = std::span(out);
    EXPECT_EQ(code(r.apply(std::span(points).first(24), {}, all.first(36), set)), ErrorCode::wrong_count);
    EXPECT_EQ(code(r.apply(points, std::span(points).first(8), all, set)), ErrorCode::wrong_count);
    for (std::size_t i = 0; i < points.size(); ++i)
      for (const double bad : {kInfinity, -kInfinity, kInfinity - kInfinity, -kLargest}) {
        Numbers worse = points;
        worse[i] = bad;
        EXPECT_EQ(code(r.apply(worse, {}, all.first(36), set)), ErrorCode::bad_number);
        EXPECT_EQ(code(r.apply(points, std::span(worse).subspan(std::min<std::size_t>(i, 18), 9), all, set)),
                  ErrorCode::bad_number)
            << "weights";
      }
    EXPECT_EQ(out, Numbers(out.size(), 7.5)) << "nothing is written";
    EXPECT_THROW((void)r.apply(points, {}, all.first(35), set), contract_error);
  }
}

}  // namespace
}  // namespace patchproof
