#include "geometry/crossing_order.h"
#include "geometry/module_scene.h"

namespace floe {

namespace {

class ExhaustiveFinder : public ModuleFinder {
 public:
  ExhaustiveFinder(const Detector& detector, double oversize) : oversize_(static_cast<float>(oversize)) {
    for (const Module& module : detector.modules()) centres_.push_back(module.position.cast<float>());
  }

  void find(const Vec3f& origin, const Vec3f& direction, float length,
            std::vector<ModuleCrossing>& found) const override {
    const std::size_t before = found.size();
    for (std::uint32_t module = 0; module < centres_.size(); ++module) {
      ModuleCrossing crossing{module, 0, {}};
      if (cross_module(centres_[module], oversize_, origin, direction, length, crossing))
        found.push_back(crossing);
    }
    sort_crossings(found, before);
  }

 private:
  std::vector<Vec3f> centres_;
  float oversize_;
};

}  // namespace

std::unique_ptr<ModuleFinder> make_exhaustive_finder(const Detector& detector, double oversize) {
  check_oversize(oversize);
  return std::make_unique<ExhaustiveFinder>(detector, oversize);
}

}  // namespace floe
