#include "apps/study_rows.h"

#include <limits>

namespace floe {
namespace {

double number_of(const Json& json) {  // what is not finite is written as null
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

Json vector_json(const CascadeParameters& cascade) {
  Json json = Json::array();
  for (const double value : to_vector(cascade)) json.push_back(value);
  return json;
}

CascadeParameters cascade_of_json(const Json& json) {
  return {{number_of(json.at(0)), number_of(json.at(1)), number_of(json.at(2))},
          number_of(json.at(3)),
          number_of(json.at(4)),
          number_of(json.at(5)),
          number_of(json.at(6))};
}

Json matrix_json(const Matrix7& matrix) {
  Json json = Json::array();
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 7; ++j) json.push_back(matrix(i, j));
  return json;
}

Matrix7 matrix_of(const Json& json) {
  Matrix7 matrix;
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 7; ++j) matrix(i, j) = number_of(json.at(static_cast<std::size_t>(7 * i + j)));
  return matrix;
}

Json fit_of(const StudyFit& fit) {
  Json json = {{"status", name_of(fit.status)},
               {"reason", fit.reason},
               {"cascade", vector_json(fit.cascade)},
               {"covariance", matrix_json(fit.covariance)},
               {"neg_llh", fit.neg_llh},
               {"ndof", fit.ndof},
               {"p_value", fit.p_value},
               {"photons", fit.photons},
               {"seconds", fit.seconds}};
  if (const auto& other = fit.other_minimum)
    json["other_minimum"] = {{"cascade", vector_json(other->cascade)},
                             {"delta_neg_llh", other->delta_neg_llh},
                             {"delta_neg_llh_error", other->delta_neg_llh_error}};
  return json;
}

FitStatus status_of(const std::string& name) {
  for (const FitStatus status : {FitStatus::ok, FitStatus::track_like, FitStatus::outside,
                                 FitStatus::no_convergence, FitStatus::not_enough_light})
    if (name_of(status) == name) return status;
  throw Json::other_error::create(501, "unknown status " + name, nullptr);
}

StudyFit study_fit_of(const Json& json) {
  StudyFit fit;
  fit.status = status_of(json.at("status").get<std::string>());
  fit.reason = json.at("reason").get<std::string>();
  fit.cascade = cascade_of_json(json.at("cascade"));
  fit.covariance = matrix_of(json.at("covariance"));
  fit.neg_llh = number_of(json.at("neg_llh"));
  fit.ndof = number_of(json.at("ndof"));
  fit.p_value = number_of(json.at("p_value"));
  fit.photons = json.at("photons").get<std::uint64_t>();
  fit.seconds = number_of(json.at("seconds"));
  if (json.contains("other_minimum")) {
    const Json& other = json.at("other_minimum");
    fit.other_minimum =
        OtherMinimum{cascade_of_json(other.at("cascade")), number_of(other.at("delta_neg_llh")),
                     number_of(other.at("delta_neg_llh_error"))};
  }
  return fit;
}

}  // namespace

Json to_json(const StudyRow& row) {
  Json json = {{"energy", row.energy},           {"index", row.index},     {"truth", vector_json(row.truth)},
               {"charge", row.charge},           {"modules", row.modules}, {"fit", fit_of(row.fit)},
               {"bound", matrix_json(row.bound)}};
  if (row.other) {
    json["other"] = fit_of(*row.other);
    json["delta_neg_llh"] = row.delta_neg_llh;
    json["delta_neg_llh_error"] = row.delta_neg_llh_error;
  }
  return json;
}

StudyRow study_row_of(const Json& json) {
  StudyRow row;
  row.energy = json.at("energy").get<double>();
  row.index = json.at("index").get<int>();
  row.truth = cascade_of_json(json.at("truth"));
  row.charge = json.at("charge").get<double>();
  row.modules = json.at("modules").get<std::size_t>();
  row.fit = study_fit_of(json.at("fit"));
  row.bound = matrix_of(json.at("bound"));
  if (json.contains("other")) {
    row.other = study_fit_of(json.at("other"));
    row.delta_neg_llh = number_of(json.at("delta_neg_llh"));
    row.delta_neg_llh_error = number_of(json.at("delta_neg_llh_error"));
  }
  return row;
}

}  // namespace floe
