#include "apps/model_json.h"

namespace floe {

Json to_json(const ModelRequest& request) {
  Json json = {{"ice", request.ice}};
  json["ice_version"] = request.ice_version ? Json(*request.ice_version) : Json();
  json["detector"] = request.detector ? Json(*request.detector) : Json();
  json["without"] = request.without;
  json["with"] = texts_of(request.with);
  return json;
}

Json to_json(const Model& model) {
  return {{"ice", {{"name", model.ice->name()}, {"hash", model.ice->hash()}}},
          {"detector", {{"name", model.detector->name()}, {"hash", model.detector->hash()}}}};
}

}  // namespace floe
