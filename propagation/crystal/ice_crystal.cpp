#include "propagation/crystal/ice_crystal.h"

#include "propagation/ice/ice_model.h"

namespace floe {

CrystalIndices crystal_indices(double wavelength) {
  constexpr double violet = 405, yellow = 589, mean_at_violet = 1.3190;
  const double mean = mean_at_violet + phase_index(wavelength) - phase_index(violet);
  const double difference = 0.0015 - 0.0001 * (wavelength - violet) / (yellow - violet);
  return {mean - difference / 3, mean + 2 * difference / 3};
}

}  // namespace floe
