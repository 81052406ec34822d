#include "reco/paper_figures/events_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "data/base/vec3.h"
#include "reco/figures/map_marks.h"
#include "reco/figures/svg.h"

namespace floe {

namespace {

constexpr double panel_width = 215, row_height = 46, left = 84, top = 100, gap = 34;
constexpr const char* grey = "#666666";
constexpr const char* with_colour = "#0b6fa4";
constexpr const char* without_colour = "#d1495b";

struct EventPanel {
  std::string title;
  std::vector<double> with, without, error;  // by event; `error` of the latter
  double best;                               // value of a perfect fit
};

std::vector<EventPanel> panels_of(const std::vector<EventErrors>& events) {
  std::vector<EventPanel> panels{{"angle from the truth [deg]", {}, {}, {}, 0},
                                 {"distance from the truth [m]", {}, {}, {}, 0},
                                 {"energy over truth", {}, {}, {}, 1},
                                 {"loss of ln L", {}, {}, {}, 0}};
  const auto add = [&](std::size_t panel, double with, double without, double error = 0) {
    panels[panel].with.push_back(with);
    panels[panel].without.push_back(without);
    panels[panel].error.push_back(error);
  };
  for (const EventErrors& e : events) {
    add(0, e.with.angle / degree, e.without.angle / degree);
    add(1, e.with.distance, e.without.distance);
    add(2, e.with.energy_ratio, e.without.energy_ratio);
    add(3, 0, e.delta_neg_llh, e.delta_neg_llh_error);
  }
  return panels;
}

void draw_panel(Svg& svg, double x, const EventPanel& panel) {
  double low = panel.best, high = panel.best;
  for (std::size_t i = 0; i < panel.with.size(); ++i) {
    low = std::min({low, panel.with[i], panel.without[i] - panel.error[i]});
    high = std::max({high, panel.with[i], panel.without[i] + panel.error[i]});
  }
  const double margin = high > low ? 0.08 * (high - low) : 1;
  low -= margin, high += margin;
  const double height = row_height * static_cast<double>(panel.with.size());
  const auto place = [&](double value) { return x + (value - low) / (high - low) * panel_width; };
  for (const double tick : round_ticks(low, high, 4)) {
    svg.line({place(tick), top}, {place(tick), top + height}, {"#e8e8e8", 1, ""});
    svg.text({place(tick), top + height + 17}, fmt::format("{:g}", tick), 12, Anchor::middle, grey);
  }
  svg.line({place(panel.best), top}, {place(panel.best), top + height}, {"#888888", 1, "3 3"});
  for (std::size_t i = 0; i < panel.with.size(); ++i) {
    const double y = top + row_height * (static_cast<double>(i) + 0.5);
    svg.line({place(panel.with[i]), y}, {place(panel.without[i]), y}, {"#bbbbbb", 2, ""});
    svg.line({place(panel.without[i] - panel.error[i]), y}, {place(panel.without[i] + panel.error[i]), y},
             {without_colour, 2, ""});
    svg.circle({place(panel.without[i]), y}, 5, without_colour);
    svg.circle({place(panel.with[i]), y}, 5, with_colour);
  }
  draw_frame(svg, {x, top}, panel_width, height);
  svg.text({x + panel_width / 2, top + height + 38}, panel.title, 13, Anchor::middle);
}

}  // namespace

std::string events_picture(const std::vector<EventErrors>& events, const std::string& title) {
  const std::vector<EventPanel> panels = panels_of(events);
  const auto count = static_cast<double>(panels.size());
  const double height = row_height * static_cast<double>(events.size());
  Svg svg(left + count * panel_width + (count - 1) * gap + 24, top + height + 56);
  svg.text({left, 30}, title, 16, Anchor::start, "#222222", true);
  svg.circle({left + 5, 62}, 5, with_colour);
  svg.text({left + 18, 66}, "fitted with birefringence", 13);
  svg.circle({left + 205, 62}, 5, without_colour);
  svg.text({left + 218, 66}, "fitted without; dashed: a perfect fit", 13);
  for (std::size_t i = 0; i < events.size(); ++i)
    svg.text({left - 12, top + row_height * (static_cast<double>(i) + 0.5) + 4},
             fmt::format("event {}", events[i].number), 13, Anchor::end);
  double x = left;
  for (const EventPanel& panel : panels) {
    draw_panel(svg, x, panel);
    x += panel_width + gap;
  }
  return svg.str();
}

}  // namespace floe
