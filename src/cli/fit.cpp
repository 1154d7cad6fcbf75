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
#include "patchproof/spline/fit_double.h"
#include "patchproof/spline/least_squares.h"
#include "patchproof/spline/sample_parameters.h"

namespace patchproof::cli {
namespace {

struct Options {
  std::string from, to;
  int degree = 3;
  std::optional<int> controls;
  std::string knots, knot_rule = "auto", parameters = "uniform";
  bool weights = false, exact = false, in_doubles = false, quiet = false;
  Decimals decimals = Decimals::exact;
};

Error usage(std::string where, std::string message, std::string values) {
  return {ErrorCode::usage, std::move(where), std::move(message), std::move(values)};
}

// Points in three coordinates, those not given 0. A single number is a value: it stands in y, for a graph over the parameter.
template <ExactField T>
struct Samples {
  int dimension = 0;
  CurveSamples<T, 3> data;
};

template <ExactField T>
Result<Samples<T>> read_samples(const NumberText& text, const Options& o, int& root) {
  const std::size_t before = o.parameters == "given" ? 1 : 0, behind = o.weights ? 1 : 0;
  if (text.lines.empty()) return Error{ErrorCode::empty_input, text.file.path, "holds no samples", ""};
  const std::size_t words = text.lines.front().size();
  Samples<T> out;
  out.dimension = static_cast<int>(words) - static_cast<int>(before + behind);
  if (out.dimension < 1 || out.dimension > 3)
    return text.file.error(ErrorCode::wrong_count, text.lines.front().front(),
                           fmt::format("a sample has one, two or three coordinates{}{}",
                                       before ? " behind its parameter" : "", behind ? " before its weight" : ""),
                           std::to_string(words) + " numbers");
  for (const auto& line : text.lines) {
    if (line.size() != words)
      return text.file.error(ErrorCode::wrong_count, line.front(),
                             fmt::format("{} numbers as on the lines before", words), std::to_string(line.size()));
    std::vector<T> numbers;
    for (const std::string_view word : line) {
      Result<T> x = read_number<T>(text, word, o.decimals, root);
      if (!x) return x.error();
      numbers.push_back(std::move(*x));
    }
    if (before) out.data.parameters.push_back(numbers.front());
    if (behind) out.data.weights.push_back(numbers.back());
    Vec<T, 3> point;
    for (int c = 0; c < out.dimension; ++c) point[out.dimension == 1 ? 1 : c] = numbers[before + c];
    out.data.points.push_back(std::move(point));
  }
  return out;
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

template <ExactField T>
int fit(const NumberText& text, const std::optional<NumberText>& knot_text, const Options& o) {
  int root = 1;
  Result<Samples<T>> samples = read_samples<T>(text, o, root);
  if (!samples) return report_error(samples.error());
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
    curve.emplace(std::move(*found));
    std::size_t longest = 0;
    for (const Vec<T, 3>& p : curve->points())
      for (const T& x : p.c) longest = std::max(longest, to_text(x).size());
    if (longest > static_cast<std::size_t>(kMaxDigits))
      return report_error(
          {ErrorCode::unsupported, text.file.path,
           fmt::format("the exact control points have numbers of more than {} digits; --double rounds them",
                       kMaxDigits),
           std::to_string(longest) + " digits"});
    how = "exact least-squares curve\n";
  }
  const Distances d = o.in_doubles ? distances<Interval>(*curve, data) : distances<T>(*curve, data);

  Model<T> model;
  const BsplineCurve<T, 3> drawn = samples->dimension == 1 ? graph(*curve) : *curve;
  std::vector<Vec<T, 4>> homogeneous;
  for (const Vec<T, 3>& p : drawn.points()) homogeneous.push_back({{p[0], p[1], p[2], T(1)}});
  model.curves.push_back(
      {"fit", BsplineCurve<T, 4>(*knots, std::move(homogeneous)), false, samples->dimension == 3 ? 3 : 2});
  if (const int failed = write_output(o.to, write_model_json(model))) return failed;
  std::string summary = fmt::format("{}: {} samples, {} control points, degree {}, {} pieces\n", o.from,
                                    data.points.size(), knots->control_count(), o.degree, knots->breaks().size() - 1);
  if (!o.quiet) {
    summary += how;
    summary += d.largest == 0 ? "goes through all samples\n"
                              : fmt::format(
                                    "largest distance at a sample: at most {:.6g} (sample {}), root of the mean "
                                    "square: at most {:.6g}\n",
                                    d.largest * (1 + 0x1p-17), d.at, d.mean * (1 + 0x1p-17));
  }
  if (o.to == "-")  // where the model is
    std::fputs(summary.c_str(), stderr);
  else if (const int failed = write_output("-", summary))
    return failed;
  return certified ? kProven : kUndecided;
}

int run(const Options& o) {
  if (const std::string extension = std::filesystem::path(o.to).extension().string();
      extension != ".json" && std::filesystem::path(o.to).has_extension())
    return report_error(usage("fit", "OUT ends in .json; convert makes other formats of it", o.to));
  if (!o.knots.empty() && o.knot_rule != "auto")
    return report_error(usage("--knot-rule", "the knots are given", o.knot_rule));
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
  CLI::App* command = app.add_subcommand("fit", "the B-spline curve nearest to given samples, or through them");
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
