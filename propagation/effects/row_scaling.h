// Rows of an ice table with more or less dust in them.
#pragma once

#include "propagation/ice/ice_tables.h"

namespace floe {

// Multiplies a_dust(400) of a row, whatever its table holds (propagation/ice/dust.h); at 1 no bit changes.
// Throws UsageError for old tables in which absorption does not depend on the row (D = 0).
void scale_absorption(const IceTables& ice, IceLayerRow& row, double factor);

// Multiplies b_e(400) of the row, the crystals' share included where the table has it.
void scale_scattering(IceLayerRow& row, double factor);

}  // namespace floe
