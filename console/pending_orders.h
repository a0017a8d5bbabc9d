// Pending orders: when each is sent and repeated, and what its station answers. Pure.
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
  std::int64_t number = 0;   // number that the viewer gave the request
  std::uint64_t event = 0;   // its number in the list of events
  std::string who = {};
  bool is_for_all = false;  // part of a stop of the whole site
  bool is_watched = false;  // an order that somebody else has sent, seen in a log
};

struct Verdict {
  Ticket ticket;
  std::string station;
  Outcome why;  // why it was refused or not answered; empty: it is carried out
};

class PendingOrders {
 public:
  // Takes the state from a station's newest status.
  void receive(const std::string& station, bool is_stopped);
  // Takes a reply to an order that was sent.
  void receive(const wire::Reply& reply);
  // Forgets all stations but these.
  void keep_only(const std::function<bool(const std::string&)>& is_known);

  // Accepts an order to be sent, or returns why not (else empty): the station is unknown, or too
  // many orders are pending. A stop of a known station is always accepted. If one is pending, it is
  // sent again at once, and has one more ticket to answer. A joystick's order that is not answered
  // yet is replaced by the next.
  Outcome begin(const wire::Order& order, const Ticket& ticket, double now_s);

  // A watched stop was repeated with another id.
  void watch_again(const wire::Order& order);

  // Whether a joystick's order of this kind was given a moment ago: the next one then belongs to
  // the same movement of the stick.
  bool is_held(const wire::Order& order, double now_s) const;

  // The event of this person's pending stop of the station; 0: there is none.
  std::uint64_t stop_event(const std::string& station, const std::string& who) const;

  // Whether a stop of this station is pending.
  bool is_stopping(const std::string& station) const;
  // Whether the station is stopped, according to its newest status.
  bool is_stopped(const std::string& station) const;

  // The orders to be sent now, each with its own sequence number and boot 0. An order is sent once,
  // a stop again and again until it is confirmed.
  std::vector<wire::Order> due(double now_s);
  // Orders that were answered, or that have timed out. A watched order that times out is not
  // reported: an old log may contain no answers.
  std::vector<Verdict> finished(double now_s);

  static constexpr std::size_t kMostPending = 500;  // not counting stops: at most one per station
  static constexpr std::size_t kMostTickets = 64;   // of one stop
  static constexpr std::size_t kMostSent = 500;     // repetitions of one order
  static constexpr double kStopPatience_s = 3.0;
  static constexpr double kHold_s = 1.0;

 private:
  struct Waiting {
    Ticket ticket;
    double begun_s = 0.0;
  };
  struct Pending {
    wire::Order order;
    std::vector<Waiting> waiting;  // never empty; only a stop has more than one
    std::set<wire::OrderId> sent;  // the ids with which it was sent
    double sent_s = -1e9;
    bool is_watched = false;
    std::optional<wire::Reply> reply;
  };
  static Outcome join(Pending& stop, const Ticket& ticket, double now_s);

  std::int64_t sequence_ = 0;            // of the last order that was sent
  std::map<std::string, bool> stopped_;  // the stations that are heard
  std::vector<Pending> pending_;
  std::map<std::pair<std::string, wire::Kind>, double> holds_s_;  // when the newest order of each
                                                                  // was given
};

}  // namespace ols::console
