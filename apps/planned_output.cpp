#include "apps/planned_output.h"

#include <fstream>

#include "data/base/error.h"

namespace floe {

PlannedOutput::PlannedOutput(const std::optional<std::string>& file) {
  if (file) file_.emplace(*file);
}

void PlannedOutput::write(std::string_view content) {
  if (!file_) return;
  std::ofstream stream(file_->temporary(), std::ios::binary);
  stream << content;
  stream.close();
  if (!stream) throw OutputError(file_->temporary().string() + ": could not be written; is the disk full?");
  written_ = true;
}

void PlannedOutput::commit() {
  if (written_) file_->commit();
}

std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string json_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void say_why_no_result(const std::optional<std::string>& json, const std::function<void()>& work) {
  try {
    work();
  } catch (const NoResult& error) {
    PlannedOutput file(json);
    file.write(json_text({{"status", "no_result"}, {"reason", error.what()}}));
    file.commit();
    throw;
  }
}

}  // namespace floe
