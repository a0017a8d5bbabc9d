// The destination of an output's packets. put() never waits, so that a slow, lost or hostile
// receiver does not delay the other outlets.
#pragma once

#include <cstdint>
#include <string>

#include "export/encoder.h"

namespace ols::exports {

struct OutletReport {
  bool is_open = false;
  std::string trouble{};         // why the outlet is not open, or its last failure; empty: no
                                 // trouble
  std::uint64_t sent = 0;        // packets sent to the receiver
  std::uint64_t bytes = 0;       // bytes of these packets
  std::uint64_t displaced = 0;   // packets replaced by newer ones, or dropped, before they were
                                 // sent
  std::uint64_t failures = 0;    // connections that failed or broke; datagrams or files that failed
  std::uint64_t openings = 0;    // connections made
  std::uint64_t complaints = 0;  // messages that the receiver has reported as wrong
};

class Outlet {
 public:
  virtual ~Outlet() = default;
  virtual void put(Packets packets) = 0;
  virtual OutletReport report() const = 0;
};

}  // namespace ols::exports
