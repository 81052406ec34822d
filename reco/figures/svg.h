// A drawing as SVG text: the few shapes that floe's pictures need. Units are pixels, y downwards.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace floe {

// Characters that SVG and HTML reserve are escaped.
std::string markup_escaped(const std::string& words);

struct Stroke {
  std::string colour = "#222222";
  double width = 1;
  std::string dashes;  // as in SVG's stroke-dasharray; empty: a whole line
};

enum class Anchor { start, middle, end };

class Svg {
 public:
  Svg(double width, double height);

  using Point = std::pair<double, double>;
  void line(Point from, Point to, const Stroke& stroke);
  void polyline(std::span<const Point> points, const Stroke& stroke);
  void area(std::span<const Point> points, const std::string& colour, double opacity);
  void rectangle(Point corner, double width, double height, const std::string& fill);
  void circle(Point centre, double radius, const std::string& fill);
  // `size` in pixels; `turned`: reads upwards. Characters that SVG reserves are escaped.
  void text(Point place, const std::string& words, double size, Anchor anchor = Anchor::start,
            const std::string& colour = "#222222", bool bold = false, bool turned = false);

  std::string str() const;  // the whole document

 private:
  double width_, height_;
  std::string body_;
};

// Round numbers in [low, high], about `count` of them, for an axis.
std::vector<double> round_ticks(double low, double high, int count);

}  // namespace floe
