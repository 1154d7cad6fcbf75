// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/samples.h"
#include "patchproof/io/write.h"
#include "patchproof/patch/fit_patch.h"
#include "patchproof/spline/fit_double.h"
#include "patchproof/spline/least_squares.h"
#include "patchproof/spline/sample_parameters.h"

namespace patchproof::cli {
namespace {

struct Options {
  std::string from, to;
  int degree = 3;
  std::optional<int> controls, grid, degree_v, controls_v;
  std::string knots, knot_rule = "auto", parameters = "uniform";
  bool weights = false, exact = false, in_doubles = false, quiet = false;
  Decimals decimals = Decimals::exact;
};

Error usage(std::string where, std::string message, std::string values) {
  return {ErrorCode::usage, std::move(where), std::move(message), std::move(values)};
}

template <ExactField T>
Result<KnotVector<T>> read_knots(const NumberText& text, const Options& o, int& root) {
  std::vector<T> knots;
  for (const auto& line : text.lines)
    for (const std::string_view word : line) {
      Result<T> x = read_number<T>(text, word, o.decimals, root);
      if (!x) return x.error();
      knots.push_back(std::move(*x));
    }
  Result<KnotVector<T>> out = KnotVector<T>::make(o.degree, std::move(knots));
  if (!out) return Error{out.error().code, "--knots", out.error().message, out.error().values};
  if (o.controls && *o.controls != out->control_count())
    return Error{ErrorCode::wrong_count, "--knots",
                 fmt::format("{} control points need {} knots", *o.controls, *o.controls + o.degree + 1),
                 std::to_string(out->knots().size())};
  return out;
}

// The knots; the parameters of the samples are set where they are not given.
template <ExactField T>
Result<KnotVector<T>> place(CurveSamples<T, 3>& data, std::optional<KnotVector<T>> given, const Options& o) {
  const int count = given ? given->control_count() : o.controls.value_or(static_cast<int>(data.points.size()));
  if (data.points.size() < static_cast<std::size_t>(count))
    return Error{ErrorCode::wrong_count, o.from, fmt::format("{} control points need as many samples or more", count),
                 std::to_string(data.points.size())};
  if (count <= o.degree)
    return Error{ErrorCode::wrong_count, given || o.controls ? "--controls" : o.from,
                 fmt::format("a curve of degree {} has {} control points or more", o.degree, o.degree + 1),
                 std::to_string(count)};
  T begin(0), end(o.parameters == "chord" ? 1 : count - o.degree);
  if (given) begin = given->domain_begin(), end = given->domain_end();
  if (o.parameters == "given") {
    begin = *std::min_element(data.parameters.begin(), data.parameters.end());
    end = *std::max_element(data.parameters.begin(), data.parameters.end());
    if (!(begin < end) && !given)
      return Error{ErrorCode::singular_fit, o.from, "all samples have one parameter", to_text(begin)};
  } else {
    auto made = o.parameters == "chord" ? chord_length_parameters(data.points, begin, end)
                                        : uniform_parameters(data.points.size(), begin, end);
    if (!made) return Error{made.error().code, o.from, made.error().message, made.error().values};
    data.parameters = std::move(*made);
  }
  if (given) return *given;
  // Interpolation on equal spans is ill-conditioned, the more the longer: the samples drift from the middles of their functions.
  const bool fewer = static_cast<std::size_t>(count) < data.points.size();
  const bool uniform = o.knot_rule == "uniform" || (o.knot_rule == "auto" && o.parameters == "uniform" && fewer);
  auto knots = uniform ? uniform_clamped_knots<T>(o.degree, count, begin, end)
                       : averaged_knots<T>(o.degree, count, data.parameters);
  if (!knots) return Error{knots.error().code, o.from, knots.error().message, knots.error().values};
  return knots;
}

// Upper bounds of the largest distance at a sample, and of the root of the weighted mean of the squares.
struct Distances {
  double largest = 0, mean = 0;
  std::size_t at = 0;
};

template <Ring R>
double root_above(const R& square) {
  const RoundingGuard guard;
  const Interval x = embed<Interval>(square);
  return sqrt(Interval(std::max(0.0, x.inf()), std::max(0.0, x.sup()))).sup();
}

// R: T, exact, or Interval.
template <Ring R, ExactField T>
Distances distances(const BsplineCurve<T, 3>& curve, const CurveSamples<T, 3>& data) {
  Distances out;
  R sum(0), weights(0);
  for (std::size_t a = 0; a < data.points.size(); ++a) {
    std::optional<RoundingGuard> guard;
    if constexpr (std::same_as<R, Interval>) guard.emplace();
    const int span = curve.knots().find_span(data.parameters[a]);
    const Vec<R, 3> c = evaluate_in_span<R>(curve, span, data.parameters[a]);
    R square(0);
    for (int k = 0; k < 3; ++k) {
      const R d = c[k] - embed<R>(data.points[a][k]);
      square += d * d;
    }
    const R w = data.weights.empty() ? R(1) : embed<R>(data.weights[a]);
    sum += w * square;
    weights += w;
    guard.reset();
    if (const double distance = root_above(square); distance > out.largest) out = {distance, 0, a};
  }
  std::optional<RoundingGuard> guard;
  if constexpr (std::same_as<R, Interval>) guard.emplace();
  const R mean = sum / weights;
  guard.reset();
  out.mean = root_above(mean);
  return out;
}

// A value at each parameter becomes the point (t, value).
template <ExactField T>
BsplineCurve<T, 3> graph(const BsplineCurve<T, 3>& values) {
  const int p = values.degree();
  std::vector<Vec<T, 3>> points = values.points();
  for (std::size_t j = 0; j < points.size(); ++j) {
    T sum(0);
    for (int i = 1; i <= p; ++i) sum += values.knots()[static_cast<int>(j) + i];
    points[j][0] = sum / T(p);
  }
  return BsplineCurve<T, 3>(values.knots(), std::move(points));
}

Error at_samples(const NumberText& text, const Error& error) {
  return {error.code, error.where.empty() ? text.file.path : text.file.path + ", " + error.where, error.message,
          error.values};
}

// Readers refuse numbers of more than kMaxDigits characters, and of 2^1000 or more.
template <ExactField T>
std::optional<Error> too_long(const std::vector<Vec<T, 3>>& points, const NumberText& text) {
  std::size_t longest = 0;
  T limit(1);
  for (int i = 0; i < 1000; ++i) limit = limit + limit;
  for (const Vec<T, 3>& p : points)
    for (const T& x : p.c) {
      if (!(x < limit && -limit < x))
        return Error{ErrorCode::bad_number, text.file.path, "a control point is not below 2^1000 in size", to_text(x)};
      longest = std::max(longest, to_text(x).size());
    }
  if (longest <= static_cast<std::size_t>(kMaxDigits)) return std::nullopt;
  return Error{
      ErrorCode::unsupported, text.file.path,
      fmt::format("the exact control points have numbers of more than {} digits; --double rounds those of a curve",
                  kMaxDigits),
      std::to_string(longest) + " digits"};
}

std::string distance_text(const Distances& d) {
  if (d.largest == 0) return "goes through all samples\n";
  // Six digits, not below.
  return fmt::format(
      "largest distance at a sample: at most {:.6g} (sample {}), root of the mean square: at most {:.6g}\n",
      d.largest * (1 + 0x1p-17), d.at, d.mean * (1 + 0x1p-17));
}

int finish(const std::string& model, const std::string& summary, const Options& o) {
  if (const int failed = write_output(o.to, model)) return failed;
  if (o.to != "-") return write_output("-", summary);
  std::fputs(summary.c_str(), stderr);  // the model is on standard output
  return 0;
}

// Rows of samples: a patch over equal steps in both directions.
template <ExactField T>
int fit_grid(const NumberText& text, const CurveSamples<T, 3>& data, const Options& o) {
  const std::size_t rows = static_cast<std::size_t>(*o.grid), columns = data.points.size() / rows;
  if (columns * rows != data.points.size() || columns < 2)
    return report_error({ErrorCode::wrong_count, text.file.path,
                         fmt::format("{} rows of samples, all of one length, of two or more", rows),
                         std::to_string(data.points.size()) + " samples"});
  GridSamples<T, 3> grid{{}, {}, data.points};
  std::optional<KnotVector<T>> knots[2];
  for (const bool v : {false, true}) {
    const std::size_t samples = v ? columns : rows;
    const int degree = v ? o.degree_v.value_or(o.degree) : o.degree;
    const int count = (v ? o.controls_v : o.controls).value_or(static_cast<int>(samples));
    const std::string where = text.file.path + (v ? ", along v" : ", along u");
    if (static_cast<std::size_t>(count) > samples || count <= degree)
      return report_error(
          {ErrorCode::wrong_count, where,
           fmt::format("{} samples and degree {} allow {} to {} control points", samples, degree, degree + 1, samples),
           std::to_string(count)});
    std::vector<T>& at = v ? grid.v : grid.u;
    at = uniform_parameters<T>(samples, T(0), T(count - degree)).value();
    const bool uniform =
        o.knot_rule == "uniform" || (o.knot_rule == "auto" && static_cast<std::size_t>(count) < samples);
    knots[v] = (uniform ? uniform_clamped_knots<T>(degree, count) : averaged_knots<T>(degree, count, at)).value();
  }
  const Result<BsplinePatch<T, 3>> patch = fit_patch(*knots[0], *knots[1], grid);
  if (!patch) return report_error(at_samples(text, patch.error()));
  if (const auto error = too_long(patch->net(), text)) return report_error(*error);
  T largest(0), sum(0);
  Distances d;
  for (std::size_t a = 0; a < rows; ++a)
    for (std::size_t b = 0; b < columns; ++b) {
      const Vec<T, 3> gap = evaluate(*patch, grid.u[a], grid.v[b]) - data.points[a * columns + b];
      const T square = dot(gap, gap);
      sum += square;
      if (largest < square) largest = square, d.at = a * columns + b;
    }
  d.largest = root_above(largest);
  d.mean = root_above(T(sum / T(static_cast<int>(data.points.size()))));
  Model<T> model;
  std::vector<Vec<T, 4>> net;
  for (const Vec<T, 3>& p : patch->net()) net.push_back({{p[0], p[1], p[2], T(1)}});
  model.patches.push_back({"fit", BsplinePatch<T, 4>(*knots[0], *knots[1], std::move(net)), false});
  std::string summary =
      fmt::format("{}: {} x {} samples, {} x {} control points, degrees {} and {}\n", o.from, rows, columns,
                  knots[0]->control_count(), knots[1]->control_count(), knots[0]->degree(), knots[1]->degree());
  if (!o.quiet) summary += "exact least-squares patch\n" + distance_text(d);
  return finish(write_model_json(model), summary, o);
}

template <ExactField T>
int fit(const NumberText& text, const std::optional<NumberText>& knot_text, const Options& o) {
  int root = 1;
  Result<Samples<T>> samples = read_samples<T>(text, {o.parameters == "given", o.weights}, o.decimals, root);
  if (!samples) return report_error(samples.error());
  if (o.grid && samples->dimension != 3)
    return report_error({ErrorCode::wrong_count, text.file.path, "the samples of a patch have three coordinates",
                         std::to_string(samples->dimension)});
  if (o.grid) return fit_grid(text, samples->data, o);
  if (samples->dimension == 1 && o.degree == 0)
    return report_error(usage("--degree", "the graph of values over their parameters has degree 1 or more", "0"));
  std::optional<KnotVector<T>> given;
  if (knot_text) {
    Result<KnotVector<T>> read = read_knots<T>(*knot_text, o, root);
    if (!read) return report_error(read.error());
    given = std::move(*read);
  }
  CurveSamples<T, 3>& data = samples->data;
  const Result<KnotVector<T>> knots = place<T>(data, std::move(given), o);
  if (!knots) return report_error(knots.error());

  std::optional<BsplineCurve<T, 3>> curve;
  std::string how;
  bool certified = true;
  if (o.in_doubles) {
    const auto found = fit_curve_double(*knots, data);
    if (!found) return report_error(at_samples(text, found.error()));
    std::vector<Vec<T, 3>> points;
    for (const Vec<double, 3>& p : found->curve.points())
      points.push_back({{T(from_double(p[0])), T(from_double(p[1])), T(from_double(p[2]))}});
    curve.emplace(*knots, std::move(points));
    certified = found->is_certified();
    how = certified
              ? fmt::format(
                    "in doubles; each coordinate of a control point is proven to be within {:.3g} of the "
                    "exact least-squares curve's\n",
                    found->largest_error() * (1 + 0x1p-7))  // not below in three digits
              : "in doubles; undecided how near the exact least-squares curve is (without --double it is found)\n";
  } else {
    Result<BsplineCurve<T, 3>> found = fit_curve(*knots, data);
    if (!found) return report_error(at_samples(text, found.error()));
    if (const auto error = too_long(found->points(), text)) return report_error(*error);
    curve.emplace(std::move(*found));
    how = "exact least-squares curve\n";
  }
  const Distances d = o.in_doubles ? distances<Interval>(*curve, data) : distances<T>(*curve, data);

  Model<T> model;
  const BsplineCurve<T, 3> drawn = samples->dimension == 1 ? graph(*curve) : *curve;
  std::vector<Vec<T, 4>> homogeneous;
  for (const Vec<T, 3>& p : drawn.points()) homogeneous.push_back({{p[0], p[1], p[2], T(1)}});
  model.curves.push_back(
      {"fit", BsplineCurve<T, 4>(*knots, std::move(homogeneous)), false, samples->dimension == 3 ? 3 : 2});
  std::string summary = fmt::format("{}: {} samples, {} control points, degree {}, {} pieces\n", o.from,
                                    data.points.size(), knots->control_count(), o.degree, knots->breaks().size() - 1);
  if (!o.quiet) summary += how + distance_text(d);
  if (const int failed = finish(write_model_json(model), summary, o)) return failed;
  return certified ? kProven : kUndecided;
}

int run(const Options& o) {
  if (const std::string extension = std::filesystem::path(o.to).extension().string();
      extension != ".json" && std::filesystem::path(o.to).has_extension())
    return report_error(usage("fit", "OUT ends in .json; convert makes other formats of it", o.to));
  if (!o.knots.empty() && o.knot_rule != "auto")
    return report_error(usage("--knot-rule", "the knots are given", o.knot_rule));
  if (o.grid && (!o.knots.empty() || o.parameters != "uniform" || o.weights || o.in_doubles))
    return report_error(usage("--grid", "goes with degrees, numbers of control points and --knot-rule only", ""));
  if (!o.grid && (o.controls_v || o.degree_v))
    return report_error(usage(o.controls_v ? "--controls-v" : "--degree-v", "goes with --grid", ""));
  std::error_code ignored;
  if (o.to != "-" && std::filesystem::equivalent(o.from, o.to, ignored))
    return report_error(usage("fit", "would overwrite its input", o.to));
  const Result<NumberText> text = load_numbers(o.from);
  if (!text) return report_error(text.error());
  std::optional<NumberText> knots;
  if (!o.knots.empty()) {
    if (std::filesystem::exists(o.knots, ignored)) {
      if (o.to != "-" && std::filesystem::equivalent(o.knots, o.to, ignored))
        return report_error(usage("fit", "would overwrite its knots", o.to));
      Result<NumberText> loaded = load_numbers(o.knots);
      if (!loaded) return report_error(loaded.error());
      knots = std::move(*loaded);
    } else {
      knots = split_numbers("--knots", o.knots);
    }
  }
  return mentions_root(*text) || (knots && mentions_root(*knots)) ? fit<Quadratic>(*text, knots, o)
                                                                  : fit<Rational>(*text, knots, o);
}

}  // namespace

void add_fit(CLI::App& app, int& exit_code) {
  const auto o = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("fit", "the B-spline curve or patch nearest to given samples, or through them");
  command->add_option("samples", o->from, "text: the coordinates of one sample on each line (docs/formats.md)")
      ->required()
      ->type_name("SAMPLES");
  command->add_option("out", o->to, "model to write; '-': on standard output, and the summary on standard error")
      ->required()
      ->type_name("OUT");
  command->add_option("--degree", o->degree, "degree [3]")->check(CLI::Range(0, 1000))->option_text("P");
  command->add_option("--controls", o->controls, "number of control points [one for each sample: interpolation]")
      ->check(CLI::Range(1, 1 << 28))
      ->option_text("N");
  command
      ->add_option("--grid", o->grid,
                   "fit a patch: so many rows of samples, one row after the other; u runs over the rows")
      ->check(CLI::Range(2, 1 << 28))
      ->option_text("ROWS");
  command->add_option("--degree-v", o->degree_v, "of a patch, along its rows [as --degree]")
      ->check(CLI::Range(0, 1000))
      ->option_text("Q");
  command->add_option("--controls-v", o->controls_v, "of a patch, along its rows [one for each sample]")
      ->check(CLI::Range(1, 1 << 28))
      ->option_text("M");
  command->add_option("--knots", o->knots, "the knots: a list '0,0,0,0,1,2,2,2,2', or a file of them")
      ->option_text("LIST|FILE");
  command
      ->add_option("--knot-rule", o->knot_rule,
                   "equal spans, or averages of the parameters (de Boor) [uniform for uniform parameters and fewer "
                   "control points "
                   "than samples, else averaged]")
      ->check(CLI::IsMember({"auto", "uniform", "averaged"}))
      ->option_text("uniform|averaged");
  command
      ->add_option(
          "--parameters", o->parameters,
          "of the samples: equal steps, by the length of their polygon, or the first number of each line [uniform]")
      ->check(CLI::IsMember({"uniform", "chord", "given"}))
      ->option_text("uniform|chord|given");
  command->add_flag("--weights", o->weights, "the last number of each line is the sample's weight");
  CLI::Option* exact = command->add_flag("--exact", o->exact, "solve exactly [so]");
  command
      ->add_flag("--double", o->in_doubles, "solve in doubles, with a proven bound of the distance to the exact curve")
      ->excludes(exact);
  add_decimals(*command, o->decimals);
  command->add_flag("--quiet", o->quiet, "print the counts only");
  command->callback([o, &exit_code] { exit_code = run(*o); });
}

}  // namespace patchproof::cli
