// Pulses give back the light: charge and time of single photoelectrons, and charge in proportion to light
// until something saturates.
#include <gtest/gtest.h>

#include <numeric>

#include "response/module_record.h"

namespace floe {

namespace {

// No noise, no afterpulses, nothing but the peak of the transit time.
ResponseSettings plain_settings() {
  ResponseSettings settings;
  settings.noise.single_rate = settings.noise.burst_rate = 0;
  settings.afterpulses.share = 0;
  settings.time.prepulse_share = settings.time.shoulder_share = settings.time.late_peak_share =
      settings.time.tail_share = 0;
  return settings;
}

std::vector<ExtractedPulse> pulses_of(const ModuleElectronics& electronics, const TubeOutput& tube,
                                      bool hard) {
  std::vector<Launch> launches;
  if (!tube.crossings.empty()) launches.push_back({tube.crossings.front(), hard});
  return electronics.record(tube, launches, false).pulses;
}

double charge_of(const std::vector<ExtractedPulse>& pulses) {
  return std::accumulate(pulses.begin(), pulses.end(), 0.0,
                         [](double sum, const ExtractedPulse& pulse) { return sum + pulse.charge; });
}

// Of single photoelectrons that the discriminator sees: pulses' charge less the true one, in units of it, and
// time less the true one.
struct Errors {
  int seen = 0, split = 0;
  double charge = 0, worst_charge = 0, time = 0, square_of_time = 0, worst_time = 0;
};
Errors errors_of_single_photoelectrons(bool hard, int count) {
  const ModuleElectronics electronics(plain_settings());
  Errors errors;
  for (int i = 0; i < count; ++i) {
    RandomStream stream(1, 2, static_cast<std::uint64_t>(i));
    const double photon[] = {1000 + 0.37 * i};
    const TubeOutput tube = electronics.tube_output(photon, 1, 0, 1, false, stream);
    const auto pulses = pulses_of(electronics, tube, hard);
    if (pulses.empty()) continue;
    const Photoelectron& truth = tube.photoelectrons.front();
    const double charge = charge_of(pulses) / truth.charge - 1;
    double time = 0;
    for (const ExtractedPulse& pulse : pulses) time += pulse.charge * (pulse.time - truth.time);
    time /= charge_of(pulses);
    ++errors.seen;
    errors.split += pulses.size() > 1;
    errors.charge += charge;
    errors.worst_charge = std::max(errors.worst_charge, std::abs(charge));
    errors.time += time;
    errors.square_of_time += time * time;
    errors.worst_time = std::max(errors.worst_time, std::abs(time));
  }
  errors.charge /= errors.seen;
  errors.time /= errors.seen;
  return errors;
}

}  // namespace

TEST(Pulses, OfSinglePhotoelectronsAreRightInWholeRecords) {
  const Errors errors = errors_of_single_photoelectrons(true, 2000);
  EXPECT_GT(errors.seen, 1700);                 // 13% of charges are below the discriminator
  EXPECT_LT(errors.split, 0.15 * errors.seen);  // a ghost of 5% some nanoseconds away
  EXPECT_LT(std::abs(errors.charge), 0.01);
  EXPECT_LT(errors.worst_charge, 0.05);
  EXPECT_LT(errors.worst_time, 2);
  EXPECT_LT(std::abs(errors.time), 0.1);
  RecordProperty("time_rms_ps", static_cast<int>(1000 * std::sqrt(errors.square_of_time / errors.seen)));
}

TEST(Pulses, OfSinglePhotoelectronsAreRightInChargeStamps) {
  const Errors errors = errors_of_single_photoelectrons(false, 2000);
  EXPECT_GT(errors.seen, 1700);
  EXPECT_LT(std::abs(errors.charge), 0.02);
  EXPECT_LT(std::abs(errors.time), 0.5);
  EXPECT_LT(std::sqrt(errors.square_of_time / errors.seen), 2);
}

// Light of all photoelectrons that a tube gave against that of the pulses, to 2%.
TEST(Pulses, AreInProportionToLightUntilSaturation) {
  const ModuleElectronics electronics(plain_settings());
  // Photons, and the time over which they come [ns]: what the FADC can follow beyond the ATWD's trace, and a
  // twentieth of the tube's largest current under it.
  for (const auto& [photons, over] :
       {std::pair(2, 1200.0), {10, 1200.0}, {50, 1200.0}, {200, 1200.0}, {800, 1200.0}, {1200, 300.0}}) {
    double true_charge = 0, charge = 0;
    for (int repeat = 0; repeat < std::max(2, 400 / photons); ++repeat) {
      RandomStream light(3, 4, static_cast<std::uint64_t>(repeat));
      std::vector<double> times;
      for (int i = 0; i < photons; ++i) times.push_back(over * light.uniform());
      RandomStream stream(5, 6, static_cast<std::uint64_t>(repeat));
      const TubeOutput tube = electronics.tube_output(times, 1, 0, 1, true, stream);
      if (tube.crossings.empty()) continue;
      for (const Photoelectron& pe : tube.before) true_charge += pe.charge;
      charge += charge_of(pulses_of(electronics, tube, true));
    }
    EXPECT_NEAR(charge / true_charge, 1, 0.02) << photons << " photons in " << over << " ns";
  }
}

// Light that lasts is unfolded to spikes some 10 ns apart, but their widths say what lies between: in bins of
// 6 ns charges differ from the light that came by no more than charges scatter, and a little.
TEST(Pulses, OfLightThatLastsAreSpreadOverIt) {
  constexpr int photons = 1200, bins = 40;
  constexpr double over = 300, first = 30, step = 6;  // [ns]
  const ModuleElectronics electronics(plain_settings());
  double as_spikes = 0, spread = 0;  // mean square differences, in units of the photons in a bin
  constexpr int repeats = 10;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    RandomStream light(3, 4, static_cast<std::uint64_t>(repeat)),
        stream(5, 6, static_cast<std::uint64_t>(repeat));
    std::vector<double> times;
    for (int i = 0; i < photons; ++i) times.push_back(over * light.uniform());
    const TubeOutput tube = electronics.tube_output(times, 1, 0, 1, true, stream);
    const auto pulses = pulses_of(electronics, tube, true);
    for (int bin = 0; bin < bins; ++bin) {
      const double low = first + bin * step, high = low + step;
      double truth = 0, spike = 0, even = 0;
      for (const Photoelectron& pe : tube.before) truth += pe.time >= low && pe.time < high ? pe.charge : 0;
      for (const ExtractedPulse& pulse : pulses) {
        spike += pulse.time >= low && pulse.time < high ? pulse.charge : 0;
        const double begin = pulse.time - pulse.width / 2, end = begin + pulse.width;
        even += pulse.charge * std::max(0.0, std::min(high, end) - std::max(low, begin)) / pulse.width;
      }
      as_spikes += (spike - truth) * (spike - truth), spread += (even - truth) * (even - truth);
    }
  }
  const double unit = repeats * bins * photons * step / over;
  EXPECT_LT(spread / unit, 0.5);
  EXPECT_GT(as_spikes / unit, 1.5);  // else there would be no need
}

