#include "console/pending_orders.h"

#include <algorithm>
#include <utility>

#include "conditions/sayings.h"
#include "wire/refusal_words.h"

namespace ols::console {

using wire::Kind;

void PendingOrders::receive(const std::string& station, bool is_stopped) {
  stopped_[station] = is_stopped;
}

// A stop is confirmed only when the unit stands: it may have crossed another order on the way.
void PendingOrders::receive(const wire::Reply& reply) {
  const auto known = stopped_.find(reply.station);
  if (known == stopped_.end()) return;
  if (reply.is_stopped) known->second = true;  // its next status is no news
  for (Pending& pending : pending_) {
    if (pending.order.station != reply.station || !pending.sent.contains(reply.order)) continue;
    const bool is_stop = pending.order.kind == Kind::kStop;
    if (!is_stop || (reply.is_accepted && reply.is_stopped)) pending.reply = reply;
  }
}

void PendingOrders::keep_only(const std::function<bool(const std::string&)>& is_known) {
  std::erase_if(stopped_, [&](const auto& station) { return !is_known(station.first); });
  std::erase_if(holds_s_, [&](const auto& hold) { return !is_known(hold.first.first); });
}

Outcome PendingOrders::join(Pending& stop, const Ticket& ticket, double now_s) {
  stop.sent_s = -1e9;
  if (stop.waiting.size() >= kMostTickets) return outcome::stop_on_its_way();
  stop.waiting.push_back({ticket, now_s});
  return {};
}

Outcome PendingOrders::begin(const wire::Order& order, const Ticket& ticket, double now_s) {
  const bool is_stop = order.kind == Kind::kStop, is_hold = wire::is_joystick(order);
  if (!stopped_.contains(order.station)) return outcome::no_such_station();
  if (is_hold) holds_s_[{order.station, order.kind}] = now_s;
  const auto waits = std::ranges::find_if(pending_, [&](const Pending& p) {
    return p.order.station == order.station && p.order.kind == order.kind && !p.reply;
  });
  if (waits != pending_.end() && is_stop) return join(*waits, ticket, now_s);
  if (waits != pending_.end() && is_hold) {
    waits->order = order;
    waits->sent_s = -1e9;
    return {};
  }
  const auto others =
      std::ranges::count_if(pending_, [](const Pending& p) { return p.order.kind != Kind::kStop; });
  if (!is_stop && static_cast<std::size_t>(others) >= kMostPending) {
    return outcome::too_many_orders();
  }
  Pending pending{.order = order, .waiting = {{ticket, now_s}}};
  if (ticket.is_watched) {
    pending.is_watched = true;
    pending.sent.insert(order.id);
    pending.sent_s = now_s;
  }
  pending_.push_back(std::move(pending));
  return {};
}

void PendingOrders::watch_again(const wire::Order& order) {
  for (Pending& pending : pending_) {
    const bool is_it = pending.order.station == order.station && pending.order.kind == order.kind;
    if (is_it && pending.sent.size() < kMostSent) pending.sent.insert(order.id);
  }
}

bool PendingOrders::is_held(const wire::Order& order, double now_s) const {
  const auto hold = holds_s_.find({order.station, order.kind});
  return wire::is_joystick(order) && hold != holds_s_.end() && now_s - hold->second < kHold_s;
}

std::uint64_t PendingOrders::stop_event(const std::string& station, const std::string& who) const {
  for (const Pending& pending : pending_) {
    if (pending.order.station != station || pending.order.kind != Kind::kStop) continue;
    const auto own = std::ranges::find_if(
        pending.waiting, [&](const Waiting& waiting) { return waiting.ticket.who == who; });
    if (own != pending.waiting.end()) return own->ticket.event;
  }
  return 0;
}

bool PendingOrders::is_stopping(const std::string& station) const {
  return std::ranges::any_of(pending_, [&](const Pending& pending) {
    return pending.order.station == station && pending.order.kind == Kind::kStop;
  });
}

bool PendingOrders::is_stopped(const std::string& station) const {
  const auto known = stopped_.find(station);
  return known != stopped_.end() && known->second;
}

std::vector<wire::Order> PendingOrders::due(double now_s) {
  std::vector<wire::Order> orders;
  for (Pending& pending : pending_) {
    const bool is_stop = pending.order.kind == Kind::kStop;
    const bool again = is_stop && now_s >= pending.sent_s + wire::kStopAgain_s;
    // A reply to the previous rate must not keep its replacement from being sent.
    const bool is_sent = pending.sent_s >= 0.0;
    if (pending.is_watched || (is_sent && (pending.reply || !again))) continue;
    pending.sent_s = now_s;
    pending.order.id = {.sequence = ++sequence_};
    pending.sent.insert(pending.order.id);
    orders.push_back(pending.order);
  }
  return orders;
}

// Each has its own time-out, so those who join a stop later wait for longer.
std::vector<Verdict> PendingOrders::finished(double now_s) {
  std::vector<Verdict> verdicts;
  std::erase_if(pending_, [&](Pending& pending) {
    if (pending.sent_s < 0.0) return false;
    const bool is_stop = pending.order.kind == Kind::kStop;
    const double patience_s = is_stop ? kStopPatience_s : wire::kLease_s;
    Verdict verdict{.ticket = {}, .station = pending.order.station, .why = {}};
    if (!pending.reply) {
      verdict.why = is_stop ? outcome::stop_unanswered() : outcome::no_answer();
    } else if (!pending.reply->is_accepted) {
      verdict.why = wire::refusal_in_words(*pending.reply);
    }
    std::erase_if(pending.waiting, [&](const Waiting& waiting) {
      if (!pending.reply && now_s <= waiting.begun_s + patience_s) return false;
      verdict.ticket = waiting.ticket;
      if (pending.reply || !pending.is_watched) verdicts.push_back(verdict);
      return true;
    });
    return pending.waiting.empty();
  });
  return verdicts;
}

}  // namespace ols::console
