#include "edge/pose_memory.h"

#include <cerrno>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <system_error>
#include <variant>

namespace ols {
namespace {

// A file that is not there is an empty memory. Throws std::system_error.
RememberedPose read(const std::string& file) {
  errno = 0;
  std::ifstream stream(file);
  if (!stream && errno == ENOENT) return {};
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad()) {
    throw std::system_error(errno == 0 ? EIO : errno, std::generic_category());
  }
  auto found = remembered_pose_from(text);
  if (const auto* wrong = std::get_if<std::string>(&found)) throw std::runtime_error(*wrong);
  return std::get<RememberedPose>(found);
}

}  // namespace

PoseMemory::PoseMemory(const std::string& file) : file_(file) {
  if (file.empty()) return;
  try {
    found_ = read(file);
  } catch (const std::exception& failure) {
    refused_ = "the kept one is refused, " + file + ": " + failure.what();
  }
}

void PoseMemory::keep(RememberedPose pose) {
  if (!pose.position && !pose.tilt) return;
  if (!pose.position) pose.position = found_.position;
  if (!pose.tilt) pose.tilt = found_.tilt;
  refused_.clear();
  file_.write(to_text(pose));
}

std::string PoseMemory::trouble() const {
  if (!refused_.empty()) return refused_;
  const std::string failed = file_.trouble();
  return failed.empty() ? "" : "not kept, " + failed;
}

}  // namespace ols
