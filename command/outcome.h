// What came of an order, read from the counters that its station reports. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "command/order.h"

namespace ols::command {

// What a station's status says of the orders it got.
struct Reply {
  std::map<std::string, double> counters = {};  // only up within one boot
  std::string last_error = {};
  bool stopped = false;      // stopped, or in an emergency
  std::int64_t boot_id = 0;  // of the station
};

double counter(const Reply& reply, const std::string& name);  // 0 if it is missing

struct Outcome {
  bool accepted = false;
  std::string why;  // when refused: the station's reason
};

// What a person is told of a reason by which stations refuse: "no_frame". Empty: no such reason.
std::string_view words_for(std::string_view reason);

// A station's last error with its reason in words: "DESIGNATE refused: no_frame" becomes
// "designate refused: that picture is too old; ...".
std::string error_in_words(const std::string& error);

// Nothing while the station has not counted the order. `before`: its status before it was sent; of
// another boot than `now` nothing can be told: one of the two may be a recording.
std::optional<Outcome> outcome(const Reply& before, const Reply& now, Kind kind);

// After the lease: the most probable reason. These counters also count others' messages, so that
// they are looked at only when nothing else is known.
Outcome without_answer(const Reply& before, const Reply& now);

// `before`: the first status heard since the stop was sent, or the last before that; likewise.
bool confirms_stop(const Reply& before, const Reply& now);

}  // namespace ols::command
