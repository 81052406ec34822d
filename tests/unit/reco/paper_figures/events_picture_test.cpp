// The picture of fits with and without birefringence.
#include "reco/paper_figures/events_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace floe {
namespace {

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(EventsPicture, HasTwoPointsForEachEventInEachPanel) {
  const std::vector<EventErrors> events{{1, {0.01, 0.5, 1.01}, {0.1, 3, 1.2}, 40, 2},
                                        {3, {0.02, 0.2, 0.99}, {0.05, 4, 0.9}, 25, 3}};
  const std::string svg = events_picture(events, "Cascades");
  constexpr std::size_t panels = 4, legend = 2;
  EXPECT_EQ(count(svg, "<circle"), legend + panels * events.size() * 2);
  // Numbers stay those of the events where one was left out.
  EXPECT_EQ(count(svg, ">event 1<"), 1u);
  EXPECT_EQ(count(svg, ">event 3<"), 1u);
  for (const char* said : {"[deg]", "[m]", "energy over truth", "loss of ln L"})
    EXPECT_EQ(count(svg, said), 1u) << said;
}

// Without a difference there is still an axis.
TEST(EventsPicture, OfEqualFitsIsDrawn) {
  const std::string svg = events_picture({{1, {0, 0, 1}, {0, 0, 1}, 0, 0}}, "Cascades");
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

}  // namespace
}  // namespace floe
