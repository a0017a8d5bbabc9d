#include "base/files/background_file.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "base/files/atomic_file.h"
#include "base/files/small_file.h"

namespace ols {
namespace {

constexpr std::chrono::seconds kAgain{3};
constexpr std::chrono::seconds kLook{2};  // between two checks of the file
constexpr std::chrono::seconds kLast{1};  // for a pending write at the end

// Throws std::system_error.
void put(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

bool holds(const std::string& path, const std::string& text) {
  try {
    return read_small_file(path, text.size()) == text;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

struct BackgroundFile::Shared {
  void run(const std::string& path) {
    std::unique_lock lock(mutex);
    std::optional<std::string> kept;
    while (wait(lock, kept)) {
      const bool last = end;
      const bool look = !waiting;
      const std::string text = look ? *kept : *std::exchange(waiting, std::nullopt);
      const std::uint64_t number = written;
      lock.unlock();
      std::string failed;
      try {
        if (!look || !holds(path, text)) put(path, text);
      } catch (const std::exception& failure) {
        failed = failure.what();
      }
      lock.lock();
      trouble = failed;
      kept = text;
      if (failed.empty()) stored = number;
      if (!failed.empty() && !waiting) waiting = text;
      if (!failed.empty() && last) break;
      done.notify_all();
    }
    ended = true;
    done.notify_all();
  }

  // Waits until there is something to write or to check; longer after a failure. False: the end.
  bool wait(std::unique_lock<std::mutex>& lock, const std::optional<std::string>& kept) {
    if (!trouble.empty()) {
      wake.wait_for(lock, kAgain, [this, before = written] { return end || written != before; });
    }
    const auto is_due = [this] { return end || waiting; };
    if (!kept) {
      wake.wait(lock, is_due);
    } else if (!wake.wait_for(lock, kLook, is_due)) {
      return true;
    }
    return waiting.has_value();
  }

  std::mutex mutex;  // of everything below
  std::condition_variable wake, done;
  bool end = false, ended = false;
  std::uint64_t written = 0;  // calls of write()
  std::uint64_t stored = 0;   // the last of them that is in the file
  std::optional<std::string> waiting;
  std::string trouble;
};

BackgroundFile::BackgroundFile(const std::string& path) : shared_(std::make_shared<Shared>()) {
  shared_->ended = path.empty();
  if (path.empty()) return;
  // Detached: joining a thread that waits for a hanging disk would never return.
  std::thread([shared = shared_, path] { shared->run(path); }).detach();
}

BackgroundFile::~BackgroundFile() {
  std::unique_lock lock(shared_->mutex);
  shared_->end = true;
  shared_->wake.notify_all();
  shared_->done.wait_for(lock, kLast, [this] { return shared_->ended; });
}

void BackgroundFile::write(const std::string& text) {
  const std::lock_guard lock(shared_->mutex);
  if (shared_->ended) return;
  shared_->waiting = text;
  ++shared_->written;
  shared_->wake.notify_all();
}

bool BackgroundFile::is_written(double wait_s) const {
  std::unique_lock lock(shared_->mutex);
  const auto is_stored = [this] {
    return shared_->stored == shared_->written && shared_->trouble.empty();
  };
  shared_->done.wait_for(lock, std::chrono::duration<double>(wait_s),
                         [&] { return is_stored() || !shared_->trouble.empty(); });
  return is_stored();
}

std::string BackgroundFile::trouble() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->trouble;
}

}  // namespace ols
