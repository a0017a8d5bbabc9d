#include "console/cue_orders.h"

#include <algorithm>

#include "conditions/sayings.h"
#include "wire/refusal_words.h"

namespace ols::console {

Outcome CueOrders::refusal(Role role, const Alarm& bus_trouble) const {
  constexpr std::size_t kMost = 100;  // unanswered
  if (role == Role::kViewer) return outcome::viewer_only_looks();
  if (!bus_trouble.empty()) return bus_trouble;
  return waiting_.size() < kMost ? Outcome() : outcome::too_many_orders();
}

void CueOrders::give(wire::CueOrder order, const Ticket& ticket, double now_s) {
  order.id = {.sequence = ++sequence_};
  waiting_.push_back({order.id, ticket, now_s});
  given_.push_back(std::move(order));
}

void CueOrders::receive(const wire::Reply& reply) {
  const auto answered = std::ranges::find(waiting_, reply.order, &Waiting::id);
  if (!reply.station.empty() || answered == waiting_.end()) return;
  answered_.push_back({.ticket = answered->ticket,
                       .station = {},
                       .why = reply.is_accepted ? Outcome() : wire::refusal_in_words(reply)});
  waiting_.erase(answered);
}

std::vector<Verdict> CueOrders::finished(double now_s) {
  std::vector<Verdict> verdicts = std::exchange(answered_, {});
  std::erase_if(waiting_, [&](const Waiting& waiting) {
    if (now_s <= waiting.begun_s + wire::kLease_s) return false;
    verdicts.push_back({.ticket = waiting.ticket, .station = {}, .why = outcome::no_answer()});
    return true;
  });
  return verdicts;
}

}  // namespace ols::console
