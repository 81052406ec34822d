// A name for the physics of an ice model.
#pragma once

#include <string>

#include "propagation/ice/ice_tables.h"

namespace floe {

// 32 hexadecimal digits over every number that a photon's fate depends on: version, layers with the
// anisotropy that they take from the directory, wavelength dependence, bubbles, configuration, the tilt
// in use and which parts of birefringence are on. Left out: the name, uncertainties, and the
// oversize (a choice of the simulation, not of the ice).
std::string ice_hash(const IceTables& tables);

}  // namespace floe
