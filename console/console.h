// The console without its sockets. Holds the site's state, the viewers (connected browsers) and the
// pending orders, and makes the next message for each viewer. Pure: time, messages and texts come
// in, orders and texts go out.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "console/client_message.h"
#include "console/control_leases.h"
#include "console/incidents/incident_book.h"
#include "console/latest_pictures.h"
#include "console/pending_orders.h"
#include "console/procedures.h"
#include "console/seen_skylines.h"
#include "console/site_state.h"
#include "console/viewers.h"

namespace ols::console {

// A WebSocket message to a browser.
struct Outgoing {
  bool is_binary = false;
  std::string bytes;
};

// The complete state of a replay at one instant.
struct Moment {
  SiteState site;
  PendingOrders orders;
  std::map<std::string, Picture> pictures;
  SeenSkylines skylines;
};

class Console {
 public:
  explicit Console(double control_timeout_s, const IncidentRecording& recording = {})
      : control_(control_timeout_s), incidents_(recording) {}

  void receive(const ReceivedStation& station, const Now& now);
  void receive(const ReceivedTarget& target, const Now& now);
  void receive(const ReceivedFusion& fusion, const Now& now) { site_.receive(fusion, now); }
  void receive(const ReceivedOcclusion& occlusion, const Now& now) {
    site_.receive(occlusion, now);
  }
  void receive(const ReceivedSkyline& skyline);
  void receive_bearing(const std::string& station, const Json& bearing);
  void receive(Picture picture);
  void receive(ReceivedProcedure procedure);

  // Takes an order that was found in a recording, for the list of events in a replay.
  void receive(const wire::Order& order, const Now& now);
  // Takes a reply to an order. `reply.order` has boot id 0 for an order from turn(); in a replay,
  // it is the id in the log.
  void receive(const wire::Reply& reply);

  // The newest picture (JPEG) of a station's guided procedure; null: there is none.
  const std::string* procedure_picture(const std::string& station) const {
    return procedures_.picture(station);
  }
  // People's answers to procedures since the last call.
  std::vector<ProcedureAnswer> take_answers() { return procedures_.take(); }

  // Operators' decisions on cues since the last call.
  std::vector<wire::CueOrder> take_cue_orders() { return cues_.take(); }

  // The stations' videos that at least one viewer watches.
  WatchedVideos watched_video() const { return viewers_.watched(video_addresses_); }

  // Takes the current alarms of the console itself.
  void receive_own(const std::vector<Alarm>& alarms, const Now& now);

  // Restores the areas and incidents that were stored. Call before anything else.
  void resume(KeptIncidents kept, const Now& now);
  const IncidentBook& incidents() const { return incidents_; }
  // What the last call of turn() has changed in the incidents, to be stored and sent.
  const IncidentBook::News& incident_news() const { return incident_news_; }
  void incident_trouble(const std::vector<Alarm>& alarms) { incident_trouble_ = alarms; }

  // Call when a browser has opened its WebSocket; returns the viewer's number. The second viewer of
  // the user "ana" is called "ana 2".
  std::uint64_t open(const std::string& name, Role role) { return viewers_.open(name, role); }
  void close(std::uint64_t viewer);
  void take(std::uint64_t viewer, std::string_view text, const Now& now);
  // The next message for this viewer, made from the newest state; nullopt: there is nothing new.
  // Call only when the last message has been sent completely, so that messages never queue.
  std::optional<Outgoing> next(std::uint64_t viewer, const Now& now);

  // Tells why orders cannot be sent; empty: they can.
  void bus_is(const Alarm& trouble) { bus_trouble_ = trouble; }
  const Outcome& bus_trouble() const { return bus_trouble_; }

  // Stops every station, including stations whose first status arrives within the next
  // kStopPatience_s. Returns the ids of the stations that are known now. All viewers are told which
  // stations do not confirm the stop.
  std::vector<std::string> stop_all(const Person& by, const Ticket& ticket, const Now& now);
  // The person who sent an HTTP request. `name`: the user of the session. `viewer`: the number of
  // the browser, as the request states it; ignored if that browser belongs to another user.
  Person person(const std::string& name, std::uint64_t viewer) const {
    return viewers_.person(name, viewer);
  }

  // Call often: updates outcomes, control and ages. Returns the orders to send now.
  std::vector<wire::Order> turn(const Now& now);

