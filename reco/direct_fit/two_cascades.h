// Which of two cascades the data come from, when simulations of both are hardly larger than the data. The
// difference of their likelihoods has noise from every bin, told apart there or not; one sum of counts with
// fitting weights has little, and simulations calibrate it. Theory: docs/theory/direct_fit.md.
#pragma once

#include "reco/direct_fit/goodness_of_fit.h"

namespace floe {

// -ln L of one less that of the other, from T = sum of w_i d_i with w_i = ln(mu_one,i / mu_other,i) as far as
// simulations know it; T is normal about its expectation and with its variance under either. The weights that
// a part of the simulations judges come from the others: no noise is judged by itself. Both
// evaluations must be of the same data and equal simulations, of two parts or more. `model_error`: of every
// bin. `charge_dispersion`: EventData's. 0 +- 0 where simulations cannot tell the two apart.
Difference worse_by(const Evaluation& one, const Evaluation& other, double model_error,
                    double charge_dispersion);

}  // namespace floe
