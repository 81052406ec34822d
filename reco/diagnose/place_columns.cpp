#include "reco/diagnose/place_columns.h"

#include <map>

namespace floe {

namespace {

using Kind = SurveyColumn::Kind;

// Light by string and by module over all runs, as counts of the data.
struct LightByPlace {
  std::map<int, double> strings;
  std::map<ModuleId, double> modules;
};
LightByPlace light_by_place(const std::vector<SurveyRun>& runs, const Detector& detector) {
  LightByPlace light;
  for (const SurveyRun& run : runs)
    for (const RunBins::Receiver& receiver : run.bins.receivers()) {
      const ModuleId id = detector.modules()[receiver.module].id;
      const double counts = run.expected.segment(receiver.first, receiver.bins()).sum();
      light.strings[id.string] += counts;
      light.modules[id] += counts;
    }
  return light;
}

}  // namespace

std::vector<SurveyColumn> place_columns(const std::vector<SurveyRun>& runs, const Detector& detector) {
  const LightByPlace light = light_by_place(runs, detector);
  std::vector<SurveyColumn> columns;
  for (const auto& [string, counts] : light.strings) {
    if (counts < light_of_string) continue;
    for (const Kind kind :
         {Kind::string_efficiency, Kind::string_time, Kind::string_x, Kind::string_y, Kind::string_z})
      columns.push_back({kind, 0, string, 0});
  }
  for (const auto& [id, counts] : light.modules)
    if (counts >= light_of_module) columns.push_back({Kind::module_efficiency, 0, id.string, id.dom});
  return columns;
}

bool is_displacement(SurveyColumn::Kind kind) {
  return kind == Kind::string_x || kind == Kind::string_y || kind == Kind::string_z;
}

Eigen::VectorXd place_slope(const SurveyColumn& column, const SurveyRun& run, const PlaceSlopes& slopes,
                            const Detector& detector) {
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(run.bins.size());
  const bool own_string = run.data.run.module.string == column.string;
  for (const RunBins::Receiver& receiver : run.bins.receivers()) {
    const ModuleId id = detector.modules()[receiver.module].id;
    auto of_receiver = slope.segment(receiver.first, receiver.bins());
    const bool here = id.string == column.string;
    switch (column.kind) {
      case Kind::parameter:
        break;
      case Kind::module_efficiency:
        if (here && id.dom == column.dom) of_receiver.setOnes();
        break;
      case Kind::string_efficiency:
        if (here) of_receiver.setOnes();
        break;
      case Kind::string_time:
        if (here) of_receiver = slopes.delay.segment(receiver.first, receiver.bins());
        break;
      case Kind::string_x:
      case Kind::string_y:
      case Kind::string_z: {
        const int axis = static_cast<int>(column.kind) - static_cast<int>(Kind::string_x);
        const auto moved = slopes.displacement.col(axis).segment(receiver.first, receiver.bins());
        // With the flasher's own string, all others move the other way for it.
        if (own_string && !here) of_receiver = -moved;
        if (!own_string && here) of_receiver = moved;
        break;
      }
    }
  }
  return slope;
}

}  // namespace floe
