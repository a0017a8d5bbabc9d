#include "tools/ctl/operator.h"

#include <algorithm>
#include <utility>

#include "base/boot_id.h"
#include "base/channel_names.h"
#include "base/clocks.h"

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
                 [this](const BusMessage& message) { hear(message); });
}

std::vector<std::string> Operator::enrolled() const {
  if (!trust_) return {};
  std::vector<std::string> stations = trust_->stations();
  if (station_ != "all") std::erase_if(stations, [&](const auto& id) { return id != station_; });
  return stations;
}

void Operator::send(const command::Order& order) { sender_.send(bus_, order, clock_utime_us()); }

void Operator::send_stop(const std::string& station) {
  send({.station = station, .kind = command::Kind::kStop});
}

void Operator::hear(const BusMessage& message) {
  auto status = command::heard_status(message);
  if (!status) return;
  // Any station counts as heard, even if the table is full.
  if (stopping_) send_stop(status->station);
  if (!statuses_.contains(status->station) && is_full()) return;
  statuses_[status->station] = std::move(*status);
}

const Operator::Statuses& Operator::listen(double timeout_s) {
  const double start_s = clock_monotonic_s();
  const bool all = station_ == "all";
  const double end_s = start_s + (all ? command::kTwoIntervals_s : timeout_s);
  while (clock_monotonic_s() < end_s && (all || statuses_.empty())) bus_.handle(kPoll_ms);
  return statuses_;
}

std::optional<std::string> Operator::give(const command::Order& order) {
  const command::Reply before = command::reply_of(statuses_[order.station]);
  send(order);
  const double end_s = clock_monotonic_s() + command::kLease_s;
  command::Reply now;
  while (clock_monotonic_s() < end_s) {
    bus_.handle(kPoll_ms);
    now = command::reply_of(statuses_[order.station]);
    if (const auto known = command::outcome(before, now, order.kind)) {
      return known->accepted ? std::nullopt : std::optional(known->why);
    }
  }
  return command::without_answer(before, now).why;
}

std::optional<std::string> Operator::hold_rate(command::Order order, double seconds) {
  const command::Reply before = command::reply_of(statuses_[order.station]);
  const double end_s = clock_monotonic_s() + seconds;
  double due_s = 0.0;
  for (double now_s = end_s - seconds; now_s < end_s; now_s = clock_monotonic_s()) {
    if (now_s >= due_s) send(order);
    if (now_s >= due_s) due_s = now_s + command::kRateAgain_s;
    bus_.handle(kPoll_ms);
    const command::Reply now = command::reply_of(statuses_[order.station]);
    const auto known = command::outcome(before, now, order.kind);
    if (known && !known->accepted) return known->why;
  }
  order.pan_rate_rad_s = order.tilt_rate_rad_s = 0.0;
  return give(order);
}

std::map<std::string, bool> Operator::stop(double timeout_s) {
  constexpr double kMostRate = 2000;  // [1/s] of stops to all stations together
  constexpr int kTurn_ms = 10;
  struct Addressed {
    double sent_s = -1.0;
    std::optional<command::Reply> before;  // the first heard of its boot
    bool stopped = false;
  };
  const bool all = station_ == "all";
  stopping_ = all;
  std::map<std::string, Addressed> addressed;
  if (!all) addressed[station_] = {};
  const double start_s = clock_monotonic_s();
  for (double now_s = start_s; now_s < start_s + timeout_s; now_s = clock_monotonic_s()) {
    for (const auto& [id, status] : statuses_) {
      Addressed& one = addressed[id];
      const command::Reply now = command::reply_of(status);
      if (!one.before || one.before->boot_id != now.boot_id) one.before = now;
      one.stopped = command::confirms_stop(*one.before, now);
    }
    const double again_s =
        std::max(command::kStopAgain_s, static_cast<double>(addressed.size()) / kMostRate);
    for (auto& [id, one] : addressed) {
      if (one.stopped || now_s < one.sent_s + again_s) continue;
      send_stop(id);
      one.sent_s = now_s;
    }
    const bool every =
        std::ranges::all_of(addressed, [](const auto& a) { return a.second.stopped; });
    if (every && !addressed.empty() && (!all || now_s > start_s + command::kTwoIntervals_s)) break;
    bus_.handle(kTurn_ms);
  }
  stopping_ = false;
  std::map<std::string, bool> result;
  for (const auto& [id, one] : addressed) result[id] = one.stopped;
  return result;
}

}  // namespace ols::ctl
