#include "tests/app/same_events.h"

#include <gtest/gtest.h>

#include "data/event_stream.h"

namespace floe::test {

void expect_same_events(const std::filesystem::path& one, const std::filesystem::path& other) {
  const EventFileReader a(one), b(other);
  EXPECT_EQ(a.provenance().configuration, b.provenance().configuration);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t e = 0; e < a.size(); ++e) {
    SCOPED_TRACE(a.id(e));
    EXPECT_EQ(a.id(e), b.id(e));
    const Event left = a.read(e), right = b.read(e);
    ASSERT_EQ(left.hits.size(), right.hits.size());
    for (std::size_t i = 0; i < left.hits.size(); ++i) {
      EXPECT_EQ(left.hits[i].module, right.hits[i].module);
      EXPECT_EQ(left.hits[i].time, right.hits[i].time);
      EXPECT_EQ(left.hits[i].charge, right.hits[i].charge);
    }
    EXPECT_EQ(left.truth.size(), right.truth.size());
    ASSERT_EQ(left.readout.has_value(), right.readout.has_value());
    if (left.readout) {
      EXPECT_EQ(left.readout->unusable.size(), right.readout->unusable.size());
    }
    const auto traces = a.waveforms(e), others = b.waveforms(e);
    ASSERT_EQ(traces.size(), others.size());
    for (std::size_t i = 0; i < traces.size(); ++i) EXPECT_TRUE(traces[i].counts == others[i].counts);
  }
}

}  // namespace floe::test
