#include "console/console.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "conditions/alarm_json.h"
#include "conditions/sayings.h"
#include "console/aiming.h"
#include "wire/cue_values.h"

namespace ols::console {
namespace {

constexpr double kHeartbeat_s = 1.0;
constexpr std::size_t kMostAnswers = 64;
// A link that was cut delivers late what was sent while it was: the hand has let go since.
constexpr std::int64_t kLateRate_us = 1'500'000;
constexpr std::int64_t kLateCommand_us = 3'000'000;
constexpr const char* kAll = "all";
constexpr std::size_t kMostReplayRequests = 64;  // of one turn

std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

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

void Console::hear(const StationHeard& station, const Now& now) {
  const bool is_new = !site_.knows(station.id);
  site_.hear(station, now);
  if (!site_.knows(station.id)) return;  // no room: a flood of invented names
  const bool is_news = station.is_stopped && !is_new && !orders_.is_stopped(station.id);
  if (is_news && !orders_.is_stopping(station.id)) tell_holders({station.id}, "stop", {}, now);
  orders_.hear(station.id, station.is_stopped);
  if (station.video_address.empty()) {
    video_addresses_.erase(station.id);
  } else {
    video_addresses_[station.id] = station.video_address;
  }
  if (is_new && now.monotonic_s < stop_until_s_) {
    begin_stop(station.id, stopped_by_, {.is_for_all = true}, now);
  }
}

void Console::hear(const TargetHeard& target, const Now& now) {
  site_.hear(target, now);
  if (is_replay() || !site_.counts_fusion(target.boot_id)) return;
  incidents_.hear(target, now.minute_of_day, now.monotonic_s);
}

void Console::hear_own(const std::vector<Alarm>& alarms, const Now& now) {
  own_alarms_ = alarms;
  look_at_own_alarms(now);
}

void Console::look_at_own_alarms(const Now& now) {
  std::vector<Alarm> alarms = own_alarms_;
  std::ranges::copy(incidents_.alarms(), std::back_inserter(alarms));
  std::ranges::copy(incident_trouble_, std::back_inserter(alarms));
  site_.hear_own(alarms, now);
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

// The track is long, and asked for by itself.
void Console::show_incident(const Incident& incident) {
  Json fields = json_of(incident);
  fields.erase("track");
  site_.set_incident(incident.number, fields);
}

// Nobody controls a station by having it record.
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

void Console::hear(const wire::Reply& reply) {
  orders_.hear(reply);
  cues_.hear(reply);
}

void Console::hear_bearing(const std::string& station, const Json& bearing) {
  site_.hear_bearing(station, bearing);
}

void Console::hear(Picture picture) {
  if (!site_.knows(picture.station)) return;
  pictures_.hear(std::move(picture));
}

void Console::hear(ProcedureHeard procedure) {
  if (!site_.knows(procedure.station)) return;
  const std::string station = procedure.station;
  site_.set_procedure(station, procedures_.hear(std::move(procedure)));
}

void Console::hear(const wire::Order& order, const Now& now) {
  const bool is_repeated =
      order.kind == wire::Kind::kStop && orders_.stop_event(order.station, "") != 0;
  if (is_repeated) return orders_.watch_again(order);
  if (!site_.knows(order.station)) return;
  const auto event = site_.note(event_of(order, "", now));
  const Outcome refusal =
      orders_.begin(order, {.event = event, .is_watched = true}, now.monotonic_s);
  if (!refusal.empty()) site_.conclude(event, refusal);
}

WatchedVideos Console::watched_video() const {
  WatchedVideos watched;
  for (const auto& [id, viewer] : viewers_) {
    for (const auto& [station, address] : video_addresses_) {
      if (viewer.view.watched.contains(station)) watched[{station, viewer.view.codec}] = address;
    }
  }
  return watched;
}

std::string Console::distinct(const std::string& name) const {
  std::string result = name;
  const auto is_taken = [&result](const auto& entry) { return entry.second.name == result; };
  for (int i = 2; std::ranges::any_of(viewers_, is_taken); ++i) {
    result = name + " " + std::to_string(i);
  }
  return result;
}

Person Console::person(const std::string& name, std::uint64_t viewer) const {
  const auto known = viewers_.find(viewer);
  if (known == viewers_.end() || known->second.account != name) return {name, 0};
  return {known->second.name, viewer};
}

std::uint64_t Console::open(const std::string& name, Role role) {
  Viewer viewer;
  viewer.name = distinct(name);
  viewer.account = name;
  viewer.role = role;
  viewers_.emplace(++viewer_numbers_, std::move(viewer));
  return viewer_numbers_;
}

void Console::close(std::uint64_t viewer) {
  viewers_.erase(viewer);
  control_.leave(viewer);
}

void Console::take(std::uint64_t viewer, std::string_view text, const Now& now) {
  if (!viewers_.contains(viewer)) return;
  std::visit([&](const auto& message) { act(viewer, message, now); }, parse_client_message(text));
}

void Console::answer(std::uint64_t id, std::int64_t number, const std::string& station,
                     const Outcome& refusal) {
  const auto viewer = viewers_.find(id);
  if (viewer == viewers_.end()) return;
  auto& answers = viewer->second.answers;
  answers.push_back(dumped({{"kind", "answer"},
                            {"number", number},
                            {"station", station},
                            {"accepted", refusal.empty()},
                            {"why", refusal.text},
                            {"refusal", refusal.empty() ? Json(nullptr) : Json(refusal)}}));
  if (answers.size() > kMostAnswers) answers.pop_front();
}

void Console::act(std::uint64_t id, const Refused& refused, const Now&) {
  ++messages_refused_;
  answer(id, refused.number, "", outcome::not_understood(refused.why));
}

void Console::act(std::uint64_t id, const ReplayRequest& request, const Now&) {
  if (!is_replay()) return answer(id, request.number, "", outcome::no_replay());
  if (replay_.requests.size() < kMostReplayRequests) replay_.requests.push_back(request);
}

void Console::act(std::uint64_t id, const AnswerRequest& request, const Now& now) {
  const Viewer& viewer = viewers_.at(id);
  const std::string& station = request.answer.station;
  if (is_replay()) return answer(id, request.number, station, outcome::not_in_a_replay());
  Outcome refusal = bus_trouble_;
  // Answers turn the unit: they need control as commands do, and may be as late, but for the one
  // that ends it all.
  const bool ends = request.answer.choice == "abort";
  if (viewer.role == Role::kViewer) {
    refusal = outcome::viewer_only_looks();
  } else if (refusal.empty() && !ends && is_late(request.heard_utime_us, now, kLateCommand_us)) {
    refusal = outcome::came_too_late();
  } else if (refusal.empty() && !ends && procedures_.has(station)) {
    refusal = control_.use(station, id, viewer.name, now.monotonic_s);
  }
  if (refusal.empty()) refusal = procedures_.answer(request.answer);
  if (refusal.empty()) {
    site_.note(noted(now.utime_us, "command", station, viewer.name,
                     note::answers(request.answer.choice), "sent"));
  }
  answer(id, request.number, station, refusal);
}

void Console::act(std::uint64_t id, const CueRequest& request, const Now& now) {
  const Viewer& viewer = viewers_.at(id);
  const bool allow = request.order.allow;
  const bool is_too_late = allow && is_late(request.heard_utime_us, now, kLateCommand_us);
  const Outcome refusal = is_replay()   ? outcome::not_in_a_replay()
                          : is_too_late ? outcome::came_too_late()
                                        : cues_.refusal(viewer.role, bus_trouble_);
  if (!refusal.empty()) return answer(id, request.number, "", refusal);
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

void Console::conclude(std::uint64_t id, std::int64_t number, const Alarm& what, const Now& now) {
  site_.note(noted(now.utime_us, "command", "", viewers_.at(id).name, what, "done"));
  answer(id, number, "", {});
}

void Console::act(std::uint64_t id, const AreaRequest& request, const Now& now) {
  Outcome refusal = change_refusal(id);
  if (refusal.empty()) refusal = incidents_.change(request.change);
  const bool is_removed = request.change.area.is_null();
  if (!refusal.empty()) return answer(id, request.number, "", refusal);
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
  if (!refusal.empty()) return answer(id, request.number, "", refusal);
  const Alarm what = verdict == Judgement::kConfirmed   ? note::confirms_incident(incident)
                     : verdict == Judgement::kDismissed ? note::dismisses_incident(incident)
                                                        : note::reopens_incident(incident);
  conclude(id, request.number, what, now);
}

void Console::act(std::uint64_t id, const AcknowledgeRequest& request, const Now&) {
  const Viewer& viewer = viewers_.at(id);
  if (is_replay()) return answer(id, request.number, "", outcome::not_in_a_replay());
  if (viewer.role == Role::kViewer) {
    return answer(id, request.number, "", outcome::viewer_only_looks());
  }
  const bool is_there = site_.acknowledge(request.event, viewer.name);
  answer(id, request.number, "", is_there ? Outcome() : outcome::no_such_alarm());
}

void Console::act(std::uint64_t id, const NameRequest& request, const Now& now) {
  const Viewer& viewer = viewers_.at(id);
  const auto& [number, target, name] = request;
  Outcome refusal;
  if (is_replay()) {
    refusal = outcome::not_in_a_replay();
  } else if (viewer.role == Role::kViewer) {
    refusal = outcome::viewer_only_looks();
  } else if (!site_.name_target(target, name)) {
    refusal = outcome::no_such_target();
  } else {
    const Alarm what = note::calls_target(target, name.empty() ? target : name);
    site_.note(noted(now.utime_us, "command", "", viewer.name, what, "done"));
  }
  answer(id, number, "", refusal);
}

void Console::act(std::uint64_t id, const WatchRequest& request, const Now&) {
  LatestPictures::View& view = viewers_.at(id).view;
  view.watched = {request.stations.begin(), request.stations.end()};
  // A browser that begins with a stream has had nothing of it.
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
  const Viewer& viewer = viewers_.at(id);
  if (is_replay()) return answer(id, request.number, request.station, outcome::not_in_a_replay());
  if (viewer.role == Role::kViewer) {
    return answer(id, request.number, request.station, outcome::viewer_only_looks());
  }
  if (!site_.knows(request.station)) {
    return answer(id, request.number, request.station, outcome::no_such_station());
  }
  if (request.take && is_late(request.heard_utime_us, now, kLateCommand_us)) {
    return answer(id, request.number, request.station, outcome::came_too_late());
  }
  if (request.take) {
    tell_holders({request.station}, "take", {viewer.name, id}, now);
    control_.take(request.station, id, viewer.name, now.monotonic_s);
    site_.note(noted(now.utime_us, "command", request.station, viewer.name, note::takes_control(),
                     "done"));
  } else {
    control_.give_up(request.station, id);
  }
  answer(id, request.number, request.station, {});
}

void Console::act(std::uint64_t id, const CommandRequest& request, const Now& now) {
  const Viewer& viewer = viewers_.at(id);
  wire::Order order = request.order;
  if (is_replay()) return answer(id, request.number, order.station, outcome::not_in_a_replay());
  if (order.kind == wire::Kind::kStop) {
    if (!site_.knows(order.station)) {
      return answer(id, request.number, order.station, outcome::no_such_station());
    }
    tell_holders({order.station}, "stop", {viewer.name, id}, now);
    return begin_stop(order.station, viewer.name, {.viewer = id, .number = request.number}, now);
  }
  // Neither is history: it would push out what has happened.
  if (viewer.role == Role::kViewer) {
    return answer(id, request.number, order.station, outcome::viewer_only_looks());
  }
  if (!site_.knows(order.station)) {
    return answer(id, request.number, order.station, outcome::no_such_station());
  }
  const std::int64_t late_us = wire::is_joystick(order) ? kLateRate_us : kLateCommand_us;
  if (is_late(request.heard_utime_us, now, late_us)) {
    return answer(id, request.number, order.station, outcome::came_too_late());
  }
  if (request.place) {
    const auto angles = aim_at_place(*site_.fields_of(order.station), *request.place);
    if (!angles) return answer(id, request.number, order.station, outcome::out_of_reach());
    order.pan_rad = angles->pan_rad;
    order.tilt_rad = angles->tilt_rad;
  }
  Outcome refusal = control_.use(order.station, id, viewer.name, now.monotonic_s);
  // A hold is one event, however often it is renewed.
  const bool continues = orders_.is_held(order, now.monotonic_s);
  const auto event = continues ? 0 : site_.note(event_of(order, viewer.name, now));
  if (refusal.empty()) {
    refusal = orders_.begin(order, {id, request.number, event, viewer.name}, now.monotonic_s);
  }
  if (refusal.empty()) return;
  site_.conclude(event, refusal);
  answer(id, request.number, order.station, refusal);
}

void Console::act(std::uint64_t id, const StopAllRequest& request, const Now& now) {
  if (is_replay()) return answer(id, request.number, kAll, outcome::not_in_a_replay());
  const Person by{viewers_.at(id).name, id};
  const bool is_nobody = stop_all(by, {.viewer = id, .number = request.number}, now).empty();
  if (!bus_trouble_.empty()) {
    answer(id, request.number, kAll, bus_trouble_);
  } else if (is_nobody) {
    answer(id, request.number, kAll, outcome::stop_reaches_nobody());
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
  if (!refusal.empty()) answer(ticket.viewer, ticket.number, station, refusal);
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
    const auto viewer = viewers_.find(holder);
    if (viewer == viewers_.end()) continue;
    viewer->second.answers.push_back(
        dumped({{"kind", "hand"}, {"what", what}, {"by", by.name}, {"stations", std::move(of)}}));
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
  for (auto& [id, viewer] : viewers_) {
    std::erase_if(viewer.view.sent, [&](const auto& sent) { return !is_known(sent.first); });
  }
}

void Console::tell_all(const Json& message) {
  for (auto& [id, viewer] : viewers_) {
    viewer.answers.push_back(dumped(message));
    if (viewer.answers.size() > kMostAnswers) viewer.answers.pop_front();
  }
}

void Console::tell_outcomes(const Now& now) {
  std::set<std::string> unconfirmed;
  std::vector<Verdict> verdicts = orders_.finished(now.monotonic_s);
  std::ranges::move(cues_.finished(now.monotonic_s), std::back_inserter(verdicts));
  for (const Verdict& verdict : verdicts) {
    site_.conclude(verdict.ticket.event, verdict.why);
    answer(verdict.ticket.viewer, verdict.ticket.number, verdict.station, verdict.why);
    if (verdict.ticket.is_for_all && !verdict.why.empty()) unconfirmed.insert(verdict.station);
  }
  if (!unconfirmed.empty()) tell_all({{"kind", "stop_unconfirmed"}, {"stations", unconfirmed}});
}

void Console::replay_is(const Json& state, bool is_urgent) {
  replay_.state = state;
  bus_trouble_ = outcome::not_in_a_replay();
  if (!is_urgent) return;
  for (auto& [id, viewer] : viewers_) viewer.sent_s = -1e9;
}

Moment Console::moment() const { return {site_, orders_, pictures_.newest()}; }

void Console::show(const Moment& moment) {
  site_ = moment.site;
  orders_ = moment.orders;
  pictures_.show(moment.pictures);
  for (auto& [id, viewer] : viewers_) {
    viewer.sent = 0;
    viewer.sent_s = -1e9;
  }
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

Outgoing Console::greeting(std::uint64_t id, Viewer& viewer, const Now& now) const {
  viewer.is_greeted = true;
  return {false, dumped({{"kind", "hello"},
                         {"viewer", id},
                         {"name", viewer.name},
                         {"role", std::string(console::name(viewer.role))},
                         {"time_us", now.utime_us}})};
}

std::optional<Outgoing> Console::next(std::uint64_t id, const Now& now) {
  const auto found = viewers_.find(id);
  if (found == viewers_.end()) return std::nullopt;
  Viewer& viewer = found->second;
  if (!viewer.is_greeted) return greeting(id, viewer, now);
  if (!viewer.answers.empty()) {
    Outgoing out{false, std::move(viewer.answers.front())};
    viewer.answers.pop_front();
    return out;
  }
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

// The time that is shown: of a replay that of the recording.
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
