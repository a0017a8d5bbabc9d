#include "edge/recorder/record_command.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>

#include "conditions/printed.h"

namespace ols::recorder {
namespace {

constexpr std::size_t kLongestLabel = 40;

bool is_label(const std::string& label) {
  return label.size() <= kLongestLabel && std::ranges::all_of(label, [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '-' || c == '_';
         });
}

}  // namespace

std::string wrong_with(const RecordCommand& command, const RecorderConfig& config, double now_s) {
  if (config.folder.empty()) return "no recorder is configured";
  if (!is_label(command.label)) return "the label must be at most 40 letters, digits, - or _";
  if (!std::isfinite(command.event_s) || !(command.before_s >= 0.0) || !(command.after_s >= 0.0) ||
      !(command.before_s + command.after_s <= config.event_max_s)) {
    return printed("before and after must be at least 0 s, together at most %g s",
                   config.event_max_s);
  }
  if (command.event_s > now_s + kLateFrame_s) return "the event lies in the future";
  return {};
}

bool RecordRate::admit(double now_s) {
  left_ = std::min(kMostAtOnce, left_ + (now_s - at_s_) / kAnother_s);
  at_s_ = now_s;
  if (left_ < 1.0) return false;
  left_ -= 1.0;
  return true;
}

}  // namespace ols::recorder
