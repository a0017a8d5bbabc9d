#include "edge/messages/messages_bus.h"

#include <cmath>

#include "base/bus/channel_names.h"
#include "base/journal/journal.h"
#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "conditions/refusal.h"

namespace ols::station {
namespace {

constexpr QueueLimits kQueue{.messages = 400, .bytes = 1'000'000};  // commands of one kind

std::shared_ptr<trust::BusTrust> open_trust(const StationSettings& settings, std::int64_t boot_id) {
  const trust::Environment environment = trust_environment(settings);
  trust::Self self;
  self.name = settings.id;
  self.boot_id = boot_id;
  self.is_station = true;
  self.settings = site_check(settings.site.file);
  self.list_taken = [station = settings.id](const trust::TrustList& list) {
    write_to_journal(
        {.text = list.in_one_line() + "; taken", .id = event::kTrustList, .station = station});
  };
  return trust::BusTrust::open(settings.trust, environment, self);
}

}  // namespace

trust::Environment trust_environment(const StationSettings& settings) {
  trust::Environment environment = trust::process_environment();
  if (!settings.state_folder.empty()) environment.state = settings.state_folder;
  return environment;
}

StationBus::StationBus(const StationSettings& settings, std::int64_t boot_id, Station& station,
                       CommandTurn& turn, Record recorder, FrameWanted frame_wanted)
    : settings_(settings),
      station_(station),
      turn_(turn),
      given_{settings.gate, std::move(recorder), std::move(frame_wanted)},
      connector_(settings.lcm_url, open_trust(settings, boot_id)) {
  sender_.station = settings.id;
  sender_.boot_id = boot_id;
  on_command<ols_msg::designate_t>(kDesignateChannel, [this](const ols_msg::designate_t& message) {
    turn_.designate(from_message(message, sender_), {message.boot_id, message.sequence});
    return Verdict{.is_open = true};
  });
  on_command<ols_msg::slew_t>(kSlewChannel, [this](const ols_msg::slew_t& message) {
    return verdict("SLEW", station_.slew(from_message(message, sender_, now_s_), now_s_));
  });
  on_command<ols_msg::occlusion_t>(kOcclusionChannel, [this](const ols_msg::occlusion_t& message) {
    return verdict("OCCLUSION", station_.occlude(from_message(message, sender_, now_s_), now_s_));
  });
  on_command<ols_msg::ptu_command_t>(
      kPtuChannel, [this](const ols_msg::ptu_command_t& message) { return command_ptu(message); });
  on_command<ols_msg::lens_command_t>(kLensChannel, [this](const ols_msg::lens_command_t& message) {
    return command_lens(message);
  });
  on_command<ols_msg::record_t>(
      kRecordChannel, [this](const ols_msg::record_t& message) { return record(message); });
  on_command<ols_msg::frame_request_t>(
      kFrameRequestChannel,
      [this](const ols_msg::frame_request_t& message) { return want_frame(message); });
}

void StationBus::connect(double wait_s) {
  bus_ = connector_.take(now_s_, wait_s);
  if (!bus_) {
    if (!connector_.trouble().empty()) trouble_ = connector_.trouble();
    return;
  }
  subscribe();
  trouble_.clear();
  counters_["bus_connects"] += 1;
}

void StationBus::subscribe() {
  const LcmBus::Express stop = [this](const BusMessage& message) { return take_stop(message); };
  for (const auto& subscription : subscriptions_) {
    const bool may_stop = subscription.first == ptu_channel();
    bus_->subscribe(subscription.first, subscription.second, kQueue,
                    may_stop ? stop : LcmBus::Express());
  }
}

std::string StationBus::ptu_channel() const { return station_channel(kPtuChannel, settings_.id); }

// In the bus's own thread: a stop overtakes all waiting messages and no flood displaces it. It is
// accepted at any age, from any clock, sender and schema that can be read: only commands that cause
// motion must be fresh, and a stop on this station's channel means this station. Where signatures
// are required, one that does not name this boot is good for its lease only: it may be a recording.
bool StationBus::take_stop(const BusMessage& message) {
  ols_msg::ptu_command_t command{};
  const bool is_stop = decode_exactly(message, command) &&
                       command.command == ols_msg::ptu_command_t::COMMAND_STOP &&
                       (message.addressed || is_leased(command, message.received_utime_us));
  if (!is_stop) return false;
  turn_.stop();
  const std::lock_guard lock(stops_mutex_);
  if (stops_.size() < kMostStoppers || stops_.contains(command.boot_id)) {
    stops_[command.boot_id] = command.sequence;
  }
  return true;
}

// In the bus's thread.
bool StationBus::is_leased(const ols_msg::ptu_command_t& stop, std::int64_t utime_us) const {
  const double age_s = static_cast<double>(utime_us - stop.utime) * 1e-6;
  return stop.lease_s > 0.0 && stop.lease_s <= given_.gate.lease_max_s &&
         std::abs(age_s) <= stop.lease_s + given_.gate.clock_margin_s;
}

void StationBus::disconnect(const std::string& why) {
  bus_.reset();
  monitor_.connection_ended();
  trouble_ = why;
}

// A message that cannot be sent is not kept: old bearings are of no use.
template <class Message>
void StationBus::publish(const std::string& channel, const Message& message) {
  if (bus_ && bus_->publish(channel, message)) return;
  counters_["messages_not_sent"] += 1;
  if (bus_) disconnect("sending fails: the network is down");
}

void StationBus::end_turn() {
  std::map<std::int64_t, std::int64_t> stops;  // those that the turn's end carries out
  {
    const std::lock_guard lock(stops_mutex_);
    stops.swap(stops_);
  }
  turn_.end(now_s_);
  answer_designations();
  for (const auto& [boot_id, sequence] : stops) answer({boot_id, sequence}, {});
}

// What was dropped for a later command is no error of the station.
void StationBus::answer_designations() {
  for (const Decision& one : turn_.take_decisions()) {
    const bool dropped = one.refusal == Refusal::kOvertaken || one.refusal == Refusal::kStopped;
    answer(one.command,
           dropped ? Verdict{.reason = to_string(one.refusal)} : verdict("DESIGNATE", one.refusal));
  }
}

// A flood of commands must not make as many answers. Refusals have a limit of their own, so that
// forged commands leave no real one without its answer.
void StationBus::answer(const CommandId& command, const Verdict& verdict) {
  if (verdict.is_open) return;
  trust::RateLimit& limit = verdict.reason.empty() ? accepted_sent_ : refused_sent_;
  if (!limit.has(now_s_)) return;
  limit.spend();
  answers_.push_back({command, verdict.reason, verdict.detail, station_.state()});
}

StationBus::Verdict StationBus::command_ptu(const ols_msg::ptu_command_t& message) {
  turn_.before_other_command(now_s_);
  answer_designations();
  const auto judged = [this](Refusal refusal) { return verdict("PTU", refusal); };
  switch (message.command) {
    case ols_msg::ptu_command_t::COMMAND_POINT:
      return judged(station_.point(from_message(message), now_s_));
    case ols_msg::ptu_command_t::COMMAND_CENTRE:
      return judged(station_.centre(centre_from_message(message, sender_), now_s_));
    case ols_msg::ptu_command_t::COMMAND_RATE:
      return judged(station_.rate(rate_from_message(message, now_s_), now_s_));
    case ols_msg::ptu_command_t::COMMAND_RELEASE:
      return judged(station_.release(now_s_));
    case ols_msg::ptu_command_t::COMMAND_REARM:
      return judged(station_.rearm_over_bus(now_s_));
    case ols_msg::ptu_command_t::COMMAND_HOME:
      return judged(station_.home(now_s_));
    case ols_msg::ptu_command_t::COMMAND_REFERENCE_OK:
      return judged(station_.reference_ok(now_s_));
    default:
      refused_.refuse("PTU", "unknown_command");
      return {.reason = "unknown_command"};
  }
}

StationBus::Verdict StationBus::command_lens(const ols_msg::lens_command_t& message) {
  using M = ols_msg::lens_command_t;
  if (message.command == M::COMMAND_POSITION || message.command == M::COMMAND_RATE) {
    return verdict("LENS", station_.lens(from_message(message, now_s_), now_s_));
  }
  refused_.refuse("LENS", "unknown_command");
  return {.reason = "unknown_command"};
}

void StationBus::take(const BusMessage& message) {
  if (message.channel == ptu_channel() && take_stop(message)) return;
  for (const auto& [name, receive] : subscriptions_) {
    if (name == message.channel) receive(message);
  }
}

template <class Message>
void StationBus::on_command(std::string_view channel,
                            const std::function<Verdict(const Message&)>& execute) {
  const std::string kind = message_kind(channel);
  gates_.emplace(kind, CommandGate(given_.gate, clock_utime_us()));
  const bool is_answered = channel != kSlewChannel &&
                           channel != kOcclusionChannel;  // the fusion goes by the station's state
  const auto judge = [this, kind, execute](const BusMessage& received,
                                           const Message& message) -> Verdict {
    const auto refuse = [&](const char* why) {
      refused_.refuse(kind, why);
      return Verdict{.reason = why};
    };
    if (!received.addressed) return refuse("other_boot");
    if (message.schema_version != Message::SCHEMA_VERSION) return refuse("schema");
    if (message.station != settings_.id) return refuse("other_station");
    const auto refusal = gates_.at(kind).admit(stamp_of(message), sender_.utime_us(now_s_));
    if (!refusal) return execute(message);
    refused_.refuse_at_gate(kind, to_string(*refusal), now_s_);
    return {.reason = to_string(*refusal)};
  };
  const auto receive = [this, kind, is_answered, judge](const BusMessage& received) {
    Message message;
    if (!decode_exactly(received, message)) return refused_.refuse(kind, "malformed");
    const Verdict verdict = judge(received, message);
    if (is_answered) answer({message.boot_id, message.sequence}, verdict);
  };
  subscriptions_.emplace_back(station_channel(channel, settings_.id), receive);
}

StationBus::Verdict StationBus::record(const ols_msg::record_t& message) {
  const auto command = from_message(message, sender_, now_s_);
  const std::string refusal = command ? given_.record(*command) : "not a span of time";
  if (refusal.empty()) {
    counters_["record_accepted"] += 1;
    return {};
  }
  refused_.refuse("RECORD", "recorder");
  refused_.note("RECORD refused: " + refusal);
  return {"recorder", refusal};
}

StationBus::Verdict StationBus::want_frame(const ols_msg::frame_request_t& message) {
  const std::string refusal = given_.frame_wanted
                                  ? given_.frame_wanted(from_message(message, now_s_))
                                  : "this station sends no frames";
  if (refusal.empty()) {
    counters_["frame_requests_accepted"] += 1;
    return {};
  }
  refused_.refuse("FRAME_REQUEST", "frame_service");
  refused_.note("FRAME_REQUEST refused: " + refusal);
  return {"frame_service", refusal};
}

StationBus::Verdict StationBus::verdict(const std::string& kind, Refusal refusal) {
  if (refusal == Refusal::kNone) return {};
  refused_.note(refused_in_words(kind, to_string(refusal)));
  return {.reason = to_string(refusal)};
}

void StationBus::set_time(const clock::ClockPair& now, const clock::ClockQuality& quality) {
  now_s_ = now.monotonic_s;
  sender_.utc_minus_monotonic_us = now.utime_us - std::llround(now.monotonic_s * 1e6);
  sender_.clock = quality;
}

// A bounded number of messages: a flood costs messages, but does not block the control loop.
void StationBus::receive() {
  if (!bus_) connect(0.0);
  if (bus_) {
    bus_->handle(0);
    monitor_.look(bus_->traffic(), now_s_);
    if (bus_->is_deaf()) disconnect("no messages arrive any more, not even this station's own");
  }
  end_turn();
  for (const Answer& answer : take_answers()) {
    publish(station_channel(kReplyChannel, settings_.id),
            to_message(answer, sender_, now_s_, ++sequences_["reply"]));
  }
}

std::vector<Alarm> StationBus::alarms() const {
  auto alarms = refused_.alarms(now_s_);
  for (Alarm& alarm : monitor_.alarms(now_s_)) alarms.push_back(std::move(alarm));
  const std::int64_t newest = connector_.site_settings_number();
  if (newest > settings_.site.number) {
    alarms.push_back(alarm::site_settings_wait(newest));
  }
  return alarms;
}

std::map<std::string, double> StationBus::counters() const {
  auto counters = counters_;
  counters.insert(refused_.counters().begin(), refused_.counters().end());
  if (turn_.superseded() > 0) {
    counters["designations_superseded"] = static_cast<double>(turn_.superseded());
  }
  monitor_.count(counters);
  return counters;
}

void StationBus::send(const Bearing& bearing) {
  publish(station_channel(kBearingChannel, settings_.id),
          to_message(bearing, sender_, settings_, ++sequences_["bearing"]));
}

void StationBus::send(const Sighting& sighting) {
  publish(station_channel(kSightingChannel, settings_.id),
          to_message(sighting, sender_, ++sequences_["sighting"]));
}

void StationBus::send(const skyline::SkylinePart& part) {
  publish(station_channel(kSkylineChannel, settings_.id),
          to_message(part, sender_, now_s_, ++sequences_["skyline"]));
}

void StationBus::send(StationReport report) {
  report.counters.merge(counters());
  publish(station_channel(kStatusChannel, settings_.id),
          to_message(report, sender_, settings_, now_s_, ++sequences_["status"]));
}

void StationBus::send(const FramePart& part) {
  publish(station_channel(kFrameChannel, settings_.id),
          to_message(part, sender_, ++sequences_["frame_part"]));
}

void StationBus::send_preview(const camera::Frame& frame, const std::optional<cv::Rect2d>& box) {
  const std::int64_t sequence = ++sequences_["preview"];
  const auto picture = video::preview_picture(frame.gray);
  if (picture) {
    publish(station_channel(kPreviewChannel, settings_.id),
            to_message(*picture, frame, box, sender_, sequence));
  } else {
    counters_["previews_too_large"] += 1;
  }
}

}  // namespace ols::station
