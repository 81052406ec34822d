// A name for measured events: whatever a fit reads changes it, and nothing else does.
#include "data/event_hash.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

namespace floe {
namespace {

Event event_of_pulses() {
  Event event;
  event.id = "one";
  event.hits.resize(2);
  event.hits[0].module = {36, 20};
  event.hits[1].time = 12.5;
  event.readout = Readout{-4000,
                          6000,
                          {},
                          {{{1, 2}, 10, 20, UnusableTimes::Reason::dead}},
                          std::make_shared<const RecordingModules>(RecordingModules{{{1, 2}, true, 500}}),
                          {{0.02, 25, 65}}};
  return event;
}

std::string hash_after(const std::function<void(Event&)>& change) {
  Event event = event_of_pulses();
  change(event);
  return hash_of(std::vector<Event>{event});
}

TEST(EventHash, ChangesWithAllThatFitsRead) {
  const std::string same = hash_after([](Event&) {});
  EXPECT_EQ(same.size(), 32u);
  EXPECT_EQ(same, hash_after([](Event&) {}));
  const std::function<void(Event&)> changes[] = {
      [](Event& e) { e.id = "two"; },
      [](Event& e) { e.repeats = 2; },
      [](Event& e) { e.hits.pop_back(); },
      [](Event& e) { e.hits[0].module.dom = 21; },
      [](Event& e) { e.hits[1].time = 12.6; },
      [](Event& e) { e.hits[1].charge = 2; },
      [](Event& e) { e.hits[1].width = 5; },
      [](Event& e) { e.readout.reset(); },
      [](Event& e) { e.readout->end = 6001; },
      [](Event& e) { e.readout->unusable.clear(); },
      [](Event& e) { e.readout->unusable[0].end = 21; },
      [](Event& e) { e.readout->afterpulses.share = 0.05; },
      [](Event& e) { e.readout->delays[0].share = 0.03; },
      [](Event& e) {
        e.readout->modules = std::make_shared<const RecordingModules>(RecordingModules{{{1, 2}, false, 500}});
      }};
  for (const auto& change : changes) EXPECT_NE(hash_after(change), same);
}

TEST(EventHash, IsNotOfTheTruth) {
  EXPECT_EQ(hash_after([](Event& e) { e.truth.emplace_back(); }), hash_after([](Event&) {}));
}

}  // namespace
}  // namespace floe
