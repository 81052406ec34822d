#include "response/response_settings.h"

#include <fmt/format.h>

#include "data/base/error.h"

namespace floe {

std::string_view name_of(CoincidenceMode mode) {
  switch (mode) {
    case CoincidenceMode::soft:
      return "soft";
    case CoincidenceMode::hard:
      return "hard";
    default:
      return "none";
  }
}

std::vector<ResponseSetting> list_of(ResponseSettings& s) {
  constexpr const char* spe = "arXiv:2002.00997, eq. 1";
  constexpr const char* template_numbers =
      "template of one module in the field's calibration library, without the steep part";
  constexpr const char* tube_paper = "arXiv:1002.2442";
  constexpr const char* instrument = "arXiv:1612.05093";
  constexpr const char* daq = "arXiv:0810.4930";
  constexpr const char* larson = "M. Larson, Univ. of Alabama 2013; arXiv:1612.05093";
  constexpr const char* choice = "a choice";
  constexpr double most = 1e9;
  DigitiserSettings& d = s.digitisers;
  return {
      {"charge", "steep_share", &s.charge.steep_share, 0, 1, "of photoelectrons in the steep exponential",
       "arXiv:2002.00997, eq. 1; 0: they stay below the discriminator and effective areas do not count them"},
      {"charge", "steep_width", &s.charge.steep_width, 1e-3, 10, "of the steep exponential [peak charges]",
       spe},
      {"charge", "exponential_share", &s.charge.exponential_share, 0, 1,
       "of photoelectrons in the other exponential", template_numbers},
      {"charge", "exponential_width", &s.charge.exponential_width, 1e-3, 10,
       "of the other exponential [peak charges]", template_numbers},
      {"charge", "peak_width", &s.charge.peak_width, 1e-3, 2, "of the Gaussian around 1 [peak charges]",
       template_numbers},
      {"time", "rise", &s.time.rise, 0, 100, "of the transit time's peak, early half [ns]", tube_paper},
      {"time", "fall", &s.time.fall, 1e-3, 100, "of the transit time's peak, late half [ns]", tube_paper},
      {"time", "prepulse_share", &s.time.prepulse_share, 0, 1, "of photoelectrons", tube_paper},
      {"time", "prepulse_time", &s.time.prepulse_time, -1000, 0, "before the peak [ns]", tube_paper},
      {"time", "prepulse_charge", &s.time.prepulse_charge, 0, 1, "of a photoelectron's", tube_paper},
      {"time", "shoulder_share", &s.time.shoulder_share, 0, 1, "of late photoelectrons before the late peak",
       "arXiv:1002.2442: 3.5% with the late peak; how they share it is a choice"},
      {"time", "shoulder_begin", &s.time.shoulder_begin, 0, 1000, "after the peak [ns]", tube_paper},
      {"time", "shoulder_end", &s.time.shoulder_end, 0, 1000, "after the peak [ns]", tube_paper},
      {"time", "late_peak_share", &s.time.late_peak_share, 0, 1,
       "of photoelectrons that come back from the first dynode",
       "arXiv:1002.2442: 3.5% with the shoulder; how they share it is a choice"},
      {"time", "late_peak_time", &s.time.late_peak_time, 0, 1000, "after the peak [ns]", tube_paper},
      {"time", "late_peak_width", &s.time.late_peak_width, 0, 100, "[ns]", choice},
      {"time", "tail_share", &s.time.tail_share, 0, 1, "of photoelectrons after the late peak", tube_paper},
      {"time", "tail_begin", &s.time.tail_begin, 0, 1000, "after the peak [ns]", tube_paper},
      {"time", "tail_end", &s.time.tail_end, 0, 1000, "after the peak [ns]", tube_paper},
      {"afterpulses", "share", &s.afterpulses.share, 0, 1, "for each photoelectron, on average", tube_paper},
      {"afterpulses", "begin", &s.afterpulses.begin, 1, 1e6, "after the photoelectron [ns]", tube_paper},
      {"afterpulses", "end", &s.afterpulses.end, 1, 1e6,
       "after the photoelectron; evenly in the logarithm of time [ns]", tube_paper},
      {"noise", "single_rate", &s.noise.single_rate, 0, 1e6, "of single dark photoelectrons [1/s]", larson},
      {"noise", "burst_rate", &s.noise.burst_rate, 0, 1e6, "of bursts [1/s]",
       "so that the whole is 560 /s, arXiv:1612.05093"},
      {"noise", "burst_size", &s.noise.burst_size, 0, 100, "photoelectrons of a burst, on average", larson},
      {"noise", "gap_log10_mean", &s.noise.gap_log10_mean, -12, 0,
       "of the decimal logarithm of gaps in a burst [log10 s]", larson},
      {"noise", "gap_log10_width", &s.noise.gap_log10_width, 0, 5, "of the same [log10 s]", larson},
      {"noise", "high_efficiency_factor", &s.noise.high_efficiency_factor, 0, 100,
       "of the rates of modules of high quantum efficiency", "arXiv:1612.05093: 780 /s over 560 /s"},
      {"tube", "gain", &s.tube.gain, 1e5, 1e9, "of the photomultiplier", instrument},
      {"tube", "impedance", &s.tube.impedance, 1, 1000, "that turns the anode's current to volts [Ohm]",
       "the field's calibration"},
      {"tube", "largest_current", &s.tube.largest_current, 1, 1e6, "that the anode can give [mA]",
       "arXiv:1002.2442: 7.5 V at 50 Ohm"},
      {"tube", "exponent", &s.tube.exponent, 0.1, 10, "B of the compression", tube_paper},
      {"tube", "factor", &s.tube.factor, 0, 100, "C of the compression; 0: none", tube_paper},
      {"tube", "pulse_width", &s.tube.pulse_width, 0.1, 100, "sigma of the anode's pulse [ns]", tube_paper},
      {"tube", "saturated_share", &s.tube.saturated_share, 1e-4, 1,
       "of charge lost, at which times are called saturated", choice},
      {"discriminator", "threshold", &s.discriminator.threshold, 0, 100,
       "of the peak of a photoelectron's pulse", instrument},
      {"local_coincidence", "mode", &s.launches.mode, 0, 0,
       "soft: isolated launches keep the charge stamp; hard: they are not sent; none: all are kept whole",
       instrument},
      {"local_coincidence", "window", &s.launches.window, 0, 1e6, "between launches of neighbours [ns]",
       instrument},
      {"local_coincidence", "distance", &s.launches.distance, 1, 1000, "of neighbours on a string [modules]",
       instrument},
      {"launch", "delay", &d.delay, 0, 1000, "of the line before the digitisers [ns]", instrument},
      {"launch", "clock", &d.clock, 0.1, 1000, "period of the module's clock [ns]", instrument},
      {"launch", "rearm", &s.launches.rearm, 0, most, "after a record [ns]", daq},
      {"launch", "soft_busy", &s.launches.soft_busy, 0, most,
       "of an isolated launch, from its beginning; above the window [ns]",
       "the window of the coincidence and some time to abort: a choice"},
      {"launch", "chip_busy", &s.launches.chip_busy, 0, most, "digitising of an ATWD chip [ns]", daq},
      {"launch", "chips", &s.launches.chips, 1, 100, "ATWDs of a module, taken in turns", daq},
      {"atwd", "samples", &d.atwd_samples, 8, 100000, "of a trace", instrument},
      {"atwd", "step", &d.atwd_step, 0.1, 1000, "from sample to sample [ns]",
       "arXiv:1612.05093: 300 million samples a second"},
      {"atwd", "gain_0", &d.atwd_gain[0], 1e-3, 1e3, "of the first channel", instrument},
      {"atwd", "gain_1", &d.atwd_gain[1], 1e-3, 1e3, "of the second channel", instrument},
      {"atwd", "gain_2", &d.atwd_gain[2], 1e-3, 1e3, "of the third channel", instrument},
      {"atwd", "count", &d.atwd_count, 1e-3, 1e3, "behind the gain [mV]", "the field's calibration"},
      {"atwd", "baseline", &d.atwd_baseline, 0, 1000, "[counts]", choice},
      {"atwd", "next_gain", &d.next_gain, 0, 1,
       "of the range: where a sample reaches it, the next gain is digitised", instrument},
      {"atwd", "b1", &d.atwd_b1, 0.1, 1000, "rise of the pulse (exp(-t/b1) + exp(t/b2))^-8 [ns]", instrument},
      {"atwd", "b2", &d.atwd_b2, 0.1, 1000, "fall of the pulse [ns]", instrument},
      {"fadc", "samples", &d.fadc_samples, 20, 100000, "of a trace", instrument},
      {"fadc", "step", &d.fadc_step, 0.1, 1000, "from sample to sample [ns]", instrument},
      {"fadc", "count", &d.fadc_count, 1e-6, 1e3, "at the anode [mV]", "the field's calibration"},
      {"fadc", "baseline", &d.fadc_baseline, 0, 1000, "[counts]", choice},
      {"fadc", "b1", &d.fadc_b1, 0.1, 1000, "rise of the pulse [ns]", instrument},
      {"fadc", "b2", &d.fadc_b2, 0.1, 1000, "fall of the pulse [ns]", instrument},
      {"fadc", "stamp_samples", &d.stamp_samples, 3, 20,
       "the charge stamp is the largest of so many, and its neighbours", instrument},
      {"pulses", "atwd_spacing", &s.pulses.atwd_spacing, 0.1, 1000,
       "of the pulses that are tried under an ATWD trace [ns]", choice},
      {"pulses", "fadc_spacing", &s.pulses.fadc_spacing, 0.1, 1000, "of the others [ns]", choice},
      {"pulses", "tolerance", &s.pulses.tolerance, 1e-6, 1e6,
       "what may be left unexplained along a pulse [counts]", choice},
      {"pulses", "least_charge", &s.pulses.least_charge, 0, 1e3, "of a pulse that is kept [peak charges]",
       choice},
      {"readout", "before", &s.readout.before, 0, most, "the middle of the event's light [ns]", instrument},
      {"readout", "after", &s.readout.after, 0, most, "the middle of the event's light [ns]", instrument},
  };
}

void check(const ResponseSettings& s) {
  const auto need = [](bool fits, const char* what) {
    if (!fits) throw UsageError(fmt::format("response: {}", what));
  };
  need(s.charge.steep_share + s.charge.exponential_share <= 1, "[charge] shares add up to more than 1");
  need(s.time.prepulse_share + s.time.shoulder_share + s.time.late_peak_share + s.time.tail_share <= 1,
       "[time] shares add up to more than 1");
  need(s.time.shoulder_begin <= s.time.shoulder_end, "[time] the shoulder ends before it begins");
  need(s.time.tail_begin <= s.time.tail_end, "[time] the tail ends before it begins");
  need(s.afterpulses.begin < s.afterpulses.end, "[afterpulses] end before they begin");
  need(s.launches.soft_busy > s.launches.window,
       "[launch] soft_busy must be above the window of the coincidence, which decides what a launch is");
  need(s.readout.before + s.readout.after > 0, "[readout] nothing is recorded");
}

}  // namespace floe