TEST(Pulses, OfBrightFlashesAreSaidToBeSaturated) {
  const ModuleElectronics electronics(plain_settings());
  const auto record_of = [&](int photons, double over) {
    std::vector<double> times;
    for (int i = 0; i < photons; ++i) times.push_back(over * i / photons);
    RandomStream stream(7, 8, 9);
    const TubeOutput tube = electronics.tube_output(times, 1, 0, 1, false, stream);
    const Launch launch{tube.crossings.front(), true};
    return electronics.record(tube, {&launch, 1}, false);
  };
  EXPECT_TRUE(record_of(100, 100).unusable.empty());
  const ModuleRecord bright = record_of(20000, 50);
  ASSERT_FALSE(bright.unusable.empty());
  EXPECT_EQ(bright.unusable.front().reason, UnusableTimes::Reason::saturated);
  EXPECT_LT(bright.unusable.front().begin, 25);
  EXPECT_GT(bright.unusable.front().end, 25);
}

// What no digitiser could follow may be lost, but is not made more: far tails say nothing about its charge.
TEST(Pulses, BeyondSaturationHoldNoMoreThanTheLight) {
  const ModuleElectronics electronics(plain_settings());
  for (const auto& [photons, over] : {std::pair(20000, 300.0), {100000, 1200.0}, {50000, 100.0}}) {
    RandomStream light(3, 4, 5), stream(5, 6, 7);
    std::vector<double> times;
    for (int i = 0; i < photons; ++i) times.push_back(over * light.uniform());
    const TubeOutput tube = electronics.tube_output(times, 1, 0, 1, true, stream);
    double true_charge = 0;
    for (const Photoelectron& pe : tube.before) true_charge += pe.charge;
    EXPECT_LT(charge_of(pulses_of(electronics, tube, true)), 1.1 * true_charge)
        << photons << " photons in " << over << " ns";
  }
}

// A known number: 560 Hz of photoelectrons, of which bursts lose those that fall into dead times.
TEST(Pulses, OfDarkNoiseHaveTheRateThatIsFound) {
  const ModuleElectronics electronics{ResponseSettings()};
  const double rate = electronics.noise_charge() / PhotoelectronCharge().mean();
  EXPECT_GT(rate, 350);
  EXPECT_LT(rate, 560);
  ResponseSettings silent;
  silent.noise.single_rate = silent.noise.burst_rate = 0;
  EXPECT_EQ(ModuleElectronics(silent).noise_charge(), 0);
  RecordProperty("noise_pe_per_s", static_cast<int>(rate));
}

TEST(PulseShape, HasIntegralOneAndItsPeakWhereItSays) {
  for (const auto& [b1, b2] : {std::pair(5.5, 42.0), std::pair(30.0, 186.0)}) {
    const PulseShape shape(b1, b2);
    double integral = 0, highest = 0, at = 0;
    for (double t = shape.begin(); t < shape.end(); t += 0.01) {
      integral += 0.01 * shape(t);
      if (shape(t) > highest) highest = shape(t), at = t;
    }
    EXPECT_NEAR(integral, 1, 1e-3);
    EXPECT_NEAR(highest, shape.peak(), 1e-6);
    EXPECT_NEAR(at, shape.peak_time(), 0.02);
    EXPECT_NEAR(shape(0), 0.5 * shape.peak(), 1e-6);
  }
}

}  // namespace floe
