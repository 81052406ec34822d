// The least that a scatter can cost on a machine: what its random numbers, its special functions and its
// memory traffic take by themselves.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace floe {

// An ingredient of a scatter in birefringent ice and how often it occurs; its cost is that of the benchmark
// of this name.
struct Ingredient {
  std::string name;
  double count;
  std::string where;
};
const std::vector<Ingredient>& scatter_ingredients();

// A table of the ingredients' costs, their sum, and how far above it `measured` is; costs and `measured` in
// ns per lane. Throws std::out_of_range when a cost is missing.
std::string scatter_bound_table(const std::map<std::string, double>& costs, double measured);

}  // namespace floe
