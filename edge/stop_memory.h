// Remembers over a restart, or a loss of power, that the emergency stop awaits its rearming.
#pragma once

#include <string>

namespace ols {

class StopMemory {
 public:
  // `file` exists as long as it is pending; empty: nothing is remembered.
  explicit StopMemory(std::string file);

  // Whether a stop was pending when this was made, or is now.
  bool pending() const { return pending_; }
  // Writes only when it changes.
  void set(bool pending);

  // Why the file cannot be written; empty when all is well.
  const std::string& trouble() const { return trouble_; }

 private:
  std::string file_;
  bool pending_ = false;
  std::string trouble_;
};

}  // namespace ols
