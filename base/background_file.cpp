#include "base/background_file.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "base/atomic_file.h"

namespace ols {
namespace {

constexpr std::chrono::seconds kAgain{3};
constexpr std::chrono::seconds kLast{1};  // for what is not written at the end

// Throws std::system_error.
void put(const std::string& path, const std::string& text) {
  if (text.empty()) {
    std::filesystem::remove(path);
    return;
  }
  AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

}  // namespace

struct BackgroundFile::Shared {
  void run(const std::string& path) {
    std::unique_lock lock(mutex);
    for (;;) {
      wake.wait(lock, [this] { return end || waiting; });
      if (!waiting) return;
      const std::string text = *std::exchange(waiting, std::nullopt);
      busy = true;
      lock.unlock();
      std::string failed;
      try {
        put(path, text);
      } catch (const std::exception& failure) {
        failed = failure.what();
      }
      lock.lock();
      busy = false;
      trouble = failed;
      done.notify_all();
      if (!failed.empty() && !retry(lock, text)) return;
    }
  }

  // After a pause, or at once when there is something newer. False at the end.
  bool retry(std::unique_lock<std::mutex>& lock, const std::string& text) {
    wake.wait_for(lock, kAgain, [this] { return end || waiting; });
    if (!waiting) waiting = text;
    return !end;
  }

  std::mutex mutex;  // of everything below
  std::condition_variable wake, done;
  bool end = false, busy = false;
  std::optional<std::string> waiting;
  std::string trouble;
};

BackgroundFile::BackgroundFile(const std::string& path) : shared_(std::make_shared<Shared>()) {
  if (path.empty()) return;
  // Detached: who waits for a disk that hangs would never end.
  std::thread([shared = shared_, path] { shared->run(path); }).detach();
}

BackgroundFile::~BackgroundFile() {
  std::unique_lock lock(shared_->mutex);
  shared_->end = true;
  shared_->wake.notify_all();
  const auto over = [this] { return !shared_->busy && !shared_->waiting; };
  shared_->done.wait_for(lock, kLast, over);
}

void BackgroundFile::write(const std::string& text) {
  const std::lock_guard lock(shared_->mutex);
  shared_->waiting = text;
  shared_->wake.notify_all();
}

std::string BackgroundFile::trouble() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->trouble;
}

}  // namespace ols
