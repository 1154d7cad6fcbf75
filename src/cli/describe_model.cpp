// SPDX-License-Identifier: Apache-2.0
#include "cli/describe_model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "cli/patch_smoothness.h"
#include "patchproof/patch/denominator.h"
#include "patchproof/patch/transfinite_expand.h"
#include "patchproof/spline/gerbs_spline.h"
#include "patchproof/spline/spline_domain.h"

namespace patchproof::cli {
namespace {

constexpr std::size_t kMostRows = 12;       // of a table of knots; in a longer one…
constexpr std::size_t kMostAlike = 3;       // …more rows than these that say the same are one
constexpr std::size_t kLongestNumber = 14;  // characters; beyond, a rounded value stands for the exact one

template <class T>
std::string brief(const T& x) {
  const std::string exact = to_text(x);
  return exact.size() <= kLongestNumber ? exact : fmt::format("≈{:.7g}", nearest_double(x));
}

// A name in quotes, on one line whatever the file put into it.
std::string quoted(const std::string& name) {
  if (name.empty()) return "";
  std::string out = " \"";
  for (const char c : name) out += static_cast<unsigned char>(c) < ' ' || c == '\x7f' ? '?' : c;
  return out + "\"";
}

std::string class_name(int order) {
  return order == kOneFunction ? "smooth" : order < 0 ? "jump" : fmt::format("C{}", order);
}

std::string plural(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

// The items from both ends that fit into `length` characters.
std::string abbreviated(const std::vector<std::string>& items, const char* separator, std::size_t length = 80) {
  const auto joined = [&](std::size_t begin, std::size_t end) {
    return fmt::format("{}", fmt::join(items.begin() + begin, items.begin() + end, separator));
  };
  const std::string whole = joined(0, items.size());
  if (whole.size() <= length || items.size() < 4) return whole;
  std::size_t front = 1, back = 1;
  while (front + back < items.size() && joined(0, front + 1).size() <= length * 5 / 8) ++front;
  while (front + back < items.size() && joined(items.size() - back - 1, items.size()).size() <= length / 4) ++back;
  if (front + back == items.size()) return whole;
  return joined(0, front) + separator + "…" + separator + joined(items.size() - back, items.size());
}

// "0×3 1 2×2": each distinct knot with its multiplicity.
template <class T>
std::string knot_list(const KnotVector<T>& knots) {
  std::vector<std::string> items;
  for (int i = 0; i < static_cast<int>(knots.knots().size());) {
    const int multiplicity = knots.multiplicity(knots[i]);
    items.push_back(multiplicity == 1 ? brief(knots[i]) : fmt::format("{}×{}", brief(knots[i]), multiplicity));
    i += multiplicity;
  }
  const std::string list = abbreviated(items, " ");
  return list.find("…") == std::string::npos ? list : fmt::format("{} ({} distinct)", list, items.size());
}

// Degree, points, domain, knots, parts, dead points; `what` names a control
// point.
template <class T>
std::string knot_lines(const KnotVector<T>& knots, const char* what, const std::string& head,
                       const std::string& indent) {
  std::string text = fmt::format("{}degree {}, {}, ", head, knots.degree(), plural(knots.control_count(), what));
  const std::string domain = fmt::format("[{}, {}]", brief(knots.domain_begin()), brief(knots.domain_end()));
  if (knots.is_clamped() && knots.control_count() == knots.degree() + 1) return text + "Bézier on " + domain + "\n";
  text += fmt::format("domain {}, {}\n{}knots {}\n", domain, plural(knots.breaks().size() - 1, "span"), indent,
                      knot_list(knots));
  const auto parts = components(knots);
  std::vector<std::string> items;
  for (const auto& part : parts) items.push_back(fmt::format("[{}, {}]", brief(part.begin), brief(part.end)));
  if (parts.size() > 1) text += fmt::format("{}components {}\n", indent, abbreviated(items, " "));
  items.clear();
  for (const int i : dead_control_points(knots)) items.push_back(std::to_string(i));
  if (!items.empty())
    text += fmt::format("{}without influence: {}{} {}\n", indent, what, items.size() > 1 ? "s" : "",
                        abbreviated(items, ", "));
  return text;
}

struct BreakRow {
  std::string knot;
  int multiplicity, nominal, actual;
  std::string jump, remark;
};

// Rows that say the same of many knots are one line.
std::string table(const std::vector<BreakRow>& rows, const std::string& indent) {
  std::vector<const BreakRow*> shown;
  std::map<std::tuple<int, int, int, std::string>, std::vector<std::string>> alike;
  for (const BreakRow& row : rows) alike[{row.multiplicity, row.nominal, row.actual, row.remark}].push_back(row.knot);
  const auto alike_to = [&](const BreakRow& row) -> std::vector<std::string>& {
    return alike[{row.multiplicity, row.nominal, row.actual, row.remark}];
  };
  const auto is_alone = [&](const BreakRow& row) {
    return rows.size() <= kMostRows || alike_to(row).size() <= kMostAlike;
  };

  std::size_t width = std::string("at knot").size();
  bool any = false, has_jumps = false;
  for (const BreakRow& row : rows)
    if (is_alone(row)) {
      any = true;
      width = std::max(width, row.knot.size());
      has_jumps = has_jumps || !row.jump.empty();
    }
  std::string text;
  if (any)
    text = fmt::format("{}{:<{}}  times  promised  actual{}\n", indent, "at knot", width,
                       has_jumps ? "  first jump, right minus left" : "");
  for (const BreakRow& row : rows) {
    if (!is_alone(row)) continue;
    std::string line = fmt::format("{}{:<{}}  {:<5}  {:<8}  {:<6}  {}", indent, row.knot, width, row.multiplicity,
                                   class_name(row.nominal), class_name(row.actual), row.jump);
    if (!row.remark.empty()) line += (row.jump.empty() ? "" : "  ") + row.remark;
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  for (const BreakRow& row : rows) {
    std::vector<std::string>& knots = alike_to(row);
    if (is_alone(row) || knots.empty()) continue;
    text += fmt::format("{}{} knots of multiplicity {}, {} promised, {}{}: {}\n", indent, knots.size(),
                        row.multiplicity, class_name(row.nominal), class_name(row.actual),
                        row.remark.empty() ? "" : ", " + row.remark, abbreviated(knots, " ", 30));
    knots.clear();
  }
  return text;
}

template <ExactField T>
BreakRow row_of(const BreakSmoothness<T, 3, T>& b, int dimension) {
  BreakRow row{brief(b.t), b.multiplicity, b.nominal, b.actual.order, "", ""};
  if (!b.actual.is_one_function()) {
    std::vector<std::string> jump;
    for (int c = 0; c < dimension; ++c) jump.push_back(brief(b.actual.jump[c]));
    row.jump = fmt::format("order {}: ({})", b.actual.order + 1, fmt::join(jump, ", "));
  }
  if (b.actual.order < 0) return row;
  if (!b.actual.has_tangent)
    row.remark = b.actual.has_zero_speed ? "no speed, no tangent" : "corner";
  else if (b.actual.has_zero_speed)
    row.remark = "no speed";
  else if (b.actual.order == 0)
    row.remark = "G1";
  return row;
}

const char* denominator_text(DenominatorSign sign) {
  switch (sign) {
    case DenominatorSign::positive: return "w > 0 everywhere";
    case DenominatorSign::negative: return "w < 0 everywhere";
    case DenominatorSign::one_sign_per_piece: return "w without zero, of one sign on each piece";
    case DenominatorSign::vanishes: return "w vanishes";
    default: return "whether w vanishes is undecided";
  }
}

template <ExactField T>
std::string seam_text(const BsplineCurve<T, 4>& curve) {
  const Smoothness<T, 3> seam = closing_smoothness_rational(curve);
  if (seam.order < 0) return "open";
  return fmt::format("closed, {} at the seam{}", class_name(seam.order),
                     seam.has_tangent ? ""
                     : seam.order > 0 ? ", no tangent there"
                                      : " with a corner");
}

// Readers have certified that w has no zero: on each component it has the sign
// that it has at the begin.
template <ExactField T>
std::string sign_text(const BsplineCurve<T, 4>& curve) {
  bool positive = true, negative = true;
  for (const DomainComponent<T>& part : components(curve.knots())) {
    const bool above = T(0) < evaluate(curve, part.begin)[3];
    positive = positive && above;
    negative = negative && !above;
  }
  return positive   ? "w > 0 everywhere"
         : negative ? "w < 0 everywhere"
                    : "w without zero, of one sign on each component";
}

template <ExactField T>
std::string describe_curve(std::size_t index, const ModelCurve<T>& c) {
  std::string text =
      fmt::format("curve {}{}: {}, {}, {}\n", index, quoted(c.name), c.dimension == 2 ? "plane" : "space",
                  c.is_rational ? "rational, " + sign_text(c.curve) : "polynomial", seam_text(c.curve));
  text += knot_lines(c.curve.knots(), "control point", "  ", "  ");
  std::vector<BreakRow> rows;
  for (const auto& b : smoothness_rational(c.curve)) rows.push_back(row_of(b, c.dimension));
  return text + table(rows, "  ");
}

template <ExactField T>
std::string describe_patch(std::size_t index, const ModelPatch<T>& p) {
  const DenominatorSign sign = p.is_rational ? certify_denominator(p.surface).sign : DenominatorSign::positive;
  std::string text = fmt::format("patch {}{}: {}\n", index, quoted(p.name),
                                 p.is_rational ? std::string("rational, ") + denominator_text(sign) : "polynomial");
  for (const Direction d : {Direction::u, Direction::v}) {
    text += knot_lines(p.surface.knots(d), d == Direction::u ? "row" : "column",
                       d == Direction::u ? "  u: " : "  v: ", "     ");
    if (sign == DenominatorSign::vanishes || sign == DenominatorSign::undecided) continue;
    const int seam = closing_order(p.surface, p.is_rational, d);
    if (seam >= 0) text += fmt::format("     closed, {} at the seam\n", class_name(seam));
    std::vector<BreakRow> rows;
    for (const auto& b : patch_smoothness(p.surface, p.is_rational, d))
      rows.push_back({brief(b.value), b.multiplicity, b.nominal, b.actual, "", ""});
    text += table(rows, "     ");
  }
  return text;
}

template <ExactField T>
std::string describe_gregory(std::size_t index, const ModelGregoryPatch<T>& p) {
  const auto weights_are_one = [](const BsplinePatch<T, 4>& surface) {
    return std::all_of(surface.net().begin(), surface.net().end(), [](const auto& h) { return h[3] == T(1); });
  };
  const bool polynomial = weights_are_one(p.patch.u_surface()) && weights_are_one(p.patch.v_surface());
  return fmt::format(
             "patch {}{}: NURBS boundary Gregory patch, {} edges, w > "
             "0 everywhere\n",
             index, quoted(p.name), polynomial ? "polynomial" : "rational") +
         knot_lines(p.patch.v_surface().knots(Direction::u), "row", "  u: ", "     ") +
         knot_lines(p.patch.u_surface().knots(Direction::v), "column", "  v: ", "     ");
}

std::string order_text(const BFunction& b) {
  const auto one = [](const std::optional<int>& order) {
    return order ? fmt::format("{}", *order) : std::string("all");
  };
  const std::string begin = one(b.order_at_begin()), end = one(b.order_at_end());
  return fmt::format("B-function {}, of order {}{}", b.to_string(), begin, begin == end ? "" : " and " + end);
}

template <ExactField T>
std::string gerbs_knot_line(const KnotVector<T>& knots, bool closed) {
  std::vector<std::string> centres;
  for (int i = 0; i < knots.control_count(); ++i) centres.push_back(brief(knots[i + 1]));
  return fmt::format("{} local, centres {}{}\n", knots.control_count() - (closed ? 1 : 0), fmt::join(centres, " "),
                     closed ? ", closed" : "");
}

template <ExactField T>
std::string describe_gerbs(std::size_t index, const ModelGerbsCurve<T>& c) {
  std::string text =
      fmt::format("curve {}{}: GERBS, {}, {}\n  t: {}", index, quoted(c.name), c.dimension == 2 ? "plane" : "space",
                  order_text(c.curve.b_function()), gerbs_knot_line(c.curve.knots(), c.curve.is_closed()));
  const RoundingGuard guard;
  for (const auto& b : smoothness(c.curve)) {
    text += fmt::format("  t = {}: {}{}", brief(b.t), b.exact ? "" : "at least ",
                        b.order == kOneFunction ? "C∞" : fmt::format("C{}", b.order));
    if (b.exact && b.jump) {  // points are exact
      std::vector<std::string> jump;
      for (int k = 0; k < c.dimension; ++k) {
        const Interval& x = (*b.jump)[k];
        jump.push_back(x.is_point() ? fmt::format("{}", x.inf()) : fmt::format("[{}, {}]", x.inf(), x.sup()));
      }
      text += fmt::format(", derivative {} jumps by ({})", b.order + 1, fmt::join(jump, ", "));
    }
    text += "\n";
  }
  return text;
}

template <ExactField T>
std::string describe_gerbs(std::size_t index, const ModelGerbsPatch<T>& p) {
  const auto &u = p.surface.axis(Direction::u), &v = p.surface.axis(Direction::v);
  return fmt::format("patch {}{}: GERBS, {}{}\n  u: {}  v: {}", index, quoted(p.name),
                     order_text(p.surface.b_function()), p.surface.is_exact() ? "" : ", transcendental",
                     gerbs_knot_line(u.knots, u.closed), gerbs_knot_line(v.knots, v.closed));
}

// A solid of a file: its control patches are described as patches of the model.
template <ExactField T>
std::string describe_solid(std::size_t index, const ModelSolid<T>& s, const Model<T>& model) {
  bool rational = false;
  std::vector<std::string> controls;
  for (const auto& control : s.controls) {
    rational = rational || (control.patch >= 0 && model.patches[control.patch].is_rational);
    controls.push_back(control.patch >= 0 ? fmt::format("patch {}", control.patch) : std::string("a point"));
  }
  std::string text = fmt::format("solid {}{}: {}, controls {}\n", index, quoted(s.name),
                                 rational ? "rational, w > 0 everywhere" : "polynomial", fmt::join(controls, ", "));
  for (std::size_t d = 0; d < 2; ++d)
    text += knot_lines(spline_knots(s.map, d), "layer", fmt::format("  {}: ", "uv"[d]), "     ");
  return text + (s.knots ? knot_lines(*s.knots, "control", "  w: ", "     ") : std::string());
}

template <ExactField T>
std::string describe_all(const Model<T>& model) {
  std::string text;
  for (std::size_t i = 0; i < model.curves.size(); ++i) text += describe_curve(i, model.curves[i]);
  for (std::size_t i = 0; i < model.patches.size(); ++i) text += describe_patch(i, model.patches[i]);
  for (std::size_t i = 0; i < model.gerbs_curves.size(); ++i)
    text += describe_gerbs(model.curves.size() + i, model.gerbs_curves[i]);
  for (std::size_t i = 0; i < model.gerbs_patches.size(); ++i)
    text += describe_gerbs(model.patches.size() + i, model.gerbs_patches[i]);
  for (std::size_t i = 0; i < model.gregory_patches.size(); ++i)
    text += describe_gregory(model.patches.size() + model.gerbs_patches.size() + i, model.gregory_patches[i]);
  for (std::size_t i = 0; i < model.solids.size(); ++i) text += describe_solid(i, model.solids[i], model);
  if (!model.joins.empty()) text += plural(model.joins.size(), "join") + " declared in the file\n";
  return text;
}

}  // namespace

std::string describe(const Model<Rational>& model) { return describe_all(model); }
std::string describe(const Model<Quadratic>& model) { return describe_all(model); }

}  // namespace patchproof::cli
