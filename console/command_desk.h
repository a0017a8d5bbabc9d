// Pending orders: when each is sent and repeated, and what its station answers. Pure.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "command/order.h"
#include "command/outcome.h"

namespace ols::console {

// Who waits for an outcome.
struct Ticket {
  std::uint64_t viewer = 0;  // 0: nobody does
  std::int64_t number = 0;   // the viewer's own
  std::uint64_t event = 0;   // in the list of events
  std::string who = {};
  bool is_for_all = false;  // of a stop of the whole site
};

struct Verdict {
  Ticket ticket;
  std::string station;
  command::Outcome outcome;
};

class CommandDesk {
 public:
  // The newest status of a station. It decides the outcome of the station's orders.
  void hear(const std::string& station, const command::Reply& reply);
  // Forgets the replies of all stations but these.
  void keep_only(const std::function<bool(const std::string&)>& is_known);

  // Accepts an order to be sent, or returns why not: the station is unknown, or has not yet
  // answered an order of the same kind (its counter would be taken for the new order's). A stop of
  // a known station is always accepted. If one is pending, it is sent again at once, and has one
  // more ticket to answer. A joystick's order that is not answered yet is replaced by the next.
  std::optional<std::string> begin(const command::Order& order, const Ticket& ticket, double now_s);

  // Whether a joystick's order of this kind was given a moment ago: the next one continues the same
  // hold.
  bool is_held(const command::Order& order, double now_s) const;

  // The event of a stop of this person that is still pending; 0: none.
  std::uint64_t stop_event(const std::string& station, const std::string& who) const;

  // Whether a stop of this station is pending.
  bool is_stopping(const std::string& station) const;
  // Whether it is stopped, by its newest status.
  bool is_stopped(const std::string& station) const;

  // The orders to be sent now: each once, but a stop again and again until it is confirmed.
  std::vector<command::Order> due(double now_s);
  // Orders whose outcome is known, or whose time is over.
  std::vector<Verdict> finished(double now_s);

  static constexpr std::size_t kMostPending = 500;  // without stops: one per known station
  static constexpr std::size_t kMostTickets = 64;   // of a stop
  static constexpr double kStopPatience_s = 3.0;
  static constexpr double kHold_s = 1.0;

 private:
  struct Waiting {
    Ticket ticket;
    double begun_s = 0.0;
  };
  struct Pending {
    command::Order order;
    std::vector<Waiting> waiting;  // never empty; only a stop has several
    command::Reply before;
    double sent_s = -1e9;
  };
  std::optional<std::string> join(Pending& stop, const Ticket& ticket, double now_s);
  std::optional<command::Outcome> judge(const Pending& pending, double begun_s, double now_s) const;

  std::map<std::string, command::Reply> replies_;
  std::vector<Pending> pending_;
  std::map<std::pair<std::string, command::Kind>, double> holds_s_;  // the newest order of each
};

}  // namespace ols::console
