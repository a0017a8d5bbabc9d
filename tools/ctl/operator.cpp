#include "tools/ctl/operator.h"

#include <algorithm>
#include <utility>

#include "base/bus/boot_id.h"
#include "base/bus/channel_names.h"
#include "base/process/clocks.h"
#include "wire/refusal_words.h"

namespace ols::ctl {
namespace {

constexpr int kPoll_ms = 50;

}  // namespace

std::shared_ptr<trust::BusTrust> open_operator_trust(const trust::TrustConfig& config,
                                                     std::int64_t boot_id) {
  trust::Self self;
  self.name = "operator";
  self.boot_id = boot_id;
  self.commands = self.tells_list = true;
  return trust::BusTrust::open(config, trust::process_environment(), self);
}

Operator::Operator(const std::string& lcm_url, const trust::TrustConfig& trust, std::string station)
    : station_(std::move(station)),
      boot_id_(draw_boot_id()),
      trust_(open_operator_trust(trust, boot_id_)),
      bus_(lcm_url, trust_),
      sender_(boot_id_) {
  const std::string which = station_ == "all" ? ".*" : station_;
  bus_.subscribe(station_channel(kStatusChannel, which),
                 [this](const BusMessage& message) { receive(message); });
  bus_.subscribe(station_channel(kReplyChannel, which), [this](const BusMessage& message) {
    const auto reply = wire::decode_reply(message);
    if (reply && reply->order.boot_id == boot_id_) replies_[reply->order] = *reply;
  });
}

std::vector<std::string> Operator::enrolled() const {
  if (!trust_) return {};
  std::vector<std::string> stations = trust_->stations();
  if (station_ != "all") std::erase_if(stations, [&](const auto& id) { return id != station_; });
  return stations;
}

wire::OrderId Operator::send(wire::Order order) {
  order.id = sender_.next_id();
  sender_.send(bus_, order, clock_utime_us());
  return order.id;
}

void Operator::send_stop(const std::string& station) {
  send({.station = station, .kind = wire::Kind::kStop});
}

void Operator::receive(const BusMessage& message) {
  auto status = wire::decode_status(message);
  if (!status) return;
  // Any station counts as heard, even if the table is full.
  if (stopping_) send_stop(status->station);
  if (!statuses_.contains(status->station) && is_full()) return;
  statuses_[status->station] = std::move(*status);
}

const Operator::Statuses& Operator::listen(double timeout_s) {
  const double start_s = clock_monotonic_s();
  const bool all = station_ == "all";
  const double end_s = start_s + (all ? wire::kTwoIntervals_s : timeout_s);
  while (clock_monotonic_s() < end_s && (all || statuses_.empty())) bus_.handle(kPoll_ms);
  return statuses_;
}

std::optional<wire::Reply> Operator::wait_for_reply(wire::OrderId order) {
  const double end_s = clock_monotonic_s() + wire::kLease_s;
  while (!replies_.contains(order) && clock_monotonic_s() < end_s) bus_.handle(kPoll_ms);
  const auto reply = replies_.find(order);
  return reply == replies_.end() ? std::nullopt : std::optional(reply->second);
}

std::optional<std::string> Operator::give(wire::Order order) {
  auto reply = wait_for_reply(send(order));
  // An order must name the station's boot. If no status has told it, the first answer does.
  if (reply && reply->reason == "other_boot") reply = wait_for_reply(send(order));
  if (!reply) return "no answer";
  return reply->is_accepted ? std::nullopt : std::optional(wire::refusal_in_words(*reply).text);
}

std::optional<std::string> Operator::hold_rate(wire::Order order, double seconds) {
  if (auto refusal = give(order)) return refusal;
  replies_.clear();
  const double end_s = clock_monotonic_s() + seconds;
  double due_s = 0.0;
  for (double now_s = end_s - seconds; now_s < end_s; now_s = clock_monotonic_s()) {
    if (now_s >= due_s) send(order);
    if (now_s >= due_s) due_s = now_s + wire::kRateAgain_s;
    bus_.handle(kPoll_ms);
    for (const auto& [id, reply] : replies_) {
      if (!reply.is_accepted) return wire::refusal_in_words(reply).text;
    }
  }
  order.pan_rate_rad_s = order.tilt_rate_rad_s = 0.0;
  return give(order);
}

std::map<std::string, bool> Operator::stop(double timeout_s) {
  constexpr double kMostRate = 2000;  // [1/s] of stops to all stations together
  constexpr int kTurn_ms = 10;
  const bool all = station_ == "all";
  stopping_ = all;
  std::map<std::string, bool> stopped;
  std::map<std::string, double> sent_s;
  if (!all) stopped[station_] = false;
  const double start_s = clock_monotonic_s();
  for (double now_s = start_s; now_s < start_s + timeout_s; now_s = clock_monotonic_s()) {
    for (const auto& [id, status] : statuses_) stopped.try_emplace(id, false);
    for (const auto& [id, reply] : replies_) {
      if (reply.is_accepted && reply.is_stopped) stopped[reply.station] = true;
    }
    const double again_s =
        std::max(wire::kStopAgain_s, static_cast<double>(stopped.size()) / kMostRate);
    for (const auto& [id, stands] : stopped) {
      const auto sent = sent_s.find(id);
      if (stands || (sent != sent_s.end() && now_s < sent->second + again_s)) continue;
      send_stop(id);
      sent_s[id] = now_s;
    }
    const bool every = std::ranges::all_of(stopped, [](const auto& one) { return one.second; });
    if (every && !stopped.empty() && (!all || now_s > start_s + wire::kTwoIntervals_s)) break;
    bus_.handle(kTurn_ms);
  }
  stopping_ = false;
  return stopped;
}

}  // namespace ols::ctl
