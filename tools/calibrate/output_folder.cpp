#include "tools/calibrate/output_folder.h"

#include <atomic>
#include <stdexcept>

#include "base/files/atomic_file.h"

namespace ols::calibration {
namespace {

namespace fs = std::filesystem;

fs::path partial_of(const fs::path& folder) { return folder.string() + ".partial"; }

std::array<std::atomic<bool>, SignalsWait::kSignals.size()> waiting{};
static_assert(std::atomic<bool>::is_always_lock_free);

void note(int signal) {
  for (std::size_t i = 0; i < waiting.size(); ++i) {
    if (SignalsWait::kSignals[i] == signal) waiting[i] = true;
  }
}

}  // namespace

// A mask would hold the signals back from this thread only: any other would take them, even
// OpenCV's.
SignalsWait::SignalsWait() {
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], &action, &before_[i]);
  }
}

SignalsWait::~SignalsWait() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], &before_[i], nullptr);
    if (waiting[i].exchange(false)) ::raise(kSignals[i]);
  }
}

fs::path checked_folder(const std::string& output) {
  if (output.empty()) throw std::invalid_argument("--output: is empty");
  // Without links and a slash at the end: the name that a rename needs.
  fs::path folder = fs::weakly_canonical(output);
  if (!folder.has_filename()) folder = folder.parent_path();
  if (fs::exists(partial_of(folder))) {
    throw std::invalid_argument("--output: " + partial_of(folder).string() +
                                " exists: remove what an interrupted run has left");
  }
  if (!fs::exists(folder)) return folder;
  if (!fs::is_directory(folder)) {
    throw std::invalid_argument("--output: " + output + " is not a folder");
  }
  if (!fs::is_empty(folder)) {
    throw std::invalid_argument("--output: " + output +
                                " is not empty: a calibration is never overwritten");
  }
  return folder;
}

void write_folder(const fs::path& folder, const std::vector<OutputFile>& files) {
  const SignalsWait wait;
  const fs::path partial = partial_of(folder);
  if (folder.has_parent_path()) fs::create_directories(folder.parent_path());
  if (!fs::create_directory(partial)) throw std::runtime_error(partial.string() + ": exists");
  try {
    for (const OutputFile& one : files) {
      const fs::path path = partial / one.name;
      fs::create_directories(path.parent_path());
      AtomicFile file(path.string());
      file.stream() << one.text;
      file.commit();
    }
    fs::rename(partial, folder);
  } catch (const std::exception&) {
    std::error_code ignored;
    fs::remove_all(partial, ignored);
    throw;
  }
}

}  // namespace ols::calibration
