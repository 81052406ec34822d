#include "apps/improved_ice.h"

#include <fmt/format.h>

#include <system_error>

#include "data/base/atomic_file.h"
#include "data/base/error.h"

namespace floe {

namespace fs = std::filesystem;

namespace {

void expect_none(const std::error_code& problem, const fs::path& path) {
  if (problem) throw OutputError(fmt::format("{}: cannot be written: {}", path.string(), problem.message()));
}

// Settings in a row of one effect belong together.
EffectGroups groups_of(const std::vector<EffectSetting>& settings) {
  EffectGroups groups;
  for (const EffectSetting& setting : settings) {
    if (groups.empty() || groups.back().front().effect != setting.effect) groups.emplace_back();
    groups.back().push_back(setting);
  }
  return groups;
}

// Of the base's floe.toml and --with, what does not change ice: all else is in the improved tables, and would
// be there twice.
EffectGroups beside_ice_of(const ModelRequest& base) {
  EffectGroups groups;
  if (fs::is_directory(base.ice)) groups = read_effects_file(base.ice);
  const EffectGroups with = groups_of(base.with);
  groups.insert(groups.end(), with.begin(), with.end());
  if (groups.empty()) return groups;
  const Model bare = load_without_effects(base);
  std::erase_if(groups, [&](const auto& group) { return changes_ice(group, bare); });
  return groups;
}

}  // namespace

void copy_base_ice(const ModelRequest& base, const fs::path& folder) {
  std::error_code problem;
  fs::create_directory(folder, problem);
  expect_none(problem, folder);
  if (!fs::is_directory(base.ice)) return;  // built in
  for (const fs::directory_entry& entry : fs::directory_iterator(base.ice)) {
    if (!entry.is_regular_file()) continue;
    fs::copy_file(entry.path(), folder / entry.path().filename(), problem);
    expect_none(problem, folder / entry.path().filename());
  }
}

void write_improved_ice(const ModelRequest& base, const Model& improved, const EffectGroups& beside_ice,
                        const std::string& changes, const fs::path& folder) {
  write_ice_tables(improved.ice->tables(), folder);
  write_whole_file(folder / "CHANGES.txt", changes);
  EffectGroups groups = beside_ice_of(base);
  groups.insert(groups.end(), beside_ice.begin(), beside_ice.end());
  if (!groups.empty() || fs::exists(folder / effects_file))
    write_whole_file(folder / effects_file, effects_file_text(groups));
}

}  // namespace floe
