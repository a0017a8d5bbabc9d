// Where an output's packets go. Never waits: whoever fills several outlets must not feel that one
// receiver is slow, gone or hostile.
#pragma once

#include <cstdint>
#include <string>

#include "export/encoder.h"

namespace ols::exports {

struct OutletReport {
  bool is_open = false;
  std::string trouble{};         // why it is not, or what failed last; empty: nothing
  std::uint64_t sent = 0;        // packets handed over
  std::uint64_t bytes = 0;       // of them
  std::uint64_t displaced = 0;   // replaced by newer ones or given up before they were sent
  std::uint64_t failures = 0;    // connections that failed or broke; of a datagram or a file, each
  std::uint64_t openings = 0;    // connections that were made
  std::uint64_t complaints = 0;  // messages that the receiver has called wrong
};

class Outlet {
 public:
  virtual ~Outlet() = default;
  virtual void put(Packets packets) = 0;
  virtual OutletReport report() const = 0;
};

}  // namespace ols::exports
