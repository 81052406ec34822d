// Events through the electronics: photons are counted, nothing depends on threads, silent modules stay
// silent.
#include "response/detector_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "data/base/error.h"

namespace floe {

namespace {

// Two strings of ten modules.
Detector small_detector() {
  std::vector<Module> modules;
  for (int string = 1; string <= 2; ++string)
    for (int dom = 1; dom <= 10; ++dom) {
      Module module;
      module.id = {string, dom};
      module.position = {100.0 * string, 0, -17.0 * dom};
      modules.push_back(module);
    }
  return Detector("small", modules);
}

ResponseSettings without_noise() {
  ResponseSettings settings;
  settings.noise.single_rate = settings.noise.burst_rate = 0;
  settings.afterpulses.share = 0;
  return settings;
}

// `count` photons on each module of string 1, spread over a microsecond.
Event light(int count, double repeats = 1, float charge = 1) {
  Event event;
  event.id = "light";
  event.repeats = repeats;
  for (int dom = 1; dom <= 10; ++dom)
    for (int i = 0; i < count; ++i) {
      Hit hit;
      hit.module = {1, dom};
      hit.time = 1000.0 * i / count;
      hit.charge = charge;
      hit.wavelength = 400;
      event.hits.push_back(hit);
    }
  return event;
}

double charge_of(const Event& event) {
  double sum = 0;
  for (const Hit& hit : event.hits) sum += hit.charge;
  return sum;
}

void expect_same(const RespondedEvent& a, const RespondedEvent& b) {
  ASSERT_EQ(a.event.hits.size(), b.event.hits.size());
  for (std::size_t i = 0; i < a.event.hits.size(); ++i) {
    EXPECT_EQ(a.event.hits[i].module, b.event.hits[i].module);
    EXPECT_EQ(a.event.hits[i].time, b.event.hits[i].time);
    EXPECT_EQ(a.event.hits[i].charge, b.event.hits[i].charge);
  }
  ASSERT_EQ(a.photoelectrons.size(), b.photoelectrons.size());
  ASSERT_EQ(a.waveforms.size(), b.waveforms.size());
  for (std::size_t i = 0; i < a.waveforms.size(); ++i)
    EXPECT_EQ(a.waveforms[i].counts, b.waveforms[i].counts);
  EXPECT_EQ(a.event.readout->unusable.size(), b.event.readout->unusable.size());
}

constexpr ResponseRecord everything{true, true};

}  // namespace

TEST(DetectorResponse, DependsOnSeedAndEventButNotOnThreads) {
  const Detector detector = small_detector();
  const DetectorResponse response(detector, {}, 1), other(detector, {}, 2);
  for (const double repeats : {1.0, 5.0}) {
    const Event event = light(40, repeats, static_cast<float>(1 / repeats));
    const RespondedEvent one = response.respond(event, everything, 1);
    expect_same(one, response.respond(event, everything, 3));
    EXPECT_NE(charge_of(one.event), charge_of(other.respond(event, everything, 1).event));
    Event named = event;
    named.id = "other light";
    EXPECT_NE(charge_of(one.event), charge_of(response.respond(named, everything, 1).event));
  }
}

TEST(DetectorResponse, APhotonCountsOneOnAverage) {
  const Detector detector = small_detector();
  const DetectorResponse response(detector, without_noise(), 1);
  constexpr int count = 400;
  const RespondedEvent result = response.respond(light(count), everything, 1);
  // 10000 photons; the width of one charge is 0.5 of its mean, prepulses lack 0.3%.
  EXPECT_NEAR(charge_of(result.event), 10.0 * count, 5 * 0.55 * std::sqrt(10.0 * count) + 0.01 * 10 * count);
  EXPECT_EQ(result.photoelectrons.size(), 10u * count);
  EXPECT_TRUE(result.event.readout->unusable.empty());
}

TEST(DetectorResponse, WeightsAreChancesAndLargeOnesMany) {
  const Detector detector = small_detector();
  const DetectorResponse response(detector, without_noise(), 1);
  for (const float weight : {0.1f, 0.5f, 3.25f}) {
    const auto taken =
        static_cast<double>(response.respond(light(2000, 1, weight), everything, 1).photoelectrons.size());
    const double part = weight - std::floor(weight), sigma = std::sqrt(20000 * part * (1 - part));
    EXPECT_NEAR(taken, 20000 * weight, 5 * sigma) << weight;
  }
}

TEST(DetectorResponse, RepeatsAreDigitisedOneByOne) {
  const Detector detector = small_detector();
  const DetectorResponse response(detector, without_noise(), 1);
  constexpr double repeats = 50;
  const RespondedEvent result = response.respond(light(1000, repeats, 1 / 50.0f), everything, 2);
  EXPECT_EQ(result.event.repeats, repeats);
  // 10000 photons over 50 repeats: 200 on average in each.
  std::map<int, int> photons;
  for (const auto& pe : result.photoelectrons) ++photons[pe.repeat];
  ASSERT_EQ(photons.size(), 50u);
  double chi_square = 0;
  for (const auto& [repeat, count] : photons) chi_square += (count - 200.0) * (count - 200.0) / 200;
  EXPECT_LT(chi_square, 49 + 5 * std::sqrt(2 * 49.0));
  EXPECT_GT(chi_square, 49 - 4 * std::sqrt(2 * 49.0));
  EXPECT_NEAR(charge_of(result.event), 200, 5 * 0.55 * std::sqrt(10000.0) / repeats + 4);
}

TEST(DetectorResponse, ModulesThatAreOffStaySilent) {
  const Detector detector = small_detector();
  ResponseSettings noisy;
  noisy.noise.single_rate = 1e6;  // 10 in the time that is recorded
  const DetectorResponse response(detector, noisy, 1, {{1, 5}, {2, 3}});
  const RespondedEvent result = response.respond(light(100), everything, 1);
  std::map<ModuleId, int> pulses;
  for (const Hit& hit : result.event.hits) ++pulses[hit.module];
  EXPECT_EQ(pulses.size(), 18u);
  EXPECT_FALSE(pulses.contains({1, 5}) || pulses.contains({2, 3}));
  for (const auto& pe : result.photoelectrons) EXPECT_FALSE(pe.module == ModuleId({1, 5}));
  const RecordingModules& modules = *result.event.readout->modules;
  ASSERT_EQ(modules.size(), 20u);
  EXPECT_FALSE(modules[4].on);
  EXPECT_EQ(modules[4].noise_rate, 0);
  EXPECT_TRUE(modules[5].on);
  EXPECT_GT(modules[5].noise_rate, 0);
  EXPECT_THROW(DetectorResponse(detector, noisy, 1, {{3, 1}}), InputError);
}

TEST(DetectorResponse, IsolatedLaunchesKeepThreeSamples) {
  const Detector detector = small_detector();
  Event event = light(0);
  Hit hit;
  hit.module = {2, 5};
  hit.wavelength = 400;
  event.hits.assign(3, hit);  // bright enough for the discriminator
  const RespondedEvent soft = DetectorResponse(detector, without_noise(), 1).respond(event, everything, 1);
  ASSERT_EQ(soft.waveforms.size(), 1u);
  EXPECT_EQ(soft.waveforms[0].digitiser, Digitiser::fadc);
  EXPECT_EQ(soft.waveforms[0].counts.size(), 3u);
  ASSERT_FALSE(soft.event.hits.empty());
  // What comes while the module is busy is lost, and said to be.
  ASSERT_EQ(soft.event.readout->unusable.size(), 1u);
  EXPECT_EQ(soft.event.readout->unusable[0].reason, UnusableTimes::Reason::dead);

  ResponseSettings settings = without_noise();
  settings.launches.mode = CoincidenceMode::hard;
  EXPECT_TRUE(DetectorResponse(detector, settings, 1).respond(event, everything, 1).event.hits.empty());
  settings.launches.mode = CoincidenceMode::none;
  const RespondedEvent whole = DetectorResponse(detector, settings, 1).respond(event, everything, 1);
  ASSERT_EQ(whole.waveforms.size(), 2u);
  EXPECT_EQ(whole.waveforms[0].counts.size(), 128u);
  EXPECT_EQ(whole.waveforms[1].counts.size(), 256u);
}

TEST(DetectorResponse, RefusesWhatIsNoPhoton) {
  const Detector detector = small_detector();
  const DetectorResponse response(detector, {}, 1);
  Event pulses = light(1);
  pulses.hits[0].wavelength = Hit::unknown;
  EXPECT_THROW(response.respond(pulses, {}, 1), InputError);
  Event elsewhere = light(1);
  elsewhere.hits[0].module = {7, 7};
  EXPECT_THROW(response.respond(elsewhere, {}, 1), InputError);
  EXPECT_THROW(response.respond(light(1, 2.5), {}, 1), InputError);
}

}  // namespace floe
