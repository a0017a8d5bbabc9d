#include "command/outcome.h"

#include <array>
#include <cctype>
#include <string_view>
#include <utility>

namespace ols::command {
namespace {

// What an operator is told of a reason that a station counts; of others, the reason itself.
constexpr std::array<std::pair<std::string_view, std::string_view>, 27> kWords{{
    {"box_outside_or_too_small", "the box is not inside the picture, or too small"},
    {"emergency", "the emergency stop holds; release it and re-arm first"},
    {"from_the_future", "it is stamped ahead of the station's clock; compare the clocks"},
    {"just_stopped", "it was stopped less than a second ago; try again"},
    {"keep_out", "homing would sweep across a keep-out region"},
    {"lease", "it would hold for longer than the station allows"},
    {"malformed", "the message is damaged, or of another version"},
    {"no_doubt", "the unit's reference is not in doubt"},
    {"no_frame", "that picture is too old; try again on the one of now"},
    {"no_lens", "it has no lens that moves"},
    {"no_reference", "the unit's reference is missing or in doubt; home it, or reference ok"},
    {"no_unit", "there is no pan-tilt unit; see its alarms"},
    {"not_finite", "a value is not a number"},
    {"nothing_there", "nothing stands out there; draw a box"},
    {"other_station", "the message names another station"},
    {"out_of_range", "a value is out of range"},
    {"overtaken", "a later command was there first"},
    {"overview", "an overview station is driven by a person only"},
    {"precedence", "an operator has the station, or it is stopped; release it first"},
    {"rearm_needs_a_hand", "it can be re-armed at the station only"},
    {"replayed", "this command was taken before"},
    {"schema", "the message is of another version"},
    {"stale", "it came too late; compare the clocks"},
    {"stopped", "it is stopped; release it first"},
    {"tracker", "the tracker finds nothing to follow in the box"},
    {"unknown_command", "the station does not know this command; it has another version"},
    {"unreachable", "outside the travel, or in a keep-out region"},
}};

// The refusal whose counter (`prefix` + reason) has grown; nothing if none has.
std::optional<std::string> new_refusal(const Reply& before, const Reply& now,
                                       const std::string& prefix) {
  for (const auto& [name, value] : now.counters) {
    if (!name.starts_with(prefix) || value <= counter(before, name)) continue;
    const std::string why = name.substr(prefix.size());
    if (const auto words = words_for(why); !words.empty()) return "refused: " + std::string(words);
    // With the station's explanation if there is one ("RECORD refused: disk full").
    return "refused: " + why +
           (now.last_error != before.last_error ? " (" + now.last_error + ")" : "");
  }
  return std::nullopt;
}

}  // namespace

std::string_view words_for(std::string_view reason) {
  for (const auto& [one, words] : kWords) {
    if (one == reason) return words;
  }
  return {};
}

std::string error_in_words(const std::string& error) {
  constexpr std::string_view kRefused = " refused: ";
  const std::size_t at = error.find(kRefused);
  if (at == std::string::npos) return error;
  const std::string_view words = words_for(std::string_view(error).substr(at + kRefused.size()));
  if (words.empty()) return error;
  std::string what = error.substr(0, at);
  for (char& c : what) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return what + std::string(kRefused) + std::string(words);
}

double counter(const Reply& reply, const std::string& name) {
  const auto found = reply.counters.find(name);
  return found == reply.counters.end() ? 0.0 : found->second;
}

std::optional<Outcome> outcome(const Reply& before, const Reply& now, Kind kind) {
  if (now.boot_id != before.boot_id) return std::nullopt;
  const std::string accepted = std::string(counted_as(kind)) + "_accepted";
  if (counter(now, accepted) > counter(before, accepted)) return Outcome{true, ""};
  if (auto refusal = new_refusal(before, now, "refused_")) return Outcome{false, *refusal};
  return std::nullopt;
}

Outcome without_answer(const Reply& before, const Reply& now) {
  const bool has_told = now.boot_id == before.boot_id;
  const auto refusal = has_told ? new_refusal(before, now, "messages_refused_") : std::nullopt;
  return {false, refusal.value_or("no answer")};
}

bool confirms_stop(const Reply& before, const Reply& now) {
  return now.boot_id == before.boot_id && now.stopped &&
         counter(now, "stop_accepted") > counter(before, "stop_accepted");
}

}  // namespace ols::command
