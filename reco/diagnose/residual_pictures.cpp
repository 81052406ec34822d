#include "reco/diagnose/residual_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

#include "data/module_id.h"
#include "reco/figures/svg.h"

namespace floe {

namespace {

// Points with errors, before (red) and after (blue), against one axis.
class ProfilePlot {
 public:
  // `marked`: a place on the axis that has a name.
  ProfilePlot(const ResidualProfile& before, const ResidualProfile* after,
              const std::optional<std::pair<double, std::string>>& marked)
      : svg_(width, height) {
    low_ = before.low.front(), high_ = before.high.back();
    if (high_ == low_) high_ = low_ + 1;
    reach_ = 0.05;
    for (const ResidualProfile* p : {&before, after})
      for (std::size_t i = 0; p && i < p->low.size(); ++i)
        if (p->error[i] > 0 && p->error[i] < 0.1)
          reach_ = std::max(reach_, std::abs(p->relative[i]) + p->error[i]);
    reach_ = std::min(reach_ * 1.1, 1.0);
    frame(before);
    if (marked) mark(*marked);
    draw(before, "#c0392b", -1.5);
    if (after) draw(*after, "#2166ac", 1.5);
  }
  std::string str() const { return svg_.str(); }

 private:
  static constexpr double width = 380, height = 230, left = 56, right = 12, top = 26, bottom = 42;

  double x(double value) const { return left + (value - low_) / (high_ - low_) * (width - left - right); }
  double y(double value) const { return top + (reach_ - value) / (2 * reach_) * (height - top - bottom); }

  void frame(const ResidualProfile& p) {
    svg_.rectangle({0, 0}, width, height, "#ffffff");
    svg_.text({left, 16}, "Data above the model, by " + p.axis, 12, Anchor::start, "#222222", true);
    for (const double tick : round_ticks(low_, high_, 6)) {
      svg_.line({x(tick), height - bottom}, {x(tick), height - bottom + 4}, {"#444444", 1, ""});
      svg_.text({x(tick), height - bottom + 16}, fmt::format("{:g}", tick), 11, Anchor::middle);
    }
    for (const double tick : round_ticks(-reach_, reach_, 5)) {
      svg_.line({left, y(tick)}, {width - right, y(tick)}, {tick == 0 ? "#888888" : "#e4e4e4", 1, ""});
      svg_.text({left - 6, y(tick) + 4}, fmt::format("{:g}%", 100 * tick), 11, Anchor::end);
    }
    svg_.text({(left + width - right) / 2, height - 8},
              p.unit.empty() ? p.axis : fmt::format("{} [{}]", p.axis, p.unit), 11, Anchor::middle);
  }

  void mark(const std::pair<double, std::string>& place) {
    const double at = x(place.first);
    svg_.line({at, top}, {at, height - bottom}, {"#888888", 1, "4 3"});
    svg_.text({at + 4, top + 10}, place.second, 11, Anchor::start, "#666666");
  }

  // What is beyond the frame has an arrow at its edge.
  void draw(const ResidualProfile& p, const std::string& colour, double shift) {
    for (std::size_t i = 0; i < p.low.size(); ++i) {
      if (!(p.error[i] > 0) || p.error[i] > reach_) continue;
      const double at = x((p.low[i] + p.high[i]) / 2) + shift;
      const auto inside = [&](double value) { return y(std::clamp(value, -reach_, reach_)); };
      svg_.line({at, inside(p.relative[i] - p.error[i])}, {at, inside(p.relative[i] + p.error[i])},
                {colour, 1.2, ""});
      if (std::abs(p.relative[i]) <= reach_)
        svg_.circle({at, inside(p.relative[i])}, 2.6, colour);
      else
        svg_.text({at, p.relative[i] > 0 ? top + 10 : height - bottom - 2}, p.relative[i] > 0 ? "▲" : "▼", 10,
                  Anchor::middle, colour);
    }
  }

  Svg svg_;
  double low_ = 0, high_ = 1, reach_ = 0.1;
};

// "36,20", as the axis "module" names its cells.
ModuleId module_of(const std::string& name) {
  ModuleId id;
  std::sscanf(name.c_str(), "%d,%d", &id.string, &id.dom);
  return id;
}

// From grey, which agrees with the model, to red (above it) or blue (below).
std::string colour_of(double sigmas) {
  constexpr double full = 4, grey = 225, strong = 200;
  const double share = std::min(std::abs(sigmas) / full, 1.0);
  const int pale = static_cast<int>(std::lround(grey * (1 - share)));
  const int main = static_cast<int>(std::lround(grey + (strong - grey) * share));
  return sigmas > 0 ? fmt::format("#{:02x}{:02x}{:02x}", main, pale, pale)
                    : fmt::format("#{:02x}{:02x}{:02x}", pale, pale, main);
}

class ModuleMap {
 public:
  ModuleMap(const ResidualProfile& modules, const ResidualProfile* beside, const std::string& title)
      : svg_(left + width + 10, bottom + 30) {
    place_columns(modules, beside);
    svg_.rectangle({0, 0}, left + width + 10, bottom + 30, "#ffffff");
    svg_.text({left, 16}, title, 12, Anchor::start, "#222222", true);
    svg_.rectangle({left, top}, cell_ * double(column_of_.size()), bottom - top, "#f8f8f8");
    for (std::size_t i = 0; i < modules.names.size(); ++i) {
      const ModuleId id = module_of(modules.names[i]);
      if (modules.error[i] > 0)
        svg_.rectangle({column_of_[id.string], top + (id.dom - 1) * row}, cell_, row,
                       colour_of(modules.relative[i] / modules.error[i]));
    }
    label();
  }
  std::string str() const { return svg_.str(); }

 private:
  static constexpr double width = 480, left = 30, top = 26, row = 4, bottom = top + 60 * row;

  // Strings of both have columns.
  void place_columns(const ResidualProfile& modules, const ResidualProfile* beside) {
    for (const ResidualProfile* profile : {&modules, beside})
      if (profile)
        for (const std::string& name : profile->names) column_of_[module_of(name).string] = 0;
    cell_ = std::clamp(width / std::max<double>(1, double(column_of_.size())), 1.0, 12.0);
    for (double next = left; auto& [string, at] : column_of_) at = next, next += cell_;
  }

  void label() {
    for (const int dom : {1, 20, 40, 60})
      svg_.text({left - 5, top + (dom - 0.5) * row + 4}, fmt::format("{}", dom), 11, Anchor::end);
    const int every = std::max(1, static_cast<int>(std::ceil(22 / cell_)));
    int count = 0;
    for (const auto& [string, at] : column_of_)
      if (count++ % every == 0)
        svg_.text({at + cell_ / 2, bottom + 13}, fmt::format("{}", string), 10, Anchor::middle);
    svg_.text({left, bottom + 26}, "string; DOM number downwards", 11);
  }

  Svg svg_;
  std::map<int, double> column_of_;  // by string
  double cell_ = 1;
};

}  // namespace

std::string profile_picture(const ResidualProfile& before, const ResidualProfile* after,
                            const std::optional<std::pair<double, std::string>>& marked) {
  return ProfilePlot(before, after, marked).str();
}

std::string module_picture(const ResidualProfile& modules, const ResidualProfile* beside,
                           const std::string& title) {
  return ModuleMap(modules, beside, title).str();
}

}  // namespace floe
