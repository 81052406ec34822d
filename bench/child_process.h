// Work in processes of its own: what it cost is then known apart from everything else.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace floe {

using Json = nlohmann::ordered_json;

struct ProcessCost {
  double cpu_seconds = 0;  // user and system
  double wall_seconds = 0;
  double peak_megabytes = 0;  // resident
};

struct ChildResult {
  Json result;
  ProcessCost cost;
};

// A piece of work; it calls `ready` when its preparations are done, waits there until all pieces are, and
// returns what it found.
using ChildWork = std::function<Json(const std::function<void()>& ready)>;

// Does the pieces of work side by side, each in a fork of this process, which must have one thread only.
// Throws Error with the child's message when one fails.
std::vector<ChildResult> run_in_children(const std::vector<ChildWork>& work);
ChildResult run_in_child(const std::function<Json()>& work);

struct CommandResult {
  std::string printed;  // standard output and standard error, as they came
  ProcessCost cost;
};
// Runs `sh -c command` with nothing on its standard input and waits for it. Throws Error with the last lines
// that it printed when its exit code is not 0.
CommandResult run_command(const std::string& command);

}  // namespace floe
