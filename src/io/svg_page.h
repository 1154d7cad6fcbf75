// SPDX-License-Identifier: Apache-2.0
// A page of SVG: paths, labels that keep out of each other's way, and one set of colours for light and dark ground.
#pragma once

#include <array>
#include <functional>
#include <pugixml.hpp>
#include <string>
#include <utility>
#include <vector>

namespace patchproof {

struct PagePoint {
  double x, y;
};

// "1.25", "-3", "0": at most two digits after the point.
std::string page_number(double x);
// "x y"
std::string page_text(const PagePoint& p);

// A path command and its points: command('C', {a, b, c}).
std::string command(char letter, const std::vector<PagePoint>& points);

using Attributes = std::vector<std::pair<const char*, std::string>>;

pugi::xml_node add(pugi::xml_node parent, const char* element, const Attributes& attributes);

enum class Anchor { begin, middle, end };

// Places texts so that none covers another, or a thing that was reserved.
class Labels {
 public:
  // The texts must stay within this part of the page.
  Labels(pugi::xml_node parent, double left, double top, double right, double bottom)
      : parent_(parent), left_(left), top_(top), right_(right), bottom_(bottom) {}

  void reserve(const PagePoint& p, double radius) {
    taken_.push_back({p.x - radius, p.y - radius, p.x + radius, p.y + radius});
  }
  // The straight line from a to b.
  void reserve(const PagePoint& a, const PagePoint& b, double radius);
  // The text at the first of the places round p (at this distance) that is free; false when there is none.
  bool put_near(const PagePoint& p, double distance, const std::string& text, double size, const std::string& colour);
  // At p exactly, its baseline there; false when that is not free.
  bool put_at(const PagePoint& p, const std::string& text, double size, const std::string& colour, Anchor anchor);

 private:
  using Box = std::array<double, 4>;
  bool is_free(const Box& box) const;

  pugi::xml_node parent_;
  double left_, top_, right_, bottom_;
  std::vector<Box> taken_;
};

// What the signs of a picture mean, in as many rows as it takes.
class Legend {
 public:
  // Draws a sign 20 wide whose middle is at the height given.
  using Sign = std::function<void(pugi::xml_node, double left, double middle)>;

  void add(const std::string& text, Sign sign);
  // A line of this colour.
  void add_line(const std::string& text, const std::string& colour, const char* width, const std::string& dashes = "");
  bool empty() const { return entries_.empty(); }
  double height() const { return 18 * static_cast<double>(rows_); }
  void draw(pugi::xml_node root, double top) const;

 private:
  struct Entry {
    std::string text;
    Sign sign;
    double left;
    std::size_t row;
  };
  std::vector<Entry> entries_;
  std::size_t rows_ = 1;
  double next_ = 24;
};

// How wide a text is, about and rather too much: no font can be asked.
double text_width(const std::string& text, double size);

// `text` in one line, or several lines not wider than `width`.
pugi::xml_node add_text(pugi::xml_node parent, const PagePoint& p, const std::string& text, double size,
                        const std::string& colour, Anchor anchor = Anchor::begin);

// Shortened to that width, with "…" in its middle: names often differ in their ends.
std::string shortened(const std::string& text, double size, double width);

inline constexpr double kPageWidth = 760;
// Greys and colours of middle brightness: at least 3 : 1 on white and on near-black.
inline const std::string kInk = "#727c88", kFaint = "#8b949e", kAccent = "#c2662d";
const std::string& line_colour(std::size_t index);

class Page {
 public:
  Page(double height, const std::string& title, const std::string& subtitle);
  pugi::xml_node root() { return root_; }
  void set_height(double height);
  std::string text() const;

  // Where drawing may begin below the title.
  static double top(const std::string& title, const std::string& subtitle);

 private:
  pugi::xml_document document_;
  pugi::xml_node root_;
};

}  // namespace patchproof
