#include "tools/ctl/cue_operator.h"

#include <algorithm>

#include "base/boot_id.h"
#include "base/channel_names.h"
#include "base/clocks.h"
#include "tools/ctl/operator.h"

namespace ols::ctl {
namespace {

constexpr int kPoll_ms = 50;

const command::FusionCue* find(const command::FusionCues& said, const std::string& id) {
  const auto found = std::ranges::find(said.cues, id, &command::FusionCue::id);
  return found == said.cues.end() ? nullptr : &*found;
}

}  // namespace

CueOperator::CueOperator(const std::string& lcm_url, const trust::TrustConfig& trust)
    : boot_id_(draw_boot_id()),
      bus_(lcm_url, open_operator_trust(trust, boot_id_)),
      sender_(boot_id_) {
  bus_.subscribe(std::string(kFusionStatusChannel), [this](const BusMessage& message) {
    if (auto said = command::heard_cues(message)) said_ = std::move(said);
  });
}

std::optional<command::FusionCues> CueOperator::listen(double timeout_s) {
  said_.reset();
  const double end_s = clock_monotonic_s() + timeout_s;
  while (!said_ && clock_monotonic_s() < end_s) bus_.handle(kPoll_ms);
  return said_;
}

std::optional<std::string> CueOperator::give(const command::CueOrder& order, double timeout_s) {
  const auto before = listen(timeout_s);
  if (!before) return "no status of a fusion";
  if (find(*before, order.cue) == nullptr) return "the fusion has no such cue";
  sender_.send(bus_, order, clock_utime_us());
  const double end_s = clock_monotonic_s() + timeout_s;
  while (clock_monotonic_s() < end_s) {
    const auto now = listen(end_s - clock_monotonic_s());
    if (!now) break;
    const command::FusionCue* cue = find(*now, order.cue);
    if (cue == nullptr) return "the cue has ended";
    if (now->orders_refused > before->orders_refused)
      return "refused: the fusion only shows cues ([cues] allow)";
    const bool is_led_to = cue->state == "searched" || cue->state == "found";
    if (order.allow ? is_led_to : cue->state == "forbidden") return std::nullopt;
  }
  return "no answer";
}

}  // namespace ols::ctl
