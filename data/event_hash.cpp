#include "data/event_hash.h"

#include "data/base/hash.h"

namespace floe {

namespace {

void add(const ModuleId& module, Hasher& hash) {
  hash.add(module.string).add(module.dom);
}

void add(const Readout& readout, Hasher& hash) {
  hash.add(readout.begin).add(readout.end);
  hash.add(readout.afterpulses.share).add(readout.afterpulses.begin).add(readout.afterpulses.end);
  hash.add(readout.unusable.size());
  for (const UnusableTimes& times : readout.unusable) {
    add(times.module, hash);
    hash.add(times.begin).add(times.end).add(name_of(times.reason));
  }
  hash.add(readout.modules->size());
  for (const RecordingModule& module : *readout.modules) {
    add(module.id, hash);
    hash.add(module.on).add(module.noise_rate);
  }
  hash.add(readout.delays.size());
  for (const ExpectedDelay& delay : readout.delays) hash.add(delay.share).add(delay.begin).add(delay.end);
}

}  // namespace

std::string hash_of(std::span<const Event> events) {
  Hasher hash;
  for (const Event& event : events) {
    hash.add(std::string_view(event.id)).add(event.repeats).add(event.hits.size());
    for (const Hit& hit : event.hits) {
      add(hit.module, hash);
      hash.add(hit.time).add(double(hit.charge)).add(double(hit.width));
    }
    hash.add(event.readout.has_value());
    if (event.readout) add(*event.readout, hash);
  }
  return hash.hex();
}

}  // namespace floe
