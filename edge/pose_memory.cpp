#include "edge/pose_memory.h"

#include <cerrno>
#include <condition_variable>
#include <exception>
#include <fstream>
#include <iterator>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <variant>

#include "base/atomic_file.h"

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

void write(const std::string& file, const RememberedPose& pose) {
  AtomicFile out(file);
  out.stream() << to_text(pose);
  out.commit();
}

}  // namespace

struct PoseMemory::Shared {
  void run(const std::string& file) {
    std::unique_lock lock(mutex);
    for (;;) {
      wake.wait(lock, [this] { return end || waiting; });
      if (!waiting) return;
      const RememberedPose pose = *std::exchange(waiting, std::nullopt);
      lock.unlock();
      std::string failed;
      try {
        write(file, pose);
      } catch (const std::exception& failure) {
        failed = std::string("not kept, ") + failure.what();
      }
      lock.lock();
      trouble = failed;
    }
  }

  std::mutex mutex;  // of everything below
  std::condition_variable wake;
  bool end = false;
  std::optional<RememberedPose> waiting;
  std::string trouble;
};

PoseMemory::PoseMemory(const std::string& file) : shared_(std::make_shared<Shared>()) {
  if (file.empty()) return;
  try {
    found_ = read(file);
  } catch (const std::exception& failure) {
    shared_->trouble = "the kept one is refused, " + file + ": " + failure.what();
  }
  // Detached: who waits for a disk that hangs would never end.
  std::thread([shared = shared_, file] { shared->run(file); }).detach();
}

PoseMemory::~PoseMemory() {
  const std::lock_guard lock(shared_->mutex);
  shared_->end = true;
  shared_->wake.notify_all();
}

void PoseMemory::keep(RememberedPose pose) {
  if (!pose.position && !pose.tilt) return;
  if (!pose.position) pose.position = found_.position;
  if (!pose.tilt) pose.tilt = found_.tilt;
  const std::lock_guard lock(shared_->mutex);
  shared_->waiting = pose;
  shared_->wake.notify_all();
}

std::string PoseMemory::trouble() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->trouble;
}

}  // namespace ols
