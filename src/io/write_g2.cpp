// SPDX-License-Identifier: Apache-2.0
// .g2: objects with a header "class 1 0 0", dimension and rational flag, counts with orders and knots, and coefficients, u
// fastest; those of rational objects are homogeneous.
#include <iterator>

#include "patchproof/io/write.h"
#include "patchproof/scalar/parse_scalar.h"
#include "write_doubles.h"

namespace patchproof {
namespace {

using Buffer = fmt::memory_buffer;

template <ExactField T>
class G2Writer {
 public:
  Result<WrittenModel> write(const Model<T>& model) {
    if (model.curves.empty() && model.patches.empty())
      return Error{ErrorCode::unsupported, "model", "a .g2 file holds at least one curve or patch", ""};
    for (std::size_t k = 0; k < model.curves.size(); ++k) {
      curve(model.curves[k]);
      if (const auto error = rounding_.error(fmt::format("curve {}", k))) return *error;
    }
    for (std::size_t k = 0; k < model.patches.size(); ++k) {
      patch(model.patches[k]);
      if (const auto error = rounding_.error(fmt::format("patch {}", k))) return *error;
    }
    WrittenModel out{fmt::to_string(out_), left_out(model, false, false)};
    if (long_ > 0)
      out.notes.push_back(
          fmt::format("{} of {} numbers are doubles whose decimals are longer than 17 digits: read with "
                      "--decimals binary64 they are the same",
                      long_, rounding_.numbers()));
    if (rounded_ > 0)
      out.notes.push_back(
          fmt::format("{} of {} numbers are rounded to the nearest double", rounded_, rounding_.numbers()));
    return out;
  }

 private:
  void number(const T& x) {
    const double d = rounding_(x);
    // The shortest decimal of this double, when it is the number itself; else 17 digits.
    std::string text = fmt::format("{}", d);
    if (!(T(parse_scalar<Rational>(text).value()) == x)) {
      text = fmt::format("{:.17g}", d);
      if (!(T(parse_scalar<Rational>(text).value()) == x)) ++(T(from_double(d)) == x ? long_ : rounded_);
    }
    fmt::format_to(std::back_inserter(out_), "{} ", text);
  }

  void end_line() { out_[out_.size() - 1] = '\n'; }

  void basis(const KnotVector<T>& knots) {
    rounding_.keep_apart(knots);
    fmt::format_to(std::back_inserter(out_), "{} {}\n", knots.control_count(), knots.degree() + 1);
    for (const T& t : knots.knots()) number(t);
    end_line();
  }

  void header(int type, int dimension, bool rational) {
    fmt::format_to(std::back_inserter(out_), "{} 1 0 0\n{} {}\n", type, dimension, rational ? 1 : 0);
  }

  void point(const Vec<T, 4>& p, int dimension, bool rational) {
    for (int c = 0; c < dimension; ++c) number(p[c]);
    if (rational) number(p[3]);
    end_line();
  }

  void curve(const ModelCurve<T>& c) {
    header(100, c.dimension, c.is_rational);
    basis(c.curve.knots());
    for (const Vec<T, 4>& p : c.curve.points()) point(p, c.dimension, c.is_rational);
    out_.push_back('\n');
  }

  void patch(const ModelPatch<T>& p) {
    header(200, 3, p.is_rational);
    basis(p.surface.knots(Direction::u));
    basis(p.surface.knots(Direction::v));
    for (int j = 0; j < p.surface.count(Direction::v); ++j)
      for (int i = 0; i < p.surface.count(Direction::u); ++i) point(p.surface.point(i, j), 3, p.is_rational);
    out_.push_back('\n');
  }

  Buffer out_;
  Rounding rounding_;
  std::size_t long_ = 0, rounded_ = 0;
};

}  // namespace

template <ExactField T>
Result<WrittenModel> write_model_g2(const Model<T>& model) {
  if (model.gregory_patches.empty()) return G2Writer<T>().write(model);
  Result<SplinesOnly<T>> splines = with_splines_only(model);
  if (!splines) return splines.error();
  Result<WrittenModel> out = G2Writer<T>().write(splines->model);
  if (out) out->notes.insert(out->notes.begin(), splines->notes.begin(), splines->notes.end());
  return out;
}

template Result<WrittenModel> write_model_g2(const Model<Rational>&);
template Result<WrittenModel> write_model_g2(const Model<Quadratic>&);

}  // namespace patchproof
