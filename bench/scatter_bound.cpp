#include "bench/scatter_bound.h"

#include <fmt/format.h>

#include "apps/text_table.h"

namespace floe {

const std::vector<Ingredient>& scatter_ingredients() {
  // Counted in engine/lane_steps.cpp. 1/sqrt counts as a square root; constants are divided by beforehand.
  static const std::vector<Ingredient> ingredients{
      {"random number", 7, "depth 1, birefringence 4, angle 2"},
      {"logarithm", 4, "depth 1, birefringence 2, angle 1"},
      {"exponential", 1, "angle 1"},
      {"sine and cosine", 3, "birefringence 2, angle 1"},
      {"square root", 7, "absorption 1, birefringence 4, angle 2"},
      {"division", 8, "layer 3, birefringence 3, angle 2"},
      {"table look-up", 2, "clearance 2"},
      {"row of a table", 2, "layer 1, birefringence 1"},
      {"load and store", 22, "each quantity that changes, once"}};
  return ingredients;
}

std::string scatter_bound_table(const std::map<std::string, double>& costs, double measured) {
  TextTable table({"ingredient", "times", "ns each", "ns", "where"});
  double sum = 0;
  for (const Ingredient& ingredient : scatter_ingredients()) {
    const double cost = costs.at(ingredient.name);
    sum += ingredient.count * cost;
    table.add({ingredient.name, fmt::format("{:.0f}", ingredient.count), fmt::format("{:.3f}", cost),
               fmt::format("{:.2f}", ingredient.count * cost), ingredient.where});
  }
  table.add({"bound", "", "", fmt::format("{:.2f}", sum), ""});
  table.add(
      {"measured", "", "", fmt::format("{:.2f}", measured), fmt::format("{:.2f} x bound", measured / sum)});
  return table.str();
}

}  // namespace floe
