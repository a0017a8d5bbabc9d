// Reads a SAPIENT receiver's messages, and answers them. Ignores alerts and other messages that are
// not meant for us. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "export/sapient/sapient_node.h"

namespace ols::exports {

class SapientDialogue {
 public:
  explicit SapientDialogue(SapientSettings settings) : settings_(std::move(settings)) {}

  // Takes received bytes, in pieces of any size; returns the answers. Throws std::runtime_error,
  // with the reason in words for a person, if the bytes are not SAPIENT.
  std::vector<std::string> take(std::string_view bytes, std::int64_t utime_us);
  // Call when the connection starts again.
  void clear();

  // The receiver's answer to our registration; nullopt: none yet.
  std::optional<bool> acceptance() const { return acceptance_; }
  const std::string& refusal() const { return refusal_; }   // why our registration was refused
  std::uint64_t complaints() const { return complaints_; }  // only increases
  const std::string& last_complaint() const { return complaint_; }

  static constexpr std::size_t kLongest_bytes = 1 << 20;

 private:
  void read(const std::string& message, std::int64_t utime_us, std::vector<std::string>& answers);

  SapientSettings settings_;
  std::string bytes_;
  std::optional<bool> acceptance_;
  std::string refusal_;
  std::uint64_t complaints_ = 0;
  std::string complaint_;
};

}  // namespace ols::exports
