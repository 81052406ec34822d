#include "apps/blind_trial_rows.h"

namespace floe {
namespace {

// An array: an object would not keep their order.
Json values_json(const HiddenEffect& hidden) {
  Json values = Json::array();
  for (const auto& [name, value] : hidden.values) values.push_back({{"name", name}, {"value", value}});
  return values;
}

Json hidden_json(const HiddenEffect& hidden) {
  return {{"effect", hidden.effect},
          {"text", hidden.text},
          {"place", hidden.place},
          {"values", values_json(hidden)},
          {"expected_significance", hidden.significance}};
}

HiddenEffect hidden_of(const Json& json) {
  HiddenEffect hidden{json.at("effect"),
                      json.at("text"),
                      {},
                      json.at("expected_significance"),
                      json.at("place").get<Place>()};
  for (const Json& value : json.at("values")) hidden.values.emplace_back(value.at("name"), value.at("value"));
  return hidden;
}

Json named_json(const NamedInTrial& named) {
  return {{"effect", named.effect}, {"text", named.text}, {"place", named.place}, {"group", named.group}};
}

NamedInTrial named_of(const Json& json) {
  return {json.at("effect"), json.at("text"), json.at("place").get<Place>(),
          json.at("group").get<std::vector<std::string>>()};
}

}  // namespace

Json to_json(const BlindTrial& trial) {
  return {{"hidden", hidden_json(trial.hidden)},
          {"p_value", trial.p_value},
          {"named", named_json(trial.named)},
          {"significance", trial.significance},
          {"found", trial.found},
          {"errors", trial.errors},
          {"right", trial.right()}};
}

BlindTrial blind_trial_of(const Json& json) {
  BlindTrial trial;
  trial.hidden = hidden_of(json.at("hidden"));
  trial.p_value = json.at("p_value");
  trial.named = named_of(json.at("named"));
  trial.significance = json.at("significance");
  trial.found = json.at("found").get<std::vector<double>>();
  trial.errors = json.at("errors").get<std::vector<double>>();
  return trial;
}

Json to_json(const FullTrial& trial) {
  Json hidden = Json::array(), named = Json::array(), values = Json::array();
  for (const HiddenEffect& effect : trial.hidden) hidden.push_back(hidden_json(effect));
  for (const NamedInTrial& effect : trial.named) named.push_back(named_json(effect));
  for (const FullTrial::Value& value : trial.values)
    values.push_back(
        {{"name", value.name}, {"hidden", value.hidden}, {"found", value.found}, {"error", value.error}});
  return {{"hidden", hidden},         {"outside", trial.outside},
          {"verdict", trial.verdict}, {"named", named},
          {"values", values},         {"closed", trial.closed ? Json(*trial.closed) : Json()},
          {"remarks", trial.remarks}, {"seconds", trial.seconds},
          {"right", trial.right()}};
}

Json sealed_json(std::span<const HiddenEffect> trials, std::span<const std::vector<HiddenEffect>> full) {
  Json json = {{"trials", Json::array()}, {"full", Json::array()}};
  for (const HiddenEffect& hidden : trials) json["trials"].push_back(hidden_json(hidden));
  for (const std::vector<HiddenEffect>& all : full) {
    json["full"].push_back(Json::array());
    for (const HiddenEffect& hidden : all) json["full"].back().push_back(hidden_json(hidden));
  }
  return json;
}

FullTrial full_trial_of(const Json& json) {
  FullTrial trial;
  for (const Json& hidden : json.at("hidden")) trial.hidden.push_back(hidden_of(hidden));
  trial.outside = json.at("outside");
  trial.verdict = json.at("verdict").get<std::vector<std::string>>();
  for (const Json& named : json.at("named")) trial.named.push_back(named_of(named));
  for (const Json& value : json.at("values"))
    trial.values.push_back({value.at("name"), value.at("hidden"), value.at("found"), value.at("error")});
  if (const Json& closed = json.at("closed"); !closed.is_null()) trial.closed = closed.get<double>();
  trial.remarks = json.at("remarks").get<std::vector<std::string>>();
  trial.seconds = json.at("seconds");
  return trial;
}

}  // namespace floe