  // Call if this console shows a replay, whenever the state of the replay has changed. `state`: the
  // replay's state. From now on no order goes out, and every message contains this state.
  // `is_urgent`: viewers get the state at once.
  void replay_is(const Json& state, bool is_urgent);
  void timeline_is(const Json& timeline) { replay_.timeline = timeline; }
  bool is_replay() const { return !replay_.state.is_null(); }
  const Json& timeline() const { return replay_.timeline; }
  // The viewers' requests for the replay since the last call.
  std::vector<ReplayRequest> take_replay_requests() { return std::exchange(replay_.requests, {}); }
  Moment moment() const;
  // Replaces the whole state with this moment, and shows it to every viewer.
  void show(const Moment& moment);
  Json events_since(Revision revision) const { return site_.events_since(revision); }
  Revision revision() const { return site_.revision(); }

  Json state(const Now& now) const;
  // The fields of a station's last status; null: the station is unknown.
  const Json* fields_of(const std::string& id) const { return site_.fields_of(id); }
  // Where a station's pictures disagree with the skyline of the land model (SeenSkylines::of()).
  Json seen_skyline(const std::string& station) const { return skylines_.of(station); }
  Json health(const Now& now) const;
  // Adds an event about this console. `who`: the person who caused it; empty: nobody.
  void note(const std::string& who, const Alarm& what, const Now& now);
  std::size_t viewers() const { return viewers_.size(); }

  // Shortest time between two messages with changes. The rate is 20 Hz, because at 10 Hz a new
  // position could wait for 0.1 s. The period is slightly below 0.05 s, so that jitter of the turns
  // does not lower the rate.
  static constexpr double kDeltaPeriod_s = 0.045;

 private:
  struct ReplayState {
    Json state, timeline;  // null: this is not a replay
    std::vector<ReplayRequest> requests;
  };

  void act(std::uint64_t id, const CommandRequest& request, const Now& now);
  void act(std::uint64_t id, const StopAllRequest& request, const Now& now);
  void act(std::uint64_t id, const ControlRequest& request, const Now& now);
  void act(std::uint64_t id, const WatchRequest& request, const Now& now);
  void act(std::uint64_t id, const TakenRequest& request, const Now& now);
  void act(std::uint64_t id, const ReplayRequest& request, const Now& now);
  void act(std::uint64_t id, const AnswerRequest& request, const Now& now);
  void act(std::uint64_t id, const CueRequest& request, const Now& now);
  void act(std::uint64_t id, const AcknowledgeRequest& request, const Now& now);
  void act(std::uint64_t id, const NameRequest& request, const Now& now);
  void act(std::uint64_t id, const AreaRequest& request, const Now& now);
  void act(std::uint64_t id, const JudgeRequest& request, const Now& now);
  void act(std::uint64_t id, const Refused& refused, const Now& now);
  void tell_outcomes(const Now& now);
  void begin_stop(const std::string& station, const std::string& name, Ticket ticket,
                  const Now& now);
  // For each of these stations, tells the viewer that controls it what another person has done to
  // it.
  void tell_holders(const std::vector<std::string>& stations, const char* what, const Person& by,
                    const Now& now);
  void look_at_incidents(const Now& now);
  void show_areas();
  void show_incident(const Incident& incident);
  void look_at_own_alarms(const Now& now);
  // Ends a request that needs no answer from a station: adds its event, and answers the viewer.
  void conclude(std::uint64_t id, std::int64_t number, const Alarm& what, const Now& now);
  // Why this viewer may not change anything; empty: the viewer may.
  Outcome change_refusal(std::uint64_t id) const;
  // The same for a change at a station.
  Outcome change_refusal(std::uint64_t id, const std::string& station) const;
  void forget_gone();
  void add_time(Json& message, const Now& now) const;

  SiteState site_;
  PendingOrders orders_;
  ControlLeases control_;
  Procedures procedures_;
  SeenSkylines skylines_;
  CueOrders cues_;
  IncidentBook incidents_;
  IncidentBook::News incident_news_;
  std::vector<Alarm> own_alarms_, incident_trouble_;
  Viewers viewers_;
  LatestPictures pictures_;
  std::map<std::string, std::string> video_addresses_;
  std::uint64_t messages_refused_ = 0;
  double stop_until_s_ = -1e9;
  std::string stopped_by_;
  Outcome bus_trouble_;
  ReplayState replay_;
};

}  // namespace ols::console
