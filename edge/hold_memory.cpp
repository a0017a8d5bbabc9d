#include "edge/hold_memory.h"

#include <exception>
#include <filesystem>
#include <fstream>
#include <utility>

#include "base/atomic_file.h"

namespace ols {
namespace {

constexpr const char* kStoppedWord = "stopped";
constexpr const char* kEmergencyWord = "emergency";

}  // namespace

Hold hold_of(StationState state) {
  switch (state) {
    case StationState::kEmergency:
      return Hold::kEmergency;
    case StationState::kStopped:
    case StationState::kManual:
      return Hold::kStopped;
    default:
      return Hold::kNone;
  }
}

HoldMemory::HoldMemory(std::string file) : file_(std::move(file)) {
  if (file_.empty()) return;
  try {
    read();
  } catch (const std::exception& failure) {
    hold_ = Hold::kEmergency;
    trouble_ = failure.what();
  }
}

void HoldMemory::read() {
  if (!std::filesystem::exists(file_)) return;
  std::string word;
  std::getline(std::ifstream(file_), word);
  hold_ = word == kStoppedWord ? Hold::kStopped : Hold::kEmergency;
  if (word != kStoppedWord && word != kEmergencyWord) trouble_ = file_ + ": cannot be read";
}

void HoldMemory::set(Hold hold) {
  if (hold == hold_) return;
  hold_ = hold;
  if (file_.empty()) return;
  try {
    write();
    trouble_.clear();
  } catch (const std::exception& failure) {
    trouble_ = failure.what();
  }
}

void HoldMemory::write() const {
  if (hold_ == Hold::kNone) {
    std::filesystem::remove(file_);
    return;
  }
  AtomicFile file(file_);
  file.stream() << (hold_ == Hold::kStopped ? kStoppedWord : kEmergencyWord) << '\n';
  file.commit();
}

}  // namespace ols
