// The traces of a launch: the ATWD in three gains and the FADC (arXiv:1612.05093, section 4.2;
// arXiv:0810.4930). Left out: the droop of the transformer that couples the tube, and the noise of the
// electronics, which is of the order of a count; counts are rounded.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "data/readout.h"
#include "response/pulse_shape.h"

namespace floe {

struct DigitiserSettings {
  double delay = 75;  // of the line before the digitisers: so much before the launch the record begins [ns]
  double clock = 25;  // a record begins at a tick of the module's clock [ns]

  int atwd_samples = 128;
  double atwd_step = 10.0 / 3;  // 300 million samples a second [ns]
  std::array<double, 3> atwd_gain = {15.7, 1.79, 0.21};
  double atwd_count = 2;       // at the digitiser [mV]
  double atwd_baseline = 130;  // [counts]
  double next_gain = 0.75;     // of the range: where a sample reaches it, the next gain is digitised, too
  double atwd_b1 = 5.5, atwd_b2 = 42;  // of the pulse [ns]

  int fadc_samples = 256;
  double fadc_step = 25;               // [ns]
  double fadc_count = 0.0894;          // at the anode [mV]
  double fadc_baseline = 130;          // [counts]
  double fadc_b1 = 30, fadc_b2 = 186;  // of the pulse [ns]

  int stamp_samples = 16;  // the charge stamp is the largest of so many FADC samples, and its neighbours

  static constexpr int largest_count = 1023;  // 10 bits
};

class Digitisers {
 public:
  // `charge`: of one photoelectron of charge 1 over the impedance [mV ns].
  Digitisers(const DigitiserSettings& settings, double charge);

  // The first sample's time of a launch at `launch`; the clock ticks at `phase` [ns] and every 25 ns from
  // there.
  double record_begin(double launch, double phase) const;

  // What is sent of a launch: whole, ATWD traces as far as they were digitised and all of the FADC; else the
  // FADC's charge stamp. `photoelectrons` are in order of time.
  std::vector<Waveform> digitise(std::span<const Photoelectron> photoelectrons, double begin,
                                 bool whole) const;

  const PulseShape& atwd_shape() const { return atwd_shape_; }
  const PulseShape& fadc_shape() const { return fadc_shape_; }
  const PulseShape& shape(Digitiser digitiser) const {
    return digitiser == Digitiser::fadc ? fadc_shape_ : atwd_shape_;
  }
  double charge() const { return charge_; }  // [mV ns]

 private:
  std::vector<double> voltages(const PulseShape& shape, std::span<const Photoelectron> photoelectrons,
                               double begin, double step, int samples) const;

  DigitiserSettings settings_;
  double charge_;
  PulseShape atwd_shape_, fadc_shape_;
};

}  // namespace floe
