// The pending orders: when to send and repeat each, and what the station answers. Pure.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "conditions/refusal.h"
#include "wire/order.h"

namespace ols::console {

// Who waits for the outcome of an order.
struct Ticket {
  std::uint64_t viewer = 0;  // 0: no viewer
  std::int64_t number = 0;   // the request's number, chosen by the viewer
  std::uint64_t event = 0;   // the order's number in the list of events; 0: it has none
  std::string who = {};
  bool is_for_all = false;  // the order is part of a stop of the whole site
  bool is_watched = false;  // the order was sent by another program, and found in a log
};

struct Verdict {
  Ticket ticket;
  std::string station;
  Outcome why;  // why the order was refused or not answered; empty: it is carried out
};

class PendingOrders {
 public:
  // Takes from a station's newest status whether the station is stopped.
  void receive(const std::string& station, bool is_stopped);
  // Takes a reply to an order that was sent.
  void receive(const wire::Reply& reply);
  // Forgets all stations but these.
  void keep_only(const std::function<bool(const std::string&)>& is_known);

  // Accepts an order to be sent. Returns why the order is refused: the station is unknown, or too
  // many orders are pending; empty: it is accepted. A stop of a known station is always carried
  // out. If a stop of the station is already pending, it is sent again at once, and the ticket is
  // added to those that wait for its outcome. A pending joystick's order is replaced by the next.
  Outcome begin(const wire::Order& order, const Ticket& ticket, double now_s);

  // Call if a watched stop was repeated with another id.
  void watch_again(const wire::Order& order);

  // Whether a joystick's order of this kind was given within the last kHold_s. If so, this order
  // belongs to the same movement of the stick.
  bool is_held(const wire::Order& order, double now_s) const;

  // The event's number of this person's pending stop of the station; 0: there is none.
  std::uint64_t stop_event(const std::string& station, const std::string& who) const;

  // Whether a stop of this station is pending.
  bool is_stopping(const std::string& station) const;
  // Whether the station is stopped, according to its newest status.
  bool is_stopped(const std::string& station) const;

  // The orders to send now, each with its own sequence number and boot id 0. A stop is sent again
  // and again until it is confirmed; any other order is sent once.
  std::vector<wire::Order> due(double now_s);
  // The outcomes of orders that were answered or have timed out. A watched order that times out is
  // not reported, because an old log may contain no answers.
  std::vector<Verdict> finished(double now_s);

  static constexpr std::size_t kMostPending = 500;  // not counting stops, of which each station has
                                                    // at most one
  static constexpr std::size_t kMostTickets = 64;   // limit of tickets per stop
  static constexpr std::size_t kMostSent = 500;     // limit of remembered repetitions per order
  static constexpr double kStopPatience_s = 3.0;
  static constexpr double kHold_s = 1.0;

 private:
  struct Waiting {
    Ticket ticket;
    double begun_s = 0.0;
  };
  struct Pending {
    wire::Order order;
    std::vector<Waiting> waiting;  // who waits for the outcome: never empty; more than one only for
                                   // a stop
    std::set<wire::OrderId> sent;  // the ids with which it was sent
    double sent_s = -1e9;
    bool is_watched = false;
    std::optional<wire::Reply> reply;
  };
  static Outcome join(Pending& stop, const Ticket& ticket, double now_s);

  std::int64_t sequence_ = 0;            // sequence number of the last order sent
  std::map<std::string, bool> stopped_;  // the known stations; whether each is stopped
  std::vector<Pending> pending_;
  // by station and kind: when the newest joystick's order was given
  std::map<std::pair<std::string, wire::Kind>, double> holds_s_;
};

}  // namespace ols::console
