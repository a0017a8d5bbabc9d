#include "tools/ctl/cue_operator.h"

#include <cmath>

#include "base/bus/boot_id.h"
#include "base/bus/channel_names.h"
#include "base/process/clocks.h"
#include "tools/ctl/operator.h"
#include "wire/object_class.h"
#include "wire/refusal_words.h"
#include "wire/target.h"

namespace ols::ctl {
namespace {

constexpr int kPoll_ms = 50;

}  // namespace

CueOperator::CueOperator(const std::string& lcm_url, const trust::TrustConfig& trust)
    : boot_id_(draw_boot_id()),
      bus_(lcm_url, open_operator_trust(trust, boot_id_)),
      sender_(boot_id_) {
  bus_.subscribe(std::string(kFusionStatusChannel), [this](const BusMessage& message) {
    if (auto said = wire::decode_fusion_status(message)) said_ = std::move(said);
  });
  bus_.subscribe(std::string(kTargetChannel), [this](const BusMessage& message) {
    if (const auto target = wire::decode_target(message)) note_class(*target);
  });
  bus_.subscribe(std::string(kCueReplyChannel), [this](const BusMessage& message) {
    auto reply = wire::decode_reply(message);
    if (reply && reply->order.boot_id == boot_id_) reply_ = std::move(reply);
  });
}

void CueOperator::note_class(const ols_msg::target_t& target) {
  std::string& words = classes_[target.target_id];
  words = to_string(wire::object_class_of(target.object_class));
  if (target.object_class == ols_msg::target_t::CLASS_UNKNOWN) return;
  words += " (" + std::to_string(std::lround(100.0 * target.class_probability)) + " %)";
}

std::optional<ols_msg::fusion_status_t> CueOperator::listen(double timeout_s) {
  said_.reset();
  const double end_s = clock_monotonic_s() + timeout_s;
  while (!said_ && clock_monotonic_s() < end_s) bus_.handle(kPoll_ms);
  return said_;
}

std::optional<std::string> CueOperator::give(const wire::CueOrder& order, double timeout_s) {
  reply_.reset();
  sender_.send(bus_, {order.cue, order.allow, sender_.next_id(), order.handover}, clock_utime_us());
  const double end_s = clock_monotonic_s() + timeout_s;
  while (!reply_ && clock_monotonic_s() < end_s) bus_.handle(kPoll_ms);
  if (!reply_) return "no answer";
  return reply_->is_accepted ? std::nullopt : std::optional(wire::refusal_in_words(*reply_).text);
}

}  // namespace ols::ctl
