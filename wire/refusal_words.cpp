#include "wire/refusal_words.h"

#include <array>
#include <cctype>
#include <string_view>
#include <utility>

namespace ols::wire {
namespace {

// What an operator is told of a reason that a station counts; of others, the reason itself.
constexpr std::array<std::pair<std::string_view, std::string_view>, 33> kWords{{
    {"box_outside_or_too_small", "the box is not inside the picture, or too small"},
    {"cues_not_allowed", "the fusion only shows cues ([cues] allow)"},
    {"emergency", "the emergency stop holds; release it and re-arm first"},
    {"fixed_mount", "its camera stands on a fixed mount, which does not move"},
    {"frame_service", "the station sends no picture"},
    {"from_the_future", "it is stamped ahead of the station's clock; compare the clocks"},
    {"just_stopped", "it was stopped less than a second ago; try again"},
    {"keep_out", "homing would sweep across a keep-out region"},
    {"lease", "it would hold for longer than the station allows"},
    {"malformed", "the message is damaged, or of another version"},
    {"no_cue", "the fusion has no such cue"},
    {"no_doubt", "the unit's reference is not in doubt"},
    {"no_frame", "that picture is too old; try again on the one of now"},
    {"no_lens", "it has no lens that moves"},
    {"no_reference", "the unit's reference is missing or in doubt; home it, or reference ok"},
    {"no_unit", "there is no pan-tilt unit; see its alarms"},
    {"not_finite", "a value is not a number"},
    {"nothing_there", "nothing stands out there; draw a box"},
    {"other_boot", "it was meant for the station before its last start; try again"},
    {"other_station", "the message names another station"},
    {"out_of_range", "a value is out of range"},
    {"overtaken", "a later command was there first"},
    {"overview", "an overview station is driven by a person only"},
    {"precedence", "an operator has control, or has stopped it; release the station first"},
    {"rearm_needs_a_hand", "it can be re-armed at the station only"},
    {"recorder", "the recorder does not record"},
    {"replayed", "this command was taken before"},
    {"schema", "the message is of another version"},
    {"stale", "it came too late; compare the clocks"},
    {"stopped", "it is stopped; release it first"},
    {"tracker", "the tracker finds nothing to follow in the box"},
    {"unknown_command", "the station does not know this command; it has another version"},
    {"unreachable", "outside the travel, or in a keep-out region"},
}};

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

std::string refusal_in_words(const Reply& reply) {
  const std::string_view words = words_for(reply.reason);
  std::string text = "refused: " + (words.empty() ? reply.reason : std::string(words));
  if (!reply.detail.empty()) text += ": " + reply.detail;
  return text;
}

}  // namespace ols::wire
