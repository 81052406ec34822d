// Single crystals of ice: a uniaxial medium, whose optic axis is the crystal's c-axis.
#pragma once

namespace floe {

// Principal refractive indices: of light polarised across the c-axis, and along it.
struct CrystalIndices {
  double ordinary, extraordinary;

  double birefringence() const { return extraordinary - ordinary; }
};

// Of ice Ih at a wavelength [nm] in [250, 700]; 1.3185 and 1.3200 at 405 nm.
//   Mean index (2 n_o + n_e)/3: the phase index of ice (phase_index), shifted by 2e-5 to 1.3190 at 405 nm.
//   Difference: 0.0015 at 405 nm and 0.0014 at 589 nm (Petrenko and Whitworth, Physics of Ice, 1999, from
//   prisms: n_o 1.3091, n_e 1.3105 at 589 nm), a straight line in between and beyond. Both are rounded to
//   1e-4, so that the strength of all scattering, their difference squared, is known to 10%.
CrystalIndices crystal_indices(double wavelength);

}  // namespace floe
