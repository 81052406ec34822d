#include "propagation/engine/wavelength_table.h"

#include <algorithm>

#include "data/base/constants.h"

namespace floe {

WavelengthTable::WavelengthTable(const IceModel& ice, const PhotonAcceptance& acceptance) {
  for (int wavelength = shortest; wavelength <= longest; ++wavelength) {
    // Outside its range the refractive index is continued by the value at the range's end.
    const double inside = std::clamp<double>(wavelength, 250, 700);
    TableRow row{};
    row.values[scattering_power] = static_cast<float>(ice.scattering_power_factor(wavelength));
    row.values[absorption_dust] = static_cast<float>(ice.absorption_dust_factor(wavelength));
    row.values[absorption_thermal] = static_cast<float>(ice.absorption_thermal_factor(wavelength));
    row.values[slowness] = static_cast<float>(group_index(inside) / speed_of_light);
    row.values[walked_share] = static_cast<float>(acceptance.walked_share(wavelength));
    rows.push_back(row);
  }
}

}  // namespace floe
