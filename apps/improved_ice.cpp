#include "apps/improved_ice.h"

#include <fmt/format.h>

#include <system_error>

#include "data/base/atomic_file.h"
#include "data/base/error.h"

namespace floe {

namespace fs = std::filesystem;

namespace {

void copy_base(const ModelRequest& request, const fs::path& folder) {
  if (!fs::is_directory(request.ice)) return;  // built in
  std::error_code problem;
  fs::copy(request.ice, folder, fs::copy_options::recursive, problem);
  if (problem)
    throw OutputError(fmt::format("{}: cannot be written: {}", folder.string(), problem.message()));
}

}  // namespace

void write_improved_ice(const ModelRequest& request, const Model& improved, const EffectGroups& beside_ice,
                        const std::string& changes, const fs::path& folder) {
  copy_base(request, folder);
  std::error_code ignored;
  fs::create_directory(folder, ignored);
  write_ice_tables(improved.ice->tables(), folder);
  write_whole_file(folder / "CHANGES.txt", changes);
  EffectGroups groups = read_effects_file(folder);  // of the base
  groups.insert(groups.end(), beside_ice.begin(), beside_ice.end());
  if (!groups.empty()) write_whole_file(folder / effects_file, effects_file_text(groups));
}

}  // namespace floe
