// From the photons that modules detected to the pulses that analyses see: each repeat of an event goes
// through tubes, discriminators, coincidence, digitisers and pulse extraction.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "data/event.h"
#include "geometry/detector.h"
#include "response/module_record.h"

namespace floe {

// What of the way is kept, beside the pulses.
struct ResponseRecord {
  bool photoelectrons = false, waveforms = false;
};

struct RespondedEvent {
  Event event;  // id, truth, repeats and flasher as before; the hits are pulses; with a readout
  std::vector<ModulePhotoelectron> photoelectrons;
  std::vector<ModuleWaveform> waveforms;
  std::size_t launches = 0, hard_launches = 0;
};

class DetectorResponse {
 public:
  // `off` are silent beside the modules that the detector has switched off; modules that it does not have are
  // an InputError. The detector must outlive this.
  DetectorResponse(const Detector& detector, const ResponseSettings& settings, std::uint64_t seed,
                   const std::vector<ModuleId>& off = {});

  const RecordingModules& modules() const { return *modules_; }

  // A hit of charge c in an average over R repeats stands for c R photons: the whole part of that is taken,
  // and one more with the probability of the rest; each goes to a repeat at random. (Hits of oversized
  // modules are as many as those of nominal ones: fewer photons were propagated.) The result depends on
  // settings, seed and event alone, not on `threads`.
  // Throws InputError for hits that are no photons (they have no wavelength), for hits of modules that the
  // detector does not have, and for averages over a number of repeats that is not whole.
  RespondedEvent respond(const Event& event, const ResponseRecord& record, int threads) const;

 private:
  struct Window {
    double begin, end;
  };
  struct Photon {
    int repeat;
    std::uint32_t module;  // its place in the detector
    double time;           // [ns]
  };
  struct Part;  // one repeat

  std::vector<Photon> photons_of(const Event& event) const;
  Window window_of(const std::vector<Photon>& photons) const;
  Part part(const std::vector<Photon>& photons, std::uint64_t event, int repeat, const Window& window,
            const ResponseRecord& record, int threads) const;
  void add(Part part, const Window& window, int repeat, const ResponseRecord& record,
           RespondedEvent& result) const;

  const Detector& detector_;
  ResponseSettings settings_;
  ModuleElectronics electronics_;
  std::uint64_t seed_;
  double unit_;  // of calibrated charges: the mean of a photoelectron, in units of the peak
  std::shared_ptr<const RecordingModules> modules_;
};

}  // namespace floe
