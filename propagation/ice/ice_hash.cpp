#include "propagation/ice/ice_hash.h"

#include <initializer_list>

#include "data/base/hash.h"

namespace floe {

namespace {

class NumberHasher {
 public:
  void add(std::initializer_list<double> numbers) {
    for (double number : numbers) hasher_.add(number + 0.0);  // -0 is the same number as 0
  }
  void add(const std::vector<double>& numbers) {
    begin(static_cast<std::int64_t>(numbers.size()));
    for (double number : numbers) add({number});
  }
  // Keeps blocks apart: a block that is absent cannot be mistaken for the next one.
  void begin(std::int64_t size) { hasher_.add(size); }
  std::string hex() const { return hasher_.hex(); }

 private:
  Hasher hasher_;
};

void add_layers(NumberHasher& hash, const IceTables& tables) {
  const auto& c = tables.configuration;
  hash.begin(static_cast<std::int64_t>(tables.layers.size()));
  for (const auto& row : tables.layers) {
    hash.add({row.depth, row.effective_scattering, row.dust_absorption, row.temperature_difference,
              row.k1.value_or(c.k1), row.k2.value_or(c.k2)});
    if (c.birefringence) hash.add({row.birefringence_strength, row.deflection_strength});
  }
}

void add_birefringence(NumberHasher& hash, const std::optional<BirefringenceNumbers>& numbers) {
  hash.begin(numbers.has_value());
  if (!numbers) return;
  for (const auto& f : {numbers->sigma_x, numbers->sigma_y, numbers->mean_x}) hash.add({f.A, f.B, f.C, f.D});
  for (bool part : {numbers->diffusion, numbers->deflection, numbers->displacement}) hash.begin(part);
}

void add_configuration(NumberHasher& hash, const IceConfiguration& c) {
  hash.add({c.module_efficiency, c.simplified_liu_fraction, c.mean_cosine, c.flow_azimuth_deg});
  const auto& hole = c.hole_ice;
  hash.begin(hole.radius > 0);
  if (hole.radius > 0)
    hash.add({hole.radius, hole.effective_scattering_length, hole.absorption_length,
              hole.simplified_liu_fraction, hole.mean_cosine});
  const auto absorption = c.absorption_anisotropy.value_or(IceConfiguration::AbsorptionAnisotropy{});
  hash.add({absorption.k1, absorption.k2, absorption.kz, c.old_absorption_scaling});
  add_birefringence(hash, c.birefringence);
}

void add_shifts(NumberHasher& hash, const std::vector<double>& depths,
                const std::vector<std::vector<double>>& shifts) {
  hash.add(depths);
  for (const auto& row : shifts) hash.add(row);
}

void add_tilt(NumberHasher& hash, const IceTables& tables) {
  if (tables.tilt_map) {
    hash.begin(2);
    for (const auto& axis : {tables.tilt_map->first, tables.tilt_map->second})
      hash.add({axis.direction_deg, axis.start, axis.step, double(axis.count), double(axis.cut)});
    add_shifts(hash, tables.tilt_map->depths, tables.tilt_map->shifts);
  } else if (tables.tilt_lines) {
    hash.begin(1);
    hash.add(tables.tilt_lines->distances);
    for (int string : tables.tilt_lines->strings) hash.begin(string);
    add_shifts(hash, tables.tilt_lines->depths, tables.tilt_lines->shifts);
  } else {
    hash.begin(0);
  }
}

}  // namespace

std::string ice_hash(const IceTables& tables) {
  NumberHasher hash;
  hash.begin(tables.version);
  add_layers(hash, tables);
  const auto& w = tables.wavelength;
  hash.add({w.alpha, w.kappa, w.A, w.B});
  hash.begin(w.D || w.E);
  if (w.D || w.E) hash.add({w.D.value_or(0), w.E.value_or(0)});
  hash.begin(tables.bubbles.has_value());
  if (const auto& b = tables.bubbles) hash.add({b->b, b->d1, b->d2});
  add_configuration(hash, tables.configuration);
  add_tilt(hash, tables);
  return hash.hex();
}

}  // namespace floe
