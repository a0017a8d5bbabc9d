// The state of the bridge, for people and for programs. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bridge/passage.h"
#include "conditions/alarm.h"

namespace ols::bridge {

struct LinkStatus {
  bool is_open = false;
  std::string trouble;
  std::uint64_t openings = 0, losses = 0, sent = 0, unsent = 0, displaced = 0;
  std::uint64_t refusals = 0;
  std::string refusal;  // the server's last refusal
};

struct ArchiveStatus {
  bool is_wanted = false, is_kept = false;
  std::string trouble;
  std::uint64_t messages = 0, bytes = 0;
  std::vector<std::string> standing;  // sites whose live messages arrive, but whose stream is not
                                      // copied
};

struct OwnershipStatus {
  bool is_wanted = false, is_confirmed = true;
  std::size_t owned = 0, others = 0;
  std::uint64_t taken = 0, handed_over = 0, lost = 0;
  std::uint64_t epoch = 0;  // the greatest epoch of an owned target
  double delay_s = 0.0;     // from a request to the store's answer
};

struct BridgeStatus {
  std::int64_t utime_us = 0;
  std::size_t stations = 0;
  std::vector<Alarm> bus_alarms;
  std::map<std::string, double> bus_counters;
  LinkStatus link;
  ArchiveStatus archive;
  OwnershipStatus ownership;
  Counts out, in;
  std::uint64_t missing = 0, repeated = 0, unsent_to_bus = 0;
  std::uint64_t obeyed_epoch = 0;  // the greatest epoch of a command that came in
  std::string gap;                 // the stream with the last gap, if recent
  std::string late;                // the last live message that came in too late, if recent
};

// One alarm for each condition; empty if all is well.
std::vector<Alarm> alarms(const BridgeStatus& status);
// "connected; out 120, in 3; 2 refused (last x: stale)".
std::string in_one_line(const BridgeStatus& status);
std::string to_json(const BridgeStatus& status);

// The sites whose live messages arrive now, although nothing from these sites has reached the
// archive for `patience_s`. The bridge checks this itself, because a server that has stopped
// copying reports no trouble.
std::vector<std::string> standing_still(const std::map<std::string, double>& heard_ago_s,
                                        const std::map<std::string, double>& archived_ago_s,
                                        double patience_s);

}  // namespace ols::bridge
