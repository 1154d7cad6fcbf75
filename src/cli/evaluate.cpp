// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "patchproof/io/read.h"
#include "patchproof/patch/rational_patch.h"
#include "patchproof/patch/transfinite.h"

namespace patchproof::cli {
namespace {

struct Options {
  std::string model, at, scalar = "rational", json;
  std::optional<int> patch, curve, solid;
  int derivatives = 0;
  bool left = false;
  Decimals decimals = Decimals::exact;
  Side side() const { return left ? Side::left : Side::right; }
};

// All derivatives up to the order asked, as texts.
struct Evaluation {
  struct Row {
    std::string name;                         // "S_uv", "C''"
    std::vector<std::pair<char, int>> order;  // {{'u', 1}, {'v', 1}}, {{'t', 2}}
    std::vector<std::string> value;
  };
  const char* what;  // "patch", "curve" or "solid"
  int index;
  std::vector<Row> rows;
};

template <Ring T>
std::vector<std::string> texts(const Vec<T, 3>& x, int dimension) {
  std::vector<std::string> out;
  for (int c = 0; c < dimension; ++c) out.push_back(to_text(x[c]));
  return out;
}

template <Ring T>
std::vector<Evaluation::Row> rows(const PartialDerivatives<T, 3>& derivatives, int order) {
  std::vector<Evaluation::Row> out;
  for (int total = 0; total <= order; ++total)
    for (int l = 0; l <= total; ++l) {
      const int k = total - l;
      out.push_back({total == 0 ? "S" : "S_" + std::string(k, 'u') + std::string(l, 'v'),
                     {{'u', k}, {'v', l}},
                     texts(derivatives.at(k, l), 3)});
    }
  return out;
}

template <Ring T>
std::vector<Evaluation::Row> rows(const std::vector<Vec<T, 3>>& derivatives, int dimension) {
  std::vector<Evaluation::Row> out;
  for (int k = 0; k < static_cast<int>(derivatives.size()); ++k)
    out.push_back(
        {k <= 3 ? "C" + std::string(k, '\'') : fmt::format("C^({})", k), {{'t', k}}, texts(derivatives[k], dimension)});
  return out;
}

template <ExactField T>
Result<T> parameter(const char* name, const std::string& text, const KnotVector<T>& knots) {
  Result<T> x = parse_scalar<T>(text);
  if (!x) return Error{x.error().code, "--at", x.error().message, x.error().values};
  if (!knots.in_domain(*x))
    return Error{ErrorCode::outside_domain, "--at",
                 fmt::format("{} lies outside the domain [{}, {}]", name, to_text(knots.domain_begin()),
                             to_text(knots.domain_end())),
                 to_text(*x)};
  return x;
}

// The parameters of a patch, "U,V".
template <ExactField T>
Result<std::pair<T, T>> two_parameters(const Options& o, const KnotVector<T>& knots_u, const KnotVector<T>& knots_v) {
  const std::size_t comma = o.at.find(',');
  if (comma == std::string::npos) return Error{ErrorCode::usage, "--at", "two parameters U,V are needed", o.at};
  const Result<T> u = parameter("u", o.at.substr(0, comma), knots_u);
  if (!u) return u.error();
  const Result<T> v = parameter("v", o.at.substr(comma + 1), knots_v);
  if (!v) return v.error();
  return std::pair(*u, *v);
}

template <ExactField T>
Result<std::vector<Evaluation::Row>> evaluate_patch(const BsplinePatch<T, 4>& surface, const Options& o) {
  const KnotVector<T>&knots_u = surface.knots(Direction::u), &knots_v = surface.knots(Direction::v);
  const auto at = two_parameters(o, knots_u, knots_v);
  if (!at) return at.error();
  const auto& [u, v] = *at;
  const int k = o.derivatives;
  if (o.scalar == "rational") return rows(rational_derivatives(surface, u, v, k, k, o.side(), o.side()), k);
  const int span_u = knots_u.find_span(u, o.side()), span_v = knots_v.find_span(v, o.side());
  if (o.scalar == "interval") {
    const RoundingGuard guard;
    return rows(rational_derivatives(partial_derivatives_in_span<Interval>(surface, span_u, span_v, embed<Interval>(u),
                                                                           embed<Interval>(v), k, k)),
                k);
  }
  return rows(rational_derivatives(partial_derivatives_in_span<double>(surface, span_u, span_v, nearest_double(u),
                                                                       nearest_double(v), k, k)),
              k);
}

template <Ring R, ExactField T>
PartialDerivatives<R, 3> series_values(const GregoryPatch<T>& patch, const GregorySpans& spans, const R& u, const R& v,
                                       int order) {
  using Series = PowerSeries<R, 2>;
  const Vec<Series, 3> s =
      evaluate_in_spans<Series>(patch, spans, Series::variable(0, u, order), Series::variable(1, v, order));
  std::vector<Vec<R, 3>> values;
  for (int k = 0; k <= order; ++k)
    for (int l = 0; l <= order; ++l) {
      Vec<R, 3> x;
      if (k + l <= order)
        for (int c = 0; c < 3; ++c) x[c] = s[c].derivative({k, l});
      values.push_back(x);
    }
  return {order, order, std::move(values)};
}

// Exact derivatives as doubles, or as the intervals around them.
template <ExactField T>
std::vector<Evaluation::Row> rounded_rows(const PartialDerivatives<T, 3>& exact, const std::string& scalar, int order) {
  const auto as = [&]<class R>(const R&) {
    std::vector<Vec<R, 3>> values;
    for (int k = 0; k <= order; ++k)
      for (int l = 0; l <= order; ++l) {
        Vec<R, 3> x;
        for (int c = 0; c < 3; ++c) x[c] = embed<R>(exact.at(k, l)[c]);
        values.push_back(x);
      }
    return rows(PartialDerivatives<R, 3>(order, order, std::move(values)), order);
  };
  return scalar == "interval" ? as(Interval()) : as(double());
}

template <Ring R, ExactField T>
std::vector<Evaluation::Row> series_rows(const GregoryPatch<T>& patch, const GregorySpans& spans, const R& u,
                                         const R& v, int order) {
  return rows(series_values(patch, spans, u, v, order), order);
}

template <ExactField T>
Result<std::vector<Evaluation::Row>> evaluate_patch(const GregoryPatch<T>& patch, const Options& o) {
  const auto at = two_parameters(o, patch.v_surface().knots(Direction::u), patch.u_surface().knots(Direction::v));
  if (!at) return at.error();
  const auto& [u, v] = *at;
  const int k = o.derivatives;
  if ((u == T(0) || u == T(1)) && (v == T(0) || v == T(1))) {
    if (k > 1)
      return Error{ErrorCode::unsupported, "--derivatives",
                   "a Gregory patch has no second derivatives at its corners, "
                   "only limits along the edges",
                   o.at};
    const SurfaceFrame<T> s = frame(patch, u, v);
    std::vector<Evaluation::Row> out = rows(PartialDerivatives<T, 3>(1, 1, {s.point, s.dv, s.du, {}}), k);
    return out;
  }
  const GregorySpans spans = find_spans(patch, u, v, o.side(), o.side());
  // Next to a corner rounded numbers lose what cancels there (and β its
  // squares): exact values, rounded, stand for them.
  const T reach = T(1) / T(1 << 20);
  const auto is_near = [&](const T& x) { return x < reach || T(1) - reach < x; };
  if (o.scalar != "rational" && is_near(u) && is_near(v))
    return rounded_rows(series_values<T>(patch, spans, u, v, k), o.scalar, k);
  if (o.scalar == "rational") return series_rows<T>(patch, spans, u, v, k);
  if (o.scalar == "interval") {
    const RoundingGuard guard;
    return series_rows<Interval>(patch, spans, embed<Interval>(u), embed<Interval>(v), k);
  }
  const auto [x, y] = detail::off_the_corners(nearest_double(u), nearest_double(v));
  return series_rows<double>(patch, spans, x, y, k);
}

template <Ring R, ExactField T>
std::vector<Vec<R, 3>> derivatives_at(const BsplineCurve<T, 4>& curve, const T& at, const R& t, const Options& o) {
  const int span = curve.knots().find_span(at, o.side());
  std::vector<Vec<R, 4>> homogeneous;
  for (int k = 0; k <= o.derivatives; ++k) homogeneous.push_back(derivative_in_span<R>(curve, span, t, k));
  return rational_derivatives(homogeneous);
}

template <ExactField T>
Result<std::vector<Evaluation::Row>> evaluate_curve(const ModelCurve<T>& model, const Options& o) {
  const Result<T> t = parameter("t", o.at, model.curve.knots());
  if (!t) return t.error();
  if (o.scalar == "rational") return rows(derivatives_at(model.curve, *t, *t, o), model.dimension);
  if (o.scalar == "interval") {
    const RoundingGuard guard;
    return rows(derivatives_at(model.curve, *t, embed<Interval>(*t), o), model.dimension);
  }
  return rows(derivatives_at(model.curve, *t, nearest_double(*t), o), model.dimension);
}

// GERBS have exact values where their parts have.
std::optional<Error> without_exact_values(bool is_exact, const BFunction& b, const Options& o) {
  if (is_exact || o.scalar != "rational") return std::nullopt;
  return Error{ErrorCode::unsupported, "--scalar",
               "the values of this GERBS are transcendental: --scalar interval "
               "encloses them",
               b.to_string()};
}

template <ExactField T>
Result<std::vector<Evaluation::Row>> evaluate_curve(const ModelGerbsCurve<T>& model, const Options& o) {
  const Result<T> t = parameter("t", o.at, model.curve.knots());
  if (!t) return t.error();
  if (auto error = without_exact_values(model.curve.is_exact(), model.curve.b_function(), o)) return *error;
  const auto at = [&]<class R>(const R& x) {
    return rows(patchproof::derivatives_at<R>(model.curve, *t, o.side(), x, o.derivatives), model.dimension);
  };
  if (o.scalar == "rational") return at(*t);
  if (o.scalar == "double") return at(nearest_double(*t));
  const RoundingGuard guard;
  return at(embed<Interval>(*t));
}

template <ExactField T>
Result<std::vector<Evaluation::Row>> evaluate_patch(const GerbsSurface<T, 4>& surface, const Options& o) {
  const auto place = two_parameters(o, surface.knots(Direction::u), surface.knots(Direction::v));
  if (!place) return place.error();
  if (auto error = without_exact_values(surface.is_exact(), surface.b_function(), o)) return *error;
  const auto& [u, v] = *place;
  const auto at = [&]<class R>(const R& x, const R& y) {
    return rows(partial_derivatives_at<R>(surface, {u, v}, {o.side(), o.side()}, x, y, o.derivatives, o.derivatives),
                o.derivatives);
  };
  if (o.scalar == "rational") return at(u, v);
  if (o.scalar == "double") return at(nearest_double(u), nearest_double(v));
  const RoundingGuard guard;
  return at(embed<Interval>(u), embed<Interval>(v));
}

// All derivatives of total order up to the one asked, from the series of a
// solid.
template <Ring R>
std::vector<Evaluation::Row> rows(const Vec<PowerSeries<R, 3>, 3>& series, int order) {
  std::vector<Evaluation::Row> out;
  for (int total = 0; total <= order; ++total)
    for (int k = total; k >= 0; --k)
      for (int l = total - k; l >= 0; --l) {
        const int m = total - k - l;
        Vec<R, 3> x;
        for (int c = 0; c < 3; ++c) x[c] = series[c].derivative({k, l, m});
        out.push_back({total == 0 ? "V" : "V_" + std::string(k, 'u') + std::string(l, 'v') + std::string(m, 'w'),
                       {{'u', k}, {'v', l}, {'w', m}},
                       texts(x, 3)});
      }
  return out;
}

// The affine series at x of the piece of the solid that is its limit at the
// place.
template <Ring R, ExactField T>
Vec<PowerSeries<R, 3>, 3> series_at(const TransfiniteMap<T, 3, 4>& map, const ParameterPlace<T, 3>& place,
                                    const std::array<R, 3>& x, int order) {
  std::array<PowerSeries<R, 3>, 3> variables;
  for (std::size_t s = 0; s < 3; ++s) variables[s] = PowerSeries<R, 3>::variable(s, x[s], order);
  return project(evaluate_at<PowerSeries<R, 3>>(map, place, variables));
}

template <ExactField T>
Result<std::vector<Evaluation::Row>> evaluate_solid(const TransfiniteMap<T, 3, 4>& map, const Options& o) {
  std::array<T, 3> at;
  std::string_view rest = o.at;
  for (std::size_t s = 0; s < 3; ++s) {
    const std::size_t comma = rest.find(',');
    if ((comma == std::string_view::npos) != (s == 2))
      return Error{ErrorCode::usage, "--at", "three parameters U,V,W are needed", o.at};
    const Result<T> x = parameter(std::string(1, "uvw"[s]).c_str(), std::string(rest.substr(0, comma)),
                                  KnotVector<T>::bezier(1, map.domain_begin(s), map.domain_end(s)));
    if (!x) return x.error();
    at[s] = *x;
    if (s < 2) rest.remove_prefix(comma + 1);
  }
  const ParameterPlace<T, 3> place(at, o.side());
  const int k = o.derivatives;
  if (o.scalar == "rational") return rows(rational_taylor(map, place, k), k);
  if (o.scalar == "interval") {
    const RoundingGuard guard;
    return rows(
        series_at<Interval>(map, place, {embed<Interval>(at[0]), embed<Interval>(at[1]), embed<Interval>(at[2])}, k),
        k);
  }
  return rows(series_at<double>(map, place, {nearest_double(at[0]), nearest_double(at[1]), nearest_double(at[2])}, k),
              k);
}

// `count` curves or patches: is there one of this index?
std::optional<Error> check_index(const char* option, const char* plural, std::size_t count, int index) {
  if (index >= 0 && static_cast<std::size_t>(index) < count) return std::nullopt;
  const std::string has = count == 0 ? fmt::format("the model has no {}", plural)
                                     : fmt::format("the model has {} 0 to {}", plural, count - 1);
  return Error{ErrorCode::bad_reference, option, has, std::to_string(index)};
}

template <ExactField T>
Result<Evaluation> evaluate_model(const Model<T>& model, const Options& o) {
  if (o.solid) {
    if (const auto error = check_index("--solid", "solids", model.solids.size(), *o.solid)) return *error;
    Result<std::vector<Evaluation::Row>> rows = evaluate_solid(model.solids[*o.solid].map, o);
    if (!rows) return rows.error();
    return Evaluation{"solid", *o.solid, std::move(*rows)};
  }
  const std::size_t patches = model.patches.size(), gregory = patches + model.gerbs_patches.size(),
                    all = gregory + model.gregory_patches.size(), plain_curves = model.curves.size(),
                    curves = plain_curves + model.gerbs_curves.size();
  const bool curve = o.curve || (!o.patch && all == 0);
  if (curve && !o.curve && curves > 1)
    return Error{ErrorCode::usage, "evaluate",
                 fmt::format("the model has curves 0 to {}: --curve says which", curves - 1), ""};
  const int index = curve ? o.curve.value_or(0) : o.patch.value_or(0);
  if (const std::optional<Error> error =
          curve ? check_index("--curve", "curves", curves, index) : check_index("--patch", "patches", all, index))
    return *error;
  const std::size_t number = static_cast<std::size_t>(index);
  Result<std::vector<Evaluation::Row>> rows =
      curve              ? number < plain_curves ? evaluate_curve(model.curves[number], o)
                                                 : evaluate_curve(model.gerbs_curves[number - plain_curves], o)
                   : number < patches ? evaluate_patch(model.patches[number].surface, o)
      : number < gregory ? evaluate_patch(model.gerbs_patches[number - patches].surface, o)
                         : evaluate_patch(model.gregory_patches[number - gregory].patch, o);
  if (!rows) return rows.error();
  return Evaluation{curve ? "curve" : "patch", index, std::move(*rows)};
}

int run(const Options& o) {
  const Result<ModelFile> file = read_model(o.model, o.decimals);
  if (!file) return report_error(file.error());
  const auto evaluate = [&](const auto& model) -> Result<Evaluation> {
    try {
      return evaluate_model(model, o);
    } catch (const contract_error& e) {  // another root than the model's, or doubles that overflow
      return Error{ErrorCode::usage, "evaluate", e.what(), o.at};
    }
  };
  const Result<Evaluation> result = std::visit(evaluate, file->model);
  if (!result) return report_error(result.error());
  std::string text;
  if (!o.json.empty()) {
    nlohmann::ordered_json json{{"tool", "patchproof"},   {"version", PATCHPROOF_VERSION}, {"file", o.model},
                                {"sha256", file->sha256}, {result->what, result->index},   {"at", o.at},
                                {"scalar", o.scalar}};
    for (const Evaluation::Row& row : result->rows) {
      nlohmann::ordered_json entry;
      for (const auto& [parameter, order] : row.order) entry[std::string("d") + parameter] = order;
      entry["value"] = row.value;
      json["values"].push_back(std::move(entry));
    }
    text = json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  } else {
    for (const Evaluation::Row& row : result->rows)
      text += fmt::format("{:<8}{}\n", row.name, fmt::join(row.value, "  "));
  }
  return write_output(o.json.empty() ? "-" : o.json, text);
}

}  // namespace

void add_evaluate(CLI::App& app, int& exit_code) {
  const auto o = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("evaluate",
                                         "points and derivatives of one patch, "
                                         "curve or solid, exactly or enclosed");
  command->add_option("model", o->model, "file to read")->required()->type_name("MODEL");
  CLI::Option* patch = command->add_option("--patch", o->patch, "which patch, from 0 [0]")->option_text("I");
  CLI::Option* curve =
      command->add_option("--curve", o->curve, "which curve, from 0 [the only one of a model without patches]");
  curve->excludes(patch)->option_text("I");
  command->add_option("--solid", o->solid, "which solid, from 0")->excludes(patch)->excludes(curve)->option_text("I");
  command
      ->add_option("--at", o->at,
                   "parameters in the own domain of the patch, e.g. 1/3,0.25, "
                   "of the curve or of the solid")
      ->required()
      ->option_text("U,V|T|U,V,W");
  command->add_option("--derivatives", o->derivatives, "all derivatives up to this order [0]")
      ->check(CLI::Range(0, 20))
      ->option_text("K");
  command->add_option("--scalar", o->scalar, "number type [rational]")
      ->check(CLI::IsMember({"rational", "double", "interval"}))
      ->option_text("rational|double|interval");
  command->add_flag("--left", o->left, "at a knot, the limit from the left instead of the right");
  command->add_option("--json", o->json, "write JSON")->option_text("FILE|-");
  add_decimals(*command, o->decimals);
  command->callback([o, &exit_code] { exit_code = run(*o); });
}

}  // namespace patchproof::cli
