#include "edge/process/pose_store.h"

#include <exception>
#include <stdexcept>
#include <string>
#include <system_error>
#include <variant>

#include "base/files/small_file.h"
#include "conditions/alarms.h"

namespace ols::station {
namespace {

// A missing file gives an empty pose. Throws std::system_error.
sensors::PersistedPose read(const std::string& file) {
  constexpr std::size_t kMost = 16384;  // [byte]
  try {
    auto found = sensors::persisted_pose_from(read_small_file(file, kMost));
    if (const auto* wrong = std::get_if<std::string>(&found)) {
      throw std::runtime_error(file + ": " + *wrong);
    }
    return std::get<sensors::PersistedPose>(found);
  } catch (const std::system_error& failure) {
    if (failure.code() == std::errc::no_such_file_or_directory) return {};
    throw;
  }
}

}  // namespace

PoseStore::PoseStore(const std::string& file) : file_(file) {
  if (file.empty()) return;
  try {
    found_ = read(file);
  } catch (const std::exception& failure) {
    refused_ = alarm::saved_pose_refused(failure.what());
  }
}

void PoseStore::keep(sensors::PersistedPose pose) {
  if (!pose.position && !pose.tilt) return;
  if (!pose.position) pose.position = found_.position;
  if (!pose.tilt) pose.tilt = found_.tilt;
  refused_ = {};
  file_.write(to_text(pose));
}

Alarm PoseStore::trouble() const {
  if (!refused_.empty()) return refused_;
  const std::string failed = file_.trouble();
  return failed.empty() ? Alarm() : alarm::pose_unsaved(failed);
}

}  // namespace ols::station
