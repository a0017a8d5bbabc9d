// The console without its sockets: the site's state, the viewers, what each is sent next, and the
// commands. Pure: time, messages and texts come in, orders and texts go out.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
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
#include "console/site_state.h"
#include "console/users.h"

namespace ols::console {

// A WebSocket message to a browser.
struct Outgoing {
  bool is_binary = false;
  std::string bytes;
};

// The state of a replay at one instant.
struct Moment {
  SiteState site;
  PendingOrders orders;
  std::map<std::string, Picture> pictures;
};

// Who gives an order.
struct Person {
  std::string name;          // empty: nobody known to this console
  std::uint64_t viewer = 0;  // the browser; 0: unknown
};

class Console {
 public:
  explicit Console(double control_timeout_s, const IncidentRecording& recording = {})
      : control_(control_timeout_s), incidents_(recording) {}

  void hear(const StationHeard& station, const Now& now);
  void hear(const TargetHeard& target, const Now& now);
  void hear(const FusionHeard& fusion, const Now& now) { site_.hear(fusion, now); }
  void hear_bearing(const std::string& station, const Json& bearing);
  void hear(Picture picture);
  void hear(ProcedureHeard procedure);

  // Somebody's order in a recording, for the events of a replay.
  void hear(const wire::Order& order, const Now& now);
  // To an order: of turn(), whose boot is 0, or of the log.
  void hear(const wire::Reply& reply);

  // The newest picture (JPEG) of a station's guided procedure; null: there is none.
  const std::string* procedure_picture(const std::string& station) const {
    return procedures_.picture(station);
  }
  // People's answers to procedures since the last call.
  std::vector<ProcedureAnswer> take_answers() { return procedures_.take(); }

  // Operators' decisions on cues since the last call.
  std::vector<wire::CueOrder> take_cue_orders() { return cues_.take(); }

  // The videos that somebody watches.
  WatchedVideos watched_video() const;

  // The alarms of the console itself.
  void hear_own(const std::vector<Alarm>& alarms, const Now& now);

  // Before anything else: the areas and incidents that were kept.
  void resume(KeptIncidents kept, const Now& now);
  const IncidentBook& incidents() const { return incidents_; }
  // What is to be written and sent of them since the last call of turn(), and what of it failed.
  const IncidentBook::News& incident_news() const { return incident_news_; }
  void incident_trouble(const std::vector<Alarm>& alarms) { incident_trouble_ = alarms; }

  // A browser has opened its WebSocket; returns its number. A second one of the same name is "ana
  // 2".
  std::uint64_t open(const std::string& name, Role role);
  void close(std::uint64_t viewer);
  void take(std::uint64_t viewer, std::string_view text, const Now& now);
  // The next message for this viewer, once the last one is through; nullopt: nothing new. It holds
  // the newest state, never a queue.
  std::optional<Outgoing> next(std::uint64_t viewer, const Now& now);

  // Why no order goes out; empty: orders go out.
  void bus_is(const Alarm& trouble) { bus_trouble_ = trouble; }
  const Outcome& bus_trouble() const { return bus_trouble_; }

  // Stops every station, also those that are first heard within the next seconds. Returns their
  // ids. All viewers are told which stations do not confirm it.
  std::vector<std::string> stop_all(const Person& by, const Ticket& ticket, const Now& now);
  // Who makes a request outside of the WebSocket: this browser, if it belongs to that name.
  Person person(const std::string& name, std::uint64_t viewer) const;

  // Call often: outcomes, control, ages. Returns the orders to be sent now.
  std::vector<wire::Order> turn(const Now& now);

  // This console shows a replay. From now on no order goes out, and every message has the replay's
  // state. `is_urgent`: viewers get it at once.
  void replay_is(const Json& state, bool is_urgent);
  void timeline_is(const Json& timeline) { replay_.timeline = timeline; }
  bool is_replay() const { return !replay_.state.is_null(); }
  const Json& timeline() const { return replay_.timeline; }
  // Viewers' requests to the replay since the last call.
  std::vector<ReplayRequest> take_replay_requests() { return std::exchange(replay_.requests, {}); }
  Moment moment() const;
  // Shows this moment to every viewer, as a whole.
  void show(const Moment& moment);
  Json events_since(Revision revision) const { return site_.events_since(revision); }
  Revision revision() const { return site_.revision(); }

  Json state(const Now& now) const;
  Json health(const Now& now) const;
  // For the history: what somebody did in this console, or "": what happened.
  void note(const std::string& who, const Alarm& what, const Now& now);
  std::size_t viewers() const { return viewers_.size(); }

  // 20 Hz, less a turn's jitter. At 10 Hz a new position would wait for up to 0.1 s.
  static constexpr double kDeltaPeriod_s = 0.045;

 private:
  struct Viewer {
    std::string name, account;  // "ana 2", "ana"
    Role role = Role::kViewer;
    bool is_greeted = false;
    Revision sent = 0;
    double sent_s = -1e9;
    LatestPictures::View view;
    std::deque<std::string> answers;
  };
  struct ReplayState {
    Json state, timeline;  // null: this is no replay
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
  void answer(std::uint64_t id, std::int64_t number, const std::string& station,
              const Outcome& refusal);
  void tell_all(const Json& message);
  void tell_outcomes(const Now& now);
  void begin_stop(const std::string& station, const std::string& name, Ticket ticket,
                  const Now& now);
  std::string distinct(const std::string& name) const;
  // Tells whoever controls one of these stations what another person has done there.
  void tell_holders(const std::vector<std::string>& stations, const char* what, const Person& by,
                    const Now& now);
  void look_at_incidents(const Now& now);
  void show_areas();
  void show_incident(const Incident& incident);
  void look_at_own_alarms(const Now& now);
  // A change that needs no station was made: its event and its answer.
  void conclude(std::uint64_t id, std::int64_t number, const Alarm& what, const Now& now);
  // Why this viewer may change nothing; empty: may.
  Outcome change_refusal(std::uint64_t id) const;
  void forget_gone();
  void add_time(Json& message, const Now& now) const;
  Outgoing greeting(std::uint64_t id, Viewer& viewer, const Now& now) const;

  SiteState site_;
  PendingOrders orders_;
  ControlLeases control_;
  Procedures procedures_;
  CueOrders cues_;
  IncidentBook incidents_;
  IncidentBook::News incident_news_;
  std::vector<Alarm> own_alarms_, incident_trouble_;
  std::map<std::uint64_t, Viewer> viewers_;
  LatestPictures pictures_;
  std::map<std::string, std::string> video_addresses_;
  std::uint64_t viewer_numbers_ = 0;
  std::uint64_t messages_refused_ = 0;
  double stop_until_s_ = -1e9;
  std::string stopped_by_;
  Outcome bus_trouble_;
  ReplayState replay_;
};

}  // namespace ols::console
