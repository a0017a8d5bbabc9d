#include "console/command_desk.h"

#include <algorithm>

namespace ols::console {

using command::Kind;

void CommandDesk::hear(const std::string& station, const command::Reply& reply) {
  replies_[station] = reply;
}

void CommandDesk::keep_only(const std::function<bool(const std::string&)>& is_known) {
  std::erase_if(replies_, [&](const auto& reply) { return !is_known(reply.first); });
  std::erase_if(holds_s_, [&](const auto& hold) { return !is_known(hold.first.first); });
}

std::optional<std::string> CommandDesk::join(Pending& stop, const Ticket& ticket, double now_s) {
  stop.sent_s = -1e9;
  if (stop.waiting.size() >= kMostTickets) return "a stop is on its way already, and sent again";
  stop.waiting.push_back({ticket, now_s});
  return std::nullopt;
}

std::optional<std::string> CommandDesk::begin(const command::Order& order, const Ticket& ticket,
                                              double now_s) {
  const auto known = replies_.find(order.station);
  const bool is_stop = order.kind == Kind::kStop, is_hold = command::is_joystick(order);
  if (known == replies_.end()) return "refused: no such station is heard";
  if (is_hold) holds_s_[{order.station, order.kind}] = now_s;
  const auto waits = std::ranges::find_if(pending_, [&](const Pending& p) {
    return p.order.station == order.station && p.order.kind == order.kind;
  });
  if (waits != pending_.end()) {
    if (is_stop) return join(*waits, ticket, now_s);
    if (is_hold) {
      waits->order = order;
      waits->sent_s = -1e9;
      return std::nullopt;
    }
    return "refused: the station has not answered the same command yet";
  }
  const auto others =
      std::ranges::count_if(pending_, [](const Pending& p) { return p.order.kind != Kind::kStop; });
  if (!is_stop && static_cast<std::size_t>(others) >= kMostPending) {
    return "refused: too many commands are on their way";
  }
  pending_.push_back({order, {{ticket, now_s}}, known->second, -1e9});
  return std::nullopt;
}

bool CommandDesk::is_held(const command::Order& order, double now_s) const {
  const auto hold = holds_s_.find({order.station, order.kind});
  return command::is_joystick(order) && hold != holds_s_.end() && now_s - hold->second < kHold_s;
}

std::uint64_t CommandDesk::stop_event(const std::string& station, const std::string& who) const {
  for (const Pending& pending : pending_) {
    if (pending.order.station != station || pending.order.kind != Kind::kStop) continue;
    const auto own = std::ranges::find_if(
        pending.waiting, [&](const Waiting& waiting) { return waiting.ticket.who == who; });
    if (own != pending.waiting.end()) return own->ticket.event;
  }
  return 0;
}

bool CommandDesk::is_stopping(const std::string& station) const {
  return std::ranges::any_of(pending_, [&](const Pending& pending) {
    return pending.order.station == station && pending.order.kind == Kind::kStop;
  });
}

bool CommandDesk::is_stopped(const std::string& station) const {
  const auto known = replies_.find(station);
  return known != replies_.end() && known->second.stopped;
}

std::vector<command::Order> CommandDesk::due(double now_s) {
  std::vector<command::Order> orders;
  for (Pending& pending : pending_) {
    const bool is_stop = pending.order.kind == Kind::kStop;
    const bool again = is_stop && now_s >= pending.sent_s + command::kStopAgain_s;
    if (pending.sent_s >= 0.0 && !again) continue;
    pending.sent_s = now_s;
    orders.push_back(pending.order);
  }
  return orders;
}

std::optional<command::Outcome> CommandDesk::judge(const Pending& pending, double begun_s,
                                                   double now_s) const {
  const bool is_stop = pending.order.kind == Kind::kStop;
  const double patience_s = is_stop ? kStopPatience_s : command::kLease_s;
  const bool is_over = now_s > begun_s + patience_s;
  const auto known = replies_.find(pending.order.station);
  if (known == replies_.end()) {
    return is_over ? std::optional(command::Outcome{false, "no answer"}) : std::nullopt;
  }
  const command::Reply& now = known->second;
  if (is_stop) {
    if (confirms_stop(pending.before, now)) return command::Outcome{true, ""};
    return is_over ? std::optional(command::Outcome{false, "sent repeatedly, no answer"})
                   : std::nullopt;
  }
  if (auto known_outcome = command::outcome(pending.before, now, pending.order.kind)) {
    return known_outcome;
  }
  return is_over ? std::optional(command::without_answer(pending.before, now)) : std::nullopt;
}

// Those who have joined a stop later wait for longer.
std::vector<Verdict> CommandDesk::finished(double now_s) {
  std::vector<Verdict> verdicts;
  std::erase_if(pending_, [&](Pending& pending) {
    if (pending.sent_s < 0.0) return false;
    std::erase_if(pending.waiting, [&](const Waiting& waiting) {
      const auto outcome = judge(pending, waiting.begun_s, now_s);
      if (outcome) verdicts.push_back({waiting.ticket, pending.order.station, *outcome});
      return outcome.has_value();
    });
    return pending.waiting.empty();
  });
  return verdicts;
}

}  // namespace ols::console
