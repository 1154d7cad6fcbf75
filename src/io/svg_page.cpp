// SPDX-License-Identifier: Apache-2.0
#include "io/svg_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <locale>
#include <sstream>

#include "io/mesh_parts.h"

namespace patchproof {
namespace {

// The characters of a text in UTF-8.
std::vector<std::string> characters(const std::string& utf8) {
  std::vector<std::string> out;
  for (const char c : utf8) {
    if ((c & 0xc0) != 0x80 || out.empty()) out.emplace_back();
    out.back() += c;
  }
  return out;
}

// How wide a character is when its size is 1, in the wider ones of the usual fonts.
double character_width(const std::string& c) {
  if (c.size() == 1) {
    if (std::string(" ijlI.,:;'|!()[]frt").find(c) != std::string::npos) return 0.38;
    if (std::string("mwMW@%").find(c) != std::string::npos) return 0.95;
    return std::isupper(static_cast<unsigned char>(c[0])) != 0 ? 0.7 : 0.63;
  }
  if (c >= "\u2080" && c <= "\u2089") return 0.42;  // subscripts
  return c.size() == 2 ? 0.75 : 1;
}

}  // namespace

std::string page_number(double x) {
  std::string text = fmt::format("{:.2f}", x);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string page_text(const PagePoint& p) { return page_number(p.x) + " " + page_number(p.y); }

std::string command(char letter, const std::vector<PagePoint>& points) {
  std::string out(1, letter);
  for (std::size_t i = 0; i < points.size(); ++i) out += (i == 0 ? "" : " ") + page_text(points[i]);
  return out;
}

pugi::xml_node add(pugi::xml_node parent, const char* element, const Attributes& attributes) {
  pugi::xml_node node = parent.append_child(element);
  for (const auto& [name, value] : attributes) node.append_attribute(name) = value.c_str();
  return node;
}

double text_width(const std::string& text, double size) {
  double width = 0;
  for (const std::string& c : characters(text)) width += size * character_width(c);
  return width;
}

pugi::xml_node add_text(pugi::xml_node parent, const PagePoint& p, const std::string& text, double size,
                        const std::string& colour, Anchor anchor) {
  Attributes attributes{
      {"x", page_number(p.x)}, {"y", page_number(p.y)}, {"font-size", page_number(size)}, {"fill", colour}};
  if (anchor != Anchor::begin) attributes.emplace_back("text-anchor", anchor == Anchor::middle ? "middle" : "end");
  pugi::xml_node node = add(parent, "text", attributes);
  node.append_child(pugi::node_pcdata).set_value(printable(text).c_str());
  return node;
}

std::string shortened(const std::string& text, double size, double width) {
  if (text_width(text, size) <= width) return text;
  const std::vector<std::string> all = characters(text);
  std::string begin, end;
  double left = width - text_width("…", size);
  for (std::size_t k = 0; k < all.size(); ++k) {  // one of the begin, one of the end, …
    const std::string& c = k % 2 == 0 ? all[k / 2] : all[all.size() - 1 - k / 2];
    if ((left -= size * character_width(c)) < 0) break;
    k % 2 == 0 ? begin += c : end = c + end;
  }
  return begin + "…" + end;
}

const std::string& line_colour(std::size_t index) {
  static const std::vector<std::string> colours{"#3d85c6", "#d9732b", "#3f9c5a", "#cc4b5c", "#8a6cc4",
                                                "#a17952", "#cf6ba9", "#7f8f2f", "#2a9fb0", "#b8860b"};
  return colours[index % colours.size()];
}

bool Labels::is_free(const Box& box) const {
  if (box[0] < left_ || box[1] < top_ || box[2] > right_ || box[3] > bottom_) return false;
  return std::none_of(taken_.begin(), taken_.end(),
                      [&](const Box& b) { return box[0] < b[2] && b[0] < box[2] && box[1] < b[3] && b[1] < box[3]; });
}

void Labels::reserve(const PagePoint& a, const PagePoint& b, double radius) {
  const int parts = 1 + static_cast<int>(std::min(std::hypot(b.x - a.x, b.y - a.y) / (2 * radius), 1000.0));
  for (int k = 0; k <= parts; ++k) reserve({a.x + (b.x - a.x) * k / parts, a.y + (b.y - a.y) * k / parts}, radius);
}

bool Labels::put_at(const PagePoint& p, const std::string& text, double size, const std::string& colour,
                    Anchor anchor) {
  const double width = text_width(text, size);
  const double left = p.x - (anchor == Anchor::begin ? 0 : anchor == Anchor::middle ? width / 2 : width);
  const Box box{left - 2, p.y - 0.8 * size, left + width + 2, p.y + 0.25 * size};
  if (!is_free(box)) return false;
  taken_.push_back(box);
  add_text(parent_, p, text, size, colour, anchor);
  return true;
}

bool Labels::put_near(const PagePoint& p, double distance, const std::string& text, double size,
                      const std::string& colour) {
  for (const double d : {distance, 1.7 * distance}) {
    const double s = 0.7 * d, middle = 0.35 * size;
    const std::vector<std::pair<PagePoint, Anchor>> places{{{p.x, p.y - d}, Anchor::middle},
                                                           {{p.x + d, p.y + middle}, Anchor::begin},
                                                           {{p.x, p.y + d + 0.8 * size}, Anchor::middle},
                                                           {{p.x - d, p.y + middle}, Anchor::end},
                                                           {{p.x + s, p.y - s}, Anchor::begin},
                                                           {{p.x - s, p.y - s}, Anchor::end},
                                                           {{p.x + s, p.y + s + 0.6 * size}, Anchor::begin},
                                                           {{p.x - s, p.y + s + 0.6 * size}, Anchor::end}};
    for (const auto& [place, anchor] : places)
      if (put_at(place, text, size, colour, anchor)) return true;
  }
  return false;
}

void Legend::add(const std::string& text, Sign sign) {
  const double width = 26 + text_width(text, 11.5) + 18;
  if (next_ > 24 && next_ + width > kPageWidth - 90) {  // the corner is for the axes of space
    next_ = 24;
    ++rows_;
  }
  entries_.push_back({text, std::move(sign), next_, rows_ - 1});
  next_ += width;
}

void Legend::add_line(const std::string& text, const std::string& colour, const char* width,
                      const std::string& dashes) {
  add(text, [=](pugi::xml_node group, double left, double middle) {
    pugi::xml_node path = patchproof::add(group, "path",
                                          {{"d", command('M', {{left, middle}}) + command('L', {{left + 20, middle}})},
                                           {"stroke", colour},
                                           {"stroke-width", width}});
    if (!dashes.empty()) {
      path.append_attribute("stroke-dasharray") = dashes.c_str();
      path.append_attribute("stroke-linecap") = "butt";
    }
  });
}

void Legend::draw(pugi::xml_node root, double top) const {
  pugi::xml_node group = patchproof::add(root, "g", {{"class", "legend"}});
  for (const Entry& e : entries_) {
    const double baseline = top + 18 * static_cast<double>(e.row) + 12;
    e.sign(group, e.left, baseline - 4);
    add_text(group, {e.left + 26, baseline}, e.text, 11.5, kInk);
  }
}

double Page::top(const std::string& title, const std::string& subtitle) {
  return 16 + (title.empty() ? 0 : 24) + (subtitle.empty() ? 0 : 20);
}

Page::Page(double height, const std::string& title, const std::string& subtitle) {
  root_ = add(document_, "svg",
              {{"xmlns", "http://www.w3.org/2000/svg"},
               {"width", page_number(kPageWidth)},
               {"height", page_number(height)},
               {"viewBox", fmt::format("0 0 {} {}", page_number(kPageWidth), page_number(height))},
               {"font-family", "Helvetica, Arial, sans-serif"},
               {"fill", "none"},
               {"stroke-linecap", "round"},
               {"stroke-linejoin", "round"}});
  if (!title.empty()) {
    add(root_, "title", {}).append_child(pugi::node_pcdata).set_value(printable(title).c_str());
    add_text(root_, {24, 32}, shortened(title, 17, kPageWidth - 48), 17, kInk).append_attribute("font-weight") = "bold";
  }
  if (!subtitle.empty())
    add_text(root_, {24, title.empty() ? 28.0 : 53.0}, shortened(subtitle, 13, kPageWidth - 48), 13, kInk);
}

void Page::set_height(double height) {
  root_.attribute("height") = page_number(height).c_str();
  root_.attribute("viewBox") = fmt::format("0 0 {} {}", page_number(kPageWidth), page_number(height)).c_str();
}

std::string Page::text() const {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  document_.save(out, " ", pugi::format_default | pugi::format_no_declaration, pugi::encoding_utf8);
  return out.str();
}

}  // namespace patchproof
