#include "console/console.h"

#include <algorithm>
#include <utility>

#include "base/length_prefix.h"

namespace ols::console {
namespace {

constexpr double kHeartbeat_s = 1.0;
constexpr std::size_t kMostAnswers = 64;
// A link that was cut delivers late what was sent while it was: the hand has let go since.
constexpr std::int64_t kLateRate_us = 1'500'000;
constexpr const char* kAll = "all";
constexpr const char* kReplay = "this is a replay: no command goes out";
constexpr std::size_t kMostReplayRequests = 64;  // of one turn

std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string words(const command::Order& order) {
  std::string text(command::name(order.kind));
  if (order.kind == command::Kind::kRecord) text += " " + order.label;
  return text;
}

// Pictures of the video are larger and more; the preview is for stations without.
bool is_preview_beside_video(const Picture& picture, const Picture& newest) {
  constexpr std::int64_t kVideoIsAlive_us = 3'000'000;
  if (picture.is_video || !newest.is_video) return false;
  const auto utime_us = [](const Picture& p) {
    return p.header.value("utime_us", std::int64_t{0});
  };
  return utime_us(picture) - utime_us(newest) < kVideoIsAlive_us;
}

}  // namespace

void Console::hear(const StationHeard& station, const Now& now) {
  const bool is_new = !site_.knows(station.id);
  site_.hear(station, now);
  if (!site_.knows(station.id)) return;  // no room: a flood of invented names
  desk_.hear(station.id, station.reply);
  if (station.video_address.empty()) {
    video_addresses_.erase(station.id);
  } else {
    video_addresses_[station.id] = station.video_address;
  }
  if (is_new && now.monotonic_s < stop_until_s_) {
    begin_stop(station.id, stopped_by_, {.is_for_all = true}, now);
  }
}

void Console::hear_bearing(const std::string& station, const Json& bearing) {
  site_.hear_bearing(station, bearing);
}

void Console::hear(Picture picture) {
  if (!site_.knows(picture.station)) return;
  Kept& kept = pictures_[picture.station];
  if (is_preview_beside_video(picture, kept.picture)) return;
  kept.number = ++picture_numbers_;
  kept.picture = std::move(picture);
}

void Console::hear(ProcedureHeard procedure) {
  if (!site_.knows(procedure.station)) return;
  const std::string station = procedure.station;
  site_.set_procedure(station, procedures_.hear(std::move(procedure)));
}

void Console::hear(const command::Order& order, const Now& now) {
  const bool is_repeated =
      order.kind == command::Kind::kStop && desk_.stop_event(order.station, "") != 0;
  if (is_repeated || !site_.knows(order.station)) return;
  const auto event = site_.note({now.utime_us, "command", order.station, "", words(order), ""});
  if (const auto refusal = desk_.begin(order, {.event = event}, now.monotonic_s)) {
    site_.conclude(event, *refusal);
  }
}

std::map<std::string, std::string> Console::watched_video() const {
  std::map<std::string, std::string> watched;
  for (const auto& video : video_addresses_) {
    const bool is_watched = std::ranges::any_of(viewers_, [&video](const auto& viewer) {
      return viewer.second.watched.contains(video.first);
    });
    if (is_watched) watched.insert(video);
  }
  return watched;
}

std::uint64_t Console::open(const std::string& name, Role role) {
  Viewer viewer;
  viewer.name = name;
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
                     const std::string& refusal) {
  const auto viewer = viewers_.find(id);
  if (viewer == viewers_.end()) return;
  auto& answers = viewer->second.answers;
  answers.push_back(dumped({{"kind", "answer"},
                            {"number", number},
                            {"station", station},
                            {"accepted", refusal.empty()},
                            {"why", refusal}}));
  if (answers.size() > kMostAnswers) answers.pop_front();
}

void Console::act(std::uint64_t id, const Refused& refused, const Now&) {
  ++messages_refused_;
  answer(id, refused.number, "", "refused: " + refused.why);
}

void Console::act(std::uint64_t id, const ReplayRequest& request, const Now&) {
  if (!is_replay()) return answer(id, request.number, "", "refused: this is no replay");
  if (replay_.requests.size() < kMostReplayRequests) replay_.requests.push_back(request);
}

void Console::act(std::uint64_t id, const AnswerRequest& request, const Now& now) {
  const Viewer& viewer = viewers_.at(id);
  const std::string& station = request.answer.station;
  if (is_replay()) return answer(id, request.number, station, kReplay);
  std::string refusal = bus_trouble_;
  // Answers turn the unit: they need control as commands do, but for the one that ends it all.
  if (viewer.role == Role::kViewer) {
    refusal = "refused: a viewer may only look and stop";
  } else if (refusal.empty() && request.answer.choice != "abort" && procedures_.has(station)) {
    refusal = control_.use(station, id, viewer.name, now.monotonic_s).value_or("");
  }
  if (refusal.empty()) refusal = procedures_.answer(request.answer);
  if (refusal.empty()) {
    site_.note({now.utime_us, "command", station, viewer.name, "answers " + request.answer.choice,
                "done"});
  }
  answer(id, request.number, station, refusal);
}

void Console::act(std::uint64_t id, const CueRequest& request, const Now& now) {
  const Viewer& viewer = viewers_.at(id);
  const auto& [cue, allow] = request.order;
  const std::string refusal =
      is_replay() ? kReplay : cues_.give(request.order, viewer.role, bus_trouble_);
  const std::string what = (allow ? "allows cue " : "forbids cue ") + cue;
  if (refusal.empty()) site_.note({now.utime_us, "command", "", viewer.name, what, "sent"});
  answer(id, request.number, "", refusal);
}

void Console::act(std::uint64_t id, const WatchRequest& request, const Now&) {
  viewers_.at(id).watched = {request.stations.begin(), request.stations.end()};
}

void Console::act(std::uint64_t id, const ControlRequest& request, const Now& now) {
  const Viewer& viewer = viewers_.at(id);
  if (is_replay()) return answer(id, request.number, request.station, kReplay);
  if (viewer.role == Role::kViewer) {
    return answer(id, request.number, request.station, "refused: a viewer may only look and stop");
  }
  if (!site_.knows(request.station)) {
    return answer(id, request.number, request.station, "refused: no such station is heard");
  }
  if (request.take) {
    control_.take(request.station, id, viewer.name, now.monotonic_s);
    note("command", viewer.name, "takes control of " + request.station, now);
  } else {
    control_.give_up(request.station, id);
  }
  answer(id, request.number, request.station, "");
}

void Console::act(std::uint64_t id, const CommandRequest& request, const Now& now) {
  const Viewer& viewer = viewers_.at(id);
  const command::Order& order = request.order;
  if (is_replay()) return answer(id, request.number, order.station, kReplay);
  if (order.kind == command::Kind::kStop) {
    if (!site_.knows(order.station)) {
      return answer(id, request.number, order.station, "refused: no such station is heard");
    }
    return begin_stop(order.station, viewer.name, {.viewer = id, .number = request.number}, now);
  }
  // Neither is history: it would push out what has happened.
  if (viewer.role == Role::kViewer) {
    return answer(id, request.number, order.station, "refused: a viewer may only look and stop");
  }
  if (!site_.knows(order.station)) {
    return answer(id, request.number, order.station, "refused: no such station is heard");
  }
  const bool is_hold = command::is_joystick(order);
  if (is_hold && now.utime_us - request.heard_utime_us > kLateRate_us) {
    return answer(id, request.number, order.station, "refused: it came too late");
  }
  auto refusal = control_.use(order.station, id, viewer.name, now.monotonic_s);
  // A hold is one event, however often it is renewed.
  const bool continues = desk_.is_held(order, now.monotonic_s);
  const auto event = continues ? 0
                               : site_.note({now.utime_us, "command", order.station, viewer.name,
                                             words(order), refusal.value_or("")});
  if (!refusal) {
    refusal = desk_.begin(order, {id, request.number, event, viewer.name}, now.monotonic_s);
    if (refusal) site_.conclude(event, *refusal);
  }
  if (refusal) answer(id, request.number, order.station, *refusal);
}

void Console::act(std::uint64_t id, const StopAllRequest& request, const Now& now) {
  if (is_replay()) return answer(id, request.number, kAll, kReplay);
  const std::string name = viewers_.at(id).name;
  const bool is_nobody = stop_all(name, {.viewer = id, .number = request.number}, now).empty();
  if (!bus_trouble_.empty()) {
    answer(id, request.number, kAll, bus_trouble_);
  } else if (is_nobody) {
    answer(id, request.number, kAll, "no station is heard; those that are within 3 s will stop");
  }
}

void Console::begin_stop(const std::string& station, const std::string& name, Ticket ticket,
                         const Now& now) {
  const command::Order order{.station = station, .kind = command::Kind::kStop};
  ticket.who = name;
  ticket.event = desk_.stop_event(station, name);
  if (ticket.event == 0) {
    ticket.event = site_.note({now.utime_us, "command", station, name, "stop", ""});
  }
  if (const auto refusal = desk_.begin(order, ticket, now.monotonic_s)) {
    answer(ticket.viewer, ticket.number, station, *refusal);
  }
}

std::vector<std::string> Console::stop_all(const std::string& name, const Ticket& ticket,
                                           const Now& now) {
  stop_until_s_ = now.monotonic_s + CommandDesk::kStopPatience_s;
  stopped_by_ = name;
  std::vector<std::string> stations = site_.station_ids();
  Ticket for_all = ticket;
  for_all.is_for_all = true;
  for (const std::string& station : stations) begin_stop(station, name, for_all, now);
  return stations;
}

void Console::forget_gone() {
  const auto is_known = [this](const std::string& id) { return site_.knows(id); };
  desk_.keep_only(is_known);
  procedures_.keep_only(is_known);
  std::erase_if(pictures_, [&](const auto& kept) { return !is_known(kept.first); });
  std::erase_if(video_addresses_, [&](const auto& video) { return !is_known(video.first); });
  for (auto& [id, viewer] : viewers_) {
    std::erase_if(viewer.pictures_sent, [&](const auto& sent) { return !is_known(sent.first); });
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
  for (const Verdict& verdict : desk_.finished(now.monotonic_s)) {
    const std::string said = verdict.outcome.accepted ? "done" : verdict.outcome.why;
    site_.conclude(verdict.ticket.event, said);
    answer(verdict.ticket.viewer, verdict.ticket.number, verdict.station,
           verdict.outcome.accepted ? "" : said);
    if (verdict.ticket.is_for_all && !verdict.outcome.accepted) unconfirmed.insert(verdict.station);
  }
  if (!unconfirmed.empty()) tell_all({{"kind", "stop_unconfirmed"}, {"stations", unconfirmed}});
}

void Console::replay_is(const Json& state, bool is_urgent) {
  replay_.state = state;
  bus_trouble_ = kReplay;
  if (!is_urgent) return;
  for (auto& [id, viewer] : viewers_) viewer.sent_s = -1e9;
}

Moment Console::moment() const {
  Moment moment{site_, desk_, {}};
  for (const auto& [station, kept] : pictures_) moment.pictures.emplace(station, kept.picture);
  return moment;
}

void Console::show(const Moment& moment) {
  site_ = moment.site;
  desk_ = moment.desk;
  pictures_.clear();
  for (const auto& [station, picture] : moment.pictures) {
    pictures_[station] = {picture, ++picture_numbers_};
  }
  for (auto& [id, viewer] : viewers_) {
    viewer.sent = 0;
    viewer.sent_s = -1e9;
  }
}

std::vector<command::Order> Console::turn(const Now& now) {
  site_.look(now);
  forget_gone();
  tell_outcomes(now);
  for (const auto& [station, holder] : control_.changes(now.monotonic_s)) {
    site_.set_holder(
        station, holder ? Json{{"by", holder->name}, {"viewer", holder->viewer}} : Json(nullptr));
  }
  return desk_.due(now.monotonic_s);
}

Outgoing Console::greeting(std::uint64_t id, Viewer& viewer, const Now& now) const {
  viewer.is_greeted = true;
  return {false, dumped({{"kind", "hello"},
                         {"viewer", id},
                         {"name", viewer.name},
                         {"role", std::string(console::name(viewer.role))},
                         {"time_us", now.utime_us}})};
}

// Of the stations with a new picture the one that was sent longest ago: over a slow link each gets
// its turn.
std::optional<Outgoing> Console::next_picture(Viewer& viewer) const {
  const Kept* next = nullptr;
  for (const auto& [station, kept] : pictures_) {
    const std::uint64_t sent = viewer.pictures_sent[station];
    if (!viewer.watched.contains(station) || sent >= kept.number) continue;
    if (next == nullptr || sent < viewer.pictures_sent[next->picture.station]) next = &kept;
  }
  if (next == nullptr) return std::nullopt;
  viewer.pictures_sent[next->picture.station] = next->number;
  const std::string header = dumped(next->picture.header);
  const LengthPrefix prefix = length_prefix(static_cast<std::uint32_t>(header.size()));
  return Outgoing{true, std::string(prefix.begin(), prefix.end()) + header + next->picture.jpeg};
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
  if (has_news || since_s >= kHeartbeat_s) {
    Json message = viewer.sent == 0 ? site_.snapshot() : site_.changes(viewer.sent);
    add_time(message, now);
    viewer.sent = site_.revision();
    viewer.sent_s = now.monotonic_s;
    return Outgoing{false, dumped(message)};
  }
  return next_picture(viewer);
}

// The time that is shown: of a replay that of the recording.
void Console::add_time(Json& message, const Now& now) const {
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

void Console::note(const std::string& kind, const std::string& who, const std::string& text,
                   const Now& now) {
  if (!is_replay()) site_.note({now.utime_us, kind, "", who, text, ""});
}

}  // namespace ols::console
