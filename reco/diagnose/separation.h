// What would tell two effects apart that these data cannot.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reco/diagnose/axes.h"
#include "reco/diagnose/survey.h"

namespace floe {

struct Separation {
  std::string effect, other;
  // Of these runs, in units of the data's, at which the two would be three standard deviations apart;
  // infinite where no light would do.
  double light = 0;
  std::string run;       // that tells the most for its light
  std::string sentence;  // in words, with where in its light they differ
};

// `axes`: of the survey. `difference`: of the light that the two change, by column of the survey
// (ScoreTester::difference). The simulation's noise is left out: it can have more light, too.
Separation separation(const Survey& survey, const std::vector<Axis>& axes, const Eigen::VectorXd& difference,
                      const std::string& effect, const std::string& other);

}  // namespace floe
