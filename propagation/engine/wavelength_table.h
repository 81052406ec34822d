// What a photon's wavelength decides, against whole nanometres.
#pragma once

#include <vector>

#include "propagation/engine/photon_acceptance.h"
#include "propagation/engine/table_rows.h"
#include "propagation/ice/ice_model.h"

namespace floe {

// Read-only after construction; linear between rows, constant beyond them.
struct WavelengthTable {
  WavelengthTable(const IceModel& ice, const PhotonAcceptance& acceptance);

  // Factors in the layers' coefficients (IceLayer), inverse of the group velocity [ns/m], and the share of
  // photons that is walked at all (PhotonAcceptance).
  enum Column { scattering_power, absorption_dust, absorption_thermal, slowness, walked_share };
  static constexpr int shortest = 200, longest = 1000;  // [nm]
  std::vector<TableRow> rows;
};

}  // namespace floe
