#include <embree3/rtcore.h>

#include <stdexcept>

#include "data/base/constants.h"
#include "geometry/crossing_order.h"
#include "geometry/module_scene.h"

namespace floe {

namespace {

// Embree works in single precision: its discs are larger than the modules by this much [m], and the
// exact rule decides about what they find.
constexpr float tolerance = 5e-3F;

// What the filter function needs to know of a query; Embree hands the base back to it.
struct Query : RTCIntersectContext {
  const std::vector<Vec3f>* centres;
  float oversize;
  Vec3f origin, direction;
  float length;
  std::vector<ModuleCrossing>* found;
};

// Called for every disc on the ray. Notes the module and rejects the hit, so that the ray goes on.
void collect(const RTCFilterFunctionNArguments* arguments) {
  const auto& query = *static_cast<const Query*>(arguments->context);
  const std::uint32_t module = RTCHitN_primID(arguments->hit, arguments->N, 0);
  ModuleCrossing crossing{module, 0, {}};
  if (cross_module((*query.centres)[module], query.oversize, query.origin, query.direction, query.length,
                   crossing))
    query.found->push_back(crossing);
  arguments->valid[0] = 0;
}

void throw_on_error(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE)
    throw std::runtime_error(fmt::format("Embree failed with error {}", static_cast<int>(error)));
}

class EmbreeFinder : public ModuleFinder {
 public:
  EmbreeFinder(const Detector& detector, double oversize)
      : oversize_(static_cast<float>(oversize)),
        radius_(static_cast<float>(oversize * module_radius) + tolerance) {
    for (const Module& module : detector.modules()) centres_.push_back(module.position.cast<float>());
    device_.reset(rtcNewDevice("threads=1"));
    throw_on_error(device_.get());
    scene_.reset(rtcNewScene(device_.get()));
    add_discs();
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(scene_.get());
    throw_on_error(device_.get());
  }

  void find(const Vec3f& origin, const Vec3f& direction, float length,
            std::vector<ModuleCrossing>& found) const override {
    Query query;
    rtcInitIntersectContext(&query);
    query.centres = &centres_;
    query.oversize = oversize_;
    query.origin = origin;
    query.direction = direction;
    query.length = length;
    query.found = &found;
    const std::size_t before = found.size();
    RTCRay ray = extended_ray(origin, direction, length);
    rtcOccluded1(scene_.get(), &query, &ray);
    sort_crossings(found, before);
  }

 private:
  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };

  void add_discs() {
    RTCGeometry discs = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_DISC_POINT);
    auto* corner = static_cast<float*>(rtcSetNewGeometryBuffer(
        discs, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), centres_.size()));
    if (corner)
      for (const Vec3f& centre : centres_) {
        for (const float x : centre) *corner++ = x;
        *corner++ = radius_;
      }
    rtcSetGeometryOccludedFilterFunction(discs, collect);
    rtcCommitGeometry(discs);
    rtcAttachGeometry(scene_.get(), discs);
    rtcReleaseGeometry(discs);
    throw_on_error(device_.get());
  }

  // Embree answers where the ray passes closest to the centre, up to a module's radius after the photon
  // has landed; and it passes over discs nearer to the ray's start than twice their radius. So the ray
  // starts earlier and ends later than the segment.
  RTCRay extended_ray(const Vec3f& origin, const Vec3f& direction, float length) const {
    const float lead = 2.1F * radius_;
    RTCRay ray{};
    const Vec3f start = origin - lead * direction;
    ray.org_x = start.x(), ray.org_y = start.y(), ray.org_z = start.z();
    ray.dir_x = direction.x(), ray.dir_y = direction.y(), ray.dir_z = direction.z();
    ray.tnear = lead - tolerance;
    ray.tfar = lead + length + static_cast<float>(module_radius) + tolerance;
    ray.mask = ~0U;
    return ray;
  }

  float oversize_, radius_;
  std::vector<Vec3f> centres_;
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> scene_;
};

}  // namespace

std::unique_ptr<ModuleFinder> make_embree_finder(const Detector& detector, double oversize) {
  check_oversize(oversize);
  return std::make_unique<EmbreeFinder>(detector, oversize);
}

}  // namespace floe
