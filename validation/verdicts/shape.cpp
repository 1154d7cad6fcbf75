// SPDX-License-Identifier: Apache-2.0
#include "validation/verdicts/shape.h"

#include <algorithm>
#include <array>

#include "patchproof/io/read.h"
#include "patchproof/patch/rational_patch.h"
#include "validation/corpus/random.h"

namespace patchproof::verdicts {
namespace {

using Patch = BsplinePatch<Rational, 4>;

Rational rounded(const Rational& x) { return from_double(nearest_double(x)); }

KnotVector<Rational> rounded(const KnotVector<Rational>& knots) {
  std::vector<Rational> out;
  for (const Rational& t : knots.knots()) out.push_back(rounded(t));
  return KnotVector<Rational>::make_unchecked(knots.degree(), std::move(out));
}

Patch rounded(const Patch& patch) {
  std::vector<Vec<Rational, 4>> net;
  for (const auto& p : patch.net()) {
    const Rational w = rounded(p[3]);
    net.push_back({{w * rounded(p[0] / p[3]), w * rounded(p[1] / p[3]), w * rounded(p[2] / p[3]), w}});
  }
  return Patch(rounded(patch.knots(Direction::u)), rounded(patch.knots(Direction::v)), std::move(net));
}

bool is_one_piece(const Patch& patch, Direction d) {
  const KnotVector<Rational>& k = patch.knots(d);
  return std::none_of(k.knots().begin(), k.knots().end(),
                      [&](const Rational& t) { return k.domain_begin() < t && t < k.domain_end(); });
}

using Column = std::array<Vec<Rational, 4>, 4>;  // a cubic's control points, along u

// Both parts of a cubic cut at u, by de Casteljau's algorithm.
std::array<Column, 2> cut(Column points, const Rational& u) {
  std::array<Column, 2> parts;
  for (int k = 0; k < 4; ++k) {
    parts[0][k] = points[0];
    parts[1][3 - k] = points[3 - k];
    for (int i = 0; i + k < 3; ++i) points[i] = (Rational(1) - u) * points[i] + u * points[i + 1];
  }
  return parts;
}

Shape random_split(validation::Random& random, const Rational& scale, const Rational& offset) {
  std::array<Column, 4> columns;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const auto coordinate = [&](int thirds) {  // three decimals
        return scale * (Rational(thirds) / Rational(3) + Rational(random.integer(-120, 120)) / Rational(1000)) + offset;
      };
      columns[j][i] = {{coordinate(i), coordinate(j), coordinate(0), Rational(1)}};
    }
  const Rational u = Rational(random.integer(2, 8)) / Rational(10);
  std::array<std::vector<Vec<Rational, 4>>, 2> nets{std::vector<Vec<Rational, 4>>(16),
                                                    std::vector<Vec<Rational, 4>>(16)};
  for (int j = 0; j < 4; ++j) {
    const auto parts = cut(columns[j], u);
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < 4; ++i) nets[side][4 * i + j] = parts[side][i];
  }
  const auto along = KnotVector<Rational>::bezier(3);
  return {Patch(KnotVector<Rational>::bezier(3, Rational(0), u), along, std::move(nets[0])),
          Patch(KnotVector<Rational>::bezier(3, u, Rational(1)), along, std::move(nets[1]))};
}

}  // namespace

Result<Shape> read_shape(const std::string& path) {
  const Result<ModelFile> file = read_model(path);
  if (!file) return file.error();
  const auto* model = std::get_if<Model<Rational>>(&file->model);
  if (!model) return Error{ErrorCode::unsupported, path, "the numbers are not rational", ""};
  if (model->patches.size() != 2)
    return Error{ErrorCode::wrong_count, path, "a shape is two patches", std::to_string(model->patches.size())};
  Shape shape{model->patches[0].surface, model->patches[1].surface};
  const ParameterBox<Rational> a = shape.a.domain(), b = shape.b.domain();
  if (a.v_begin != b.v_begin || a.v_end != b.v_end)
    return Error{ErrorCode::unsupported, path, "both patches need the same range of v", ""};
  return shape;
}

Shape in_doubles(const Shape& shape) { return {rounded(shape.a), rounded(shape.b)}; }

Join<Rational> join_of(const Shape& shape) {
  Join<Rational> join;
  join.patch_b = 1;
  join.line_a = edge_line(shape.a, EdgeName::u_max);
  join.line_b = edge_line(shape.b, EdgeName::u_min);
  const ParameterBox<Rational> domain = shape.a.domain();
  join.pairing = {PairingKind::identity, {domain.v_begin, domain.v_end}, {domain.v_begin, domain.v_end}};
  return join;
}

std::vector<Shape> random_splits(std::uint64_t seed, int count, const Rational& scale, const Rational& offset) {
  validation::Random random(seed);
  std::vector<Shape> shapes;
  for (int i = 0; i < count; ++i) shapes.push_back(random_split(random, scale, offset));
  return shapes;
}

bool is_one_polynomial(const Shape& shape) {
  for (const Patch* patch : {&shape.a, &shape.b}) {
    for (const auto& p : patch->net())
      if (p[3] != Rational(1)) return false;
    for (const Direction d : {Direction::u, Direction::v})
      if (!is_one_piece(*patch, d)) return false;
  }
  const int p = std::max(shape.a.degree(Direction::u), shape.b.degree(Direction::u));
  const int q = std::max(shape.a.degree(Direction::v), shape.b.degree(Direction::v));
  for (int i = 0; i <= p; ++i)
    for (int j = 0; j <= q; ++j) {
      const Rational u = Rational(i) / Rational(p + 1), v = Rational(j) / Rational(q + 1);
      const auto value = [&](const Patch& s) {
        return evaluate_in_span<Rational>(s, s.degree(Direction::u), s.degree(Direction::v), u, v);
      };
      if (!(value(shape.a) == value(shape.b))) return false;
    }
  return true;
}

}  // namespace patchproof::verdicts
