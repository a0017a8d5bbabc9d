#include "console/console.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "conditions/sayings.h"
#include "console/aiming.h"
#include "wire/cue_values.h"

namespace ols::console {
namespace {

constexpr double kHeartbeat_s = 1.0;
// After an interruption, a link delivers old commands: the operator may have let go since.
constexpr std::int64_t kLateRate_us = 1'500'000;
constexpr std::int64_t kLateCommand_us = 3'000'000;
constexpr const char* kAll = "all";
constexpr std::size_t kMostReplayRequests = 64;  // of one turn

bool is_late(const std::optional<std::int64_t>& heard_utime_us, const Now& now,
             std::int64_t limit_us) {
  return heard_utime_us && now.utime_us - *heard_utime_us > limit_us;
}

// The page has the names of orders.
Event event_of(const wire::Order& order, const std::string& who, const Now& now) {
  if (order.kind == wire::Kind::kRecord) {
    return noted(now.utime_us, "command", order.station, who, note::records(order.label));
  }
  return {now.utime_us, "command", order.station, who, std::string(wire::name(order.kind)), ""};
}

}  // namespace

void Console::receive(const ReceivedStation& station, const Now& now) {
  const bool is_new = !site_.knows(station.id);
  site_.receive(station, now);
  if (!site_.knows(station.id)) return;  // no room: a flood of invented names
  const bool is_news = station.is_stopped && !is_new && !orders_.is_stopped(station.id);
  if (is_news && !orders_.is_stopping(station.id)) tell_holders({station.id}, "stop", {}, now);
  orders_.receive(station.id, station.is_stopped);
  if (station.video_address.empty()) {
    video_addresses_.erase(station.id);
  } else {
    video_addresses_[station.id] = station.video_address;
  }
  if (is_new && now.monotonic_s < stop_until_s_) {
    begin_stop(station.id, stopped_by_, {.is_for_all = true}, now);
  }
}

void Console::receive(const ReceivedTarget& target, const Now& now) {
  site_.receive(target, now);
  if (is_replay() || !site_.counts_fusion(target.boot_id)) return;
  incidents_.receive(target, now.minute_of_day, now.monotonic_s);
}

void Console::receive_own(const std::vector<Alarm>& alarms, const Now& now) {
  own_alarms_ = alarms;
  look_at_own_alarms(now);
}

void Console::look_at_own_alarms(const Now& now) {
  std::vector<Alarm> alarms = own_alarms_;
  std::ranges::copy(incidents_.alarms(), std::back_inserter(alarms));
  std::ranges::copy(incident_trouble_, std::back_inserter(alarms));
  site_.receive_own(alarms, now);
}

void Console::resume(KeptIncidents kept, const Now& now) {
  incidents_.resume(std::move(kept), now.monotonic_s);
  show_areas();
  for (const auto& [number, incident] : incidents_.watch().incidents()) show_incident(incident);
}

void Console::show_areas() {
  Json areas = Json::array();
  for (const Area& area : incidents_.watch().areas()) areas.push_back(json_of(area));
  site_.set_areas(areas);
}

// The track is long, so the page asks for it separately.
void Console::show_incident(const Incident& incident) {
  Json fields = json_of(incident);
  fields.erase("track");
  site_.set_incident(incident.number, fields);
}

// To make a station record, nobody needs control of it.
void Console::look_at_incidents(const Now& now) {
  incidents_.turn(now.monotonic_s,
                  [this](const std::string& station) { return pictures_.newest(station); });
  incident_news_ = incidents_.take_news();
  const IncidentWatch& watch = incidents_.watch();
  if (incident_news_.areas) show_areas();
  for (const std::uint64_t number : incident_news_.forgotten) site_.set_incident(number, nullptr);
  for (const std::uint64_t number : incident_news_.incidents) {
    const auto incident = watch.incidents().find(number);
    if (incident != watch.incidents().end()) show_incident(incident->second);
  }
  for (const wire::Order& order : incidents_.take_recordings()) {
    const auto event = site_.note(event_of(order, "", now));
    const auto refusal = orders_.begin(order, {.event = event}, now.monotonic_s);
    if (!refusal.empty()) site_.conclude(event, refusal);
  }
}

void Console::receive(const wire::Reply& reply) {
  orders_.receive(reply);
  cues_.receive(reply);
}

void Console::receive(const ReceivedSkyline& skyline) {
  if (site_.knows(skyline.station)) skylines_.receive(skyline);
}

void Console::receive_bearing(const std::string& station, const Json& bearing) {
  site_.receive_bearing(station, bearing);
}

void Console::receive(Picture picture) {
  if (!site_.knows(picture.station)) return;
  pictures_.receive(std::move(picture));
}

void Console::receive(ReceivedProcedure procedure) {
  if (!site_.knows(procedure.station)) return;
  const std::string station = procedure.station;
  site_.set_procedure(station, procedures_.receive(std::move(procedure)));
}

void Console::receive(const wire::Order& order, const Now& now) {
  const bool is_repeated =
      order.kind == wire::Kind::kStop && orders_.stop_event(order.station, "") != 0;
  if (is_repeated) return orders_.watch_again(order);
  if (!site_.knows(order.station)) return;
  const auto event = site_.note(event_of(order, "", now));
  const Outcome refusal =
      orders_.begin(order, {.event = event, .is_watched = true}, now.monotonic_s);
  if (!refusal.empty()) site_.conclude(event, refusal);
}

void Console::close(std::uint64_t viewer) {
  viewers_.close(viewer);
  control_.leave(viewer);
}

void Console::take(std::uint64_t viewer, std::string_view text, const Now& now) {
  if (viewers_.find(viewer) == nullptr) return;
  std::visit([&](const auto& message) { act(viewer, message, now); }, parse_client_message(text));
}

void Console::act(std::uint64_t id, const Refused& refused, const Now&) {
  ++messages_refused_;
  viewers_.answer(id, refused.number, "", outcome::not_understood(refused.why));
}

void Console::act(std::uint64_t id, const ReplayRequest& request, const Now&) {
  if (!is_replay()) return viewers_.answer(id, request.number, "", outcome::no_replay());
  if (replay_.requests.size() < kMostReplayRequests) replay_.requests.push_back(request);
}

void Console::act(std::uint64_t id, const AnswerRequest& request, const Now& now) {
  const Viewer& viewer = viewers_.at(id);
  const std::string& station = request.answer.station;
  Outcome refusal = change_refusal(id);
  // Answers turn the unit: like commands, they need control and must not be late. Only "abort" is
  // exempt.
  const bool ends = request.answer.choice == "abort";
  if (refusal.empty()) refusal = bus_trouble_;
  if (refusal.empty() && !ends && is_late(request.heard_utime_us, now, kLateCommand_us)) {
    refusal = outcome::came_too_late();
  } else if (refusal.empty() && !ends && procedures_.has(station)) {
    refusal = control_.use(station, id, viewer.name, now.monotonic_s);
  }
  if (refusal.empty()) refusal = procedures_.answer(request.answer);
  if (refusal.empty()) {
    site_.note(noted(now.utime_us, "command", station, viewer.name,
                     note::answers(request.answer.choice), "sent"));
  }
  viewers_.answer(id, request.number, station, refusal);
}

void Console::act(std::uint64_t id, const CueRequest& request, const Now& now) {
  const Viewer& viewer = viewers_.at(id);
  const bool allow = request.order.allow;
  const bool is_too_late = allow && is_late(request.heard_utime_us, now, kLateCommand_us);
  const Outcome refusal = is_replay()   ? outcome::not_in_a_replay()
                          : is_too_late ? outcome::came_too_late()
                                        : cues_.refusal(viewer.role, bus_trouble_);
  if (!refusal.empty()) return viewers_.answer(id, request.number, "", refusal);
  const bool is_target = target_named(request.order.cue).has_value();
  const std::string& cue = request.order.cue;
  const std::string& mode = request.order.handover;
  const Alarm what = !mode.empty() ? note::sets_handover(mode)
                     : is_target ? (allow ? note::allows_target(cue) : note::dismisses_target(cue))
                                 : (allow ? note::allows_cue(cue) : note::forbids_cue(cue));
  const auto event = site_.note(noted(now.utime_us, "command", "", viewer.name, what, "sent"));
  cues_.give(request.order, {id, request.number, event}, now.monotonic_s);
}

Outcome Console::change_refusal(std::uint64_t id) const {
  if (is_replay()) return outcome::not_in_a_replay();
  const bool may = viewers_.at(id).role != Role::kViewer;
  return may ? Outcome() : outcome::viewer_only_looks();
}

Outcome Console::change_refusal(std::uint64_t id, const std::string& station) const {
  const Outcome refusal = change_refusal(id);
  if (!refusal.empty() || site_.knows(station)) return refusal;
  return outcome::no_such_station();
}

void Console::conclude(std::uint64_t id, std::int64_t number, const Alarm& what, const Now& now) {
  site_.note(noted(now.utime_us, "command", "", viewers_.at(id).name, what, "done"));
  viewers_.answer(id, number, "", {});
}

void Console::act(std::uint64_t id, const AreaRequest& request, const Now& now) {
  Outcome refusal = change_refusal(id);
  if (refusal.empty()) refusal = incidents_.change(request.change);
  const bool is_removed = request.change.area.is_null();
  if (!refusal.empty()) return viewers_.answer(id, request.number, "", refusal);
  const Alarm what = is_removed ? note::removes_area(request.change.name)
                                : note::sets_area(request.change.area.at("name"));
  conclude(id, request.number, what, now);
}

void Console::act(std::uint64_t id, const JudgeRequest& request, const Now& now) {
  const auto& [incident, verdict] = request.judgement;
  Outcome refusal = change_refusal(id);
  if (refusal.empty()) {
    refusal = incidents_.judge(request.judgement, viewers_.at(id).name, now.utime_us);
  }
  if (!refusal.empty()) return viewers_.answer(id, request.number, "", refusal);
  const Alarm what = verdict == Judgement::kConfirmed   ? note::confirms_incident(incident)
                     : verdict == Judgement::kDismissed ? note::dismisses_incident(incident)
                                                        : note::reopens_incident(incident);
  conclude(id, request.number, what, now);
}

void Console::act(std::uint64_t id, const AcknowledgeRequest& request, const Now&) {
  Outcome refusal = change_refusal(id);
  if (refusal.empty() && !site_.acknowledge(request.event, viewers_.at(id).name))
    refusal = outcome::no_such_alarm();
  viewers_.answer(id, request.number, "", refusal);
}

void Console::act(std::uint64_t id, const NameRequest& request, const Now& now) {
  const auto& [number, target, name] = request;
  Outcome refusal = change_refusal(id);
  if (refusal.empty() && !site_.name_target(target, name)) refusal = outcome::no_such_target();
  if (!refusal.empty()) return viewers_.answer(id, number, "", refusal);
  conclude(id, number, note::calls_target(target, name.empty() ? target : name), now);
}

void Console::act(std::uint64_t id, const WatchRequest& request, const Now&) {
  LatestPictures::View& view = viewers_.at(id).view;
  view.watched = {request.stations.begin(), request.stations.end()};
  // A browser that begins with a stream has no part of it yet.
  if (view.codec != request.codec) view.sent.clear();
  std::erase_if(view.sent,
                [&view](const auto& sent) { return !view.watched.contains(sent.first); });
  view.codec = request.codec;
}

void Console::act(std::uint64_t id, const TakenRequest& request, const Now&) {
  UnderWay& under_way = viewers_.at(id).view.under_way;
  for (const std::string& station : request.stations) under_way.taken(station);
  if (request.state) under_way.taken(UnderWay::kState);
}

void Console::act(std::uint64_t id, const ControlRequest& request, const Now& now) {
  const std::string& station = request.station;
  const std::string& name = viewers_.at(id).name;
  Outcome refusal = change_refusal(id, station);
  if (refusal.empty() && request.take && is_late(request.heard_utime_us, now, kLateCommand_us))
    refusal = outcome::came_too_late();
  if (!refusal.empty()) return viewers_.answer(id, request.number, station, refusal);
  if (request.take) {
    tell_holders({station}, "take", {name, id}, now);
    control_.take(station, id, name, now.monotonic_s);
    site_.note(noted(now.utime_us, "command", station, name, note::takes_control(), "done"));
  } else {
    control_.give_up(station, id);
  }
  viewers_.answer(id, request.number, station, {});
}

void Console::act(std::uint64_t id, const CommandRequest& request, const Now& now) {
  const Viewer& viewer = viewers_.at(id);
  wire::Order order = request.order;
  if (is_replay())
    return viewers_.answer(id, request.number, order.station, outcome::not_in_a_replay());
  if (order.kind == wire::Kind::kStop) {
    if (!site_.knows(order.station)) {
      return viewers_.answer(id, request.number, order.station, outcome::no_such_station());
    }
    tell_holders({order.station}, "stop", {viewer.name, id}, now);
    return begin_stop(order.station, viewer.name, {.viewer = id, .number = request.number}, now);
  }
  const std::int64_t late_us = wire::is_joystick(order) ? kLateRate_us : kLateCommand_us;
  Outcome refusal = change_refusal(id, order.station);
  if (refusal.empty() && is_late(request.heard_utime_us, now, late_us))
    refusal = outcome::came_too_late();
  // Such refusals are not recorded: they would push real events out of the history.
  if (!refusal.empty()) return viewers_.answer(id, request.number, order.station, refusal);
  if (request.place) {
    const auto angles = aim_at_place(*site_.fields_of(order.station), *request.place);
    if (!angles) return viewers_.answer(id, request.number, order.station, outcome::out_of_reach());
    order.pan_rad = angles->pan_rad;
    order.tilt_rad = angles->tilt_rad;
  }
  refusal = control_.use(order.station, id, viewer.name, now.monotonic_s);
  // A hold is one event, however often it is renewed.
  const bool continues = orders_.is_held(order, now.monotonic_s);
  const auto event = continues ? 0 : site_.note(event_of(order, viewer.name, now));
  if (refusal.empty()) {
    refusal = orders_.begin(order, {id, request.number, event, viewer.name}, now.monotonic_s);
  }
  if (refusal.empty()) return;
  site_.conclude(event, refusal);
  viewers_.answer(id, request.number, order.station, refusal);
}

void Console::act(std::uint64_t id, const StopAllRequest& request, const Now& now) {
  if (is_replay()) return viewers_.answer(id, request.number, kAll, outcome::not_in_a_replay());
  const Person by{viewers_.at(id).name, id};
  const bool is_nobody = stop_all(by, {.viewer = id, .number = request.number}, now).empty();
  if (!bus_trouble_.empty()) {
    viewers_.answer(id, request.number, kAll, bus_trouble_);
  } else if (is_nobody) {
    viewers_.answer(id, request.number, kAll, outcome::stop_reaches_nobody());
  }
}

void Console::begin_stop(const std::string& station, const std::string& name, Ticket ticket,
                         const Now& now) {
  const wire::Order order{.station = station, .kind = wire::Kind::kStop};
  ticket.who = name;
  ticket.event = orders_.stop_event(station, name);
  if (ticket.event == 0) {
    ticket.event = site_.note({now.utime_us, "command", station, name, "stop", ""});
  }
  const Outcome refusal = orders_.begin(order, ticket, now.monotonic_s);
  if (!refusal.empty()) viewers_.answer(ticket.viewer, ticket.number, station, refusal);
}

void Console::tell_holders(const std::vector<std::string>& stations, const char* what,
                           const Person& by, const Now& now) {
  std::map<std::uint64_t, Json> told;
  for (const std::string& station : stations) {
    const std::uint64_t holder = control_.holder(station, now.monotonic_s);
    // A stop of all comes twice, by the WebSocket and by a request.
    const bool is_again = !by.name.empty() && orders_.stop_event(station, by.name) != 0;
    const bool is_known = by.viewer == holder || (is_again && std::string_view(what) == "stop");
    if (holder != 0 && !is_known) told[holder].push_back(station);
  }
  for (auto& [holder, of] : told) {
    viewers_.tell(holder,
                  {{"kind", "hand"}, {"what", what}, {"by", by.name}, {"stations", std::move(of)}});
  }
}

std::vector<std::string> Console::stop_all(const Person& by, const Ticket& ticket, const Now& now) {
  stop_until_s_ = now.monotonic_s + PendingOrders::kStopPatience_s;
  stopped_by_ = by.name;
  std::vector<std::string> stations = site_.station_ids();
  tell_holders(stations, "stop", by, now);
  Ticket for_all = ticket;
  for_all.is_for_all = true;
  for (const std::string& station : stations) begin_stop(station, by.name, for_all, now);
  return stations;
}

void Console::forget_gone() {
  const auto is_known = [this](const std::string& id) { return site_.knows(id); };
  orders_.keep_only(is_known);
  procedures_.keep_only(is_known);
  pictures_.keep_only(is_known);
  std::erase_if(video_addresses_, [&](const auto& video) { return !is_known(video.first); });
  viewers_.keep_only(is_known);
}

void Console::tell_outcomes(const Now& now) {
  std::set<std::string> unconfirmed;
  std::vector<Verdict> verdicts = orders_.finished(now.monotonic_s);
  std::ranges::move(cues_.finished(now.monotonic_s), std::back_inserter(verdicts));
  for (const Verdict& verdict : verdicts) {
    site_.conclude(verdict.ticket.event, verdict.why);
    viewers_.answer(verdict.ticket.viewer, verdict.ticket.number, verdict.station, verdict.why);
    if (verdict.ticket.is_for_all && !verdict.why.empty()) unconfirmed.insert(verdict.station);
  }
  if (!unconfirmed.empty())
    viewers_.tell_all({{"kind", "stop_unconfirmed"}, {"stations", unconfirmed}});
}

void Console::replay_is(const Json& state, bool is_urgent) {
  replay_.state = state;
  bus_trouble_ = outcome::not_in_a_replay();
  if (is_urgent) viewers_.renew(false);
}

Moment Console::moment() const { return {site_, orders_, pictures_.newest(), skylines_}; }

void Console::show(const Moment& moment) {
  site_ = moment.site;
  orders_ = moment.orders;
  pictures_.show(moment.pictures);
  skylines_ = moment.skylines;
  viewers_.renew(true);
}

std::vector<wire::Order> Console::turn(const Now& now) {
  site_.look(now);
  look_at_incidents(now);
  look_at_own_alarms(now);
  forget_gone();
  tell_outcomes(now);
  for (const auto& [station, holder] : control_.changes(now.monotonic_s)) {
    site_.set_holder(
        station, holder ? Json{{"by", holder->name}, {"viewer", holder->viewer}} : Json(nullptr));
  }
  return orders_.due(now.monotonic_s);
}

std::optional<Outgoing> Console::next(std::uint64_t id, const Now& now) {
  Viewer* const found = viewers_.find(id);
  if (found == nullptr) return std::nullopt;
  if (auto text = viewers_.next_text(id, now.utime_us)) return Outgoing{false, std::move(*text)};
  Viewer& viewer = *found;
  const double since_s = now.monotonic_s - viewer.sent_s;
  const bool has_news = viewer.sent < site_.revision() && since_s >= kDeltaPeriod_s;
  UnderWay& under_way = viewer.view.under_way;
  if ((has_news || since_s >= kHeartbeat_s) && under_way.may(UnderWay::kState)) {
    under_way.sent(UnderWay::kState);
    Json message = viewer.sent == 0 ? site_.snapshot() : site_.changes(viewer.sent);
    add_time(message, now);
    viewer.sent = site_.revision();
    viewer.sent_s = now.monotonic_s;
    return Outgoing{false, dumped(message)};
  }
  if (auto picture = pictures_.next(viewer.view)) return Outgoing{true, std::move(*picture)};
  return std::nullopt;
}

// The time that is shown: in a replay, that of the recording.
void Console::add_time(Json& message, const Now& now) const {
  message["local_minute"] = now.minute_of_day;
  message["time_us"] = is_replay() ? replay_.state.at("at_us") : Json(now.utime_us);
  if (is_replay()) message["replay"] = replay_.state;
}

Json Console::state(const Now& now) const {
  Json state = site_.snapshot();
  state.erase("kind");
  add_time(state, now);
  return state;
}

Json Console::health(const Now& now) const {
  Json health = site_.counts();
  health["ok"] = true;
  health["time_us"] = now.utime_us;
  health["replay"] = is_replay();
  health["viewers"] = viewers_.size();
  health["messages_refused"] = messages_refused_;
  health["names_refused"] = site_.refused();
  return health;
}

void Console::note(const std::string& who, const Alarm& what, const Now& now) {
  if (!is_replay()) site_.note(noted(now.utime_us, "console", "", who, what));
}

}  // namespace ols::console
