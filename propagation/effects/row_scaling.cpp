#include "propagation/effects/row_scaling.h"

#include "data/base/error.h"
#include "propagation/ice/dust.h"

namespace floe {

void scale_absorption(const IceTables& ice, IceLayerRow& row, double factor) {
  if (factor == 1) return;
  const DustLaw law = dust_law(ice, row);
  if (law.D == 0)
    throw UsageError(
        "the absorption of single layers cannot change in ice " + ice.name +
        ": its coefficient D is 0, so that absorption does not depend on the layer; use absorption-scale");
  row.dust_absorption = law.column(factor * law.absorption(row.dust_absorption));
}

void scale_scattering(IceLayerRow& row, double factor) {
  row.effective_scattering *= factor;
}

}  // namespace floe
