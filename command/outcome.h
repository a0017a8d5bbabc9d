// The outcome of an order, from the counters that its station reports. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "command/order.h"

namespace ols::command {

// The answer to orders in a station's status.
struct Reply {
  std::map<std::string, double> counters = {};  // they only increase within one boot
  std::string last_error = {};
  bool stopped = false;      // stopped, or in an emergency
  std::int64_t boot_id = 0;  // of the station
};

double counter(const Reply& reply, const std::string& name);  // 0 if it is missing

struct Outcome {
  bool accepted = false;
  std::string why;  // if refused: the station's reason
};

// The sentence for a station's reason of refusal ("no_frame"). Empty: unknown reason.
std::string_view words_for(std::string_view reason);

// A station's last error with its reason in words: "DESIGNATE refused: no_frame" becomes "designate
// refused: that picture is too old; ...".
std::string error_in_words(const std::string& error);

// nullopt while the station has not counted the order. `before`: its status before the order was
// sent. If `now` has another boot, one of the two may be a recording: nullopt.
std::optional<Outcome> outcome(const Reply& before, const Reply& now, Kind kind);

// After the lease: the most probable reason. These counters also count others' messages, so they
// are used only when nothing else is known.
Outcome without_answer(const Reply& before, const Reply& now);

// `before`: the first status heard since the stop was sent, or the last one before that.
// False if `now` has another boot.
bool confirms_stop(const Reply& before, const Reply& now);

}  // namespace ols::command
