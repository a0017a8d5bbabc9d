#include "console/replay/replay.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "base/bus/channel_names.h"
#include "base/text/plain_text.h"
#include "console/messages.h"
#include "console/messages_pictures.h"
#include "wire/orders.h"

namespace ols::console {
namespace {

constexpr double kControlTimeout_s = 60.0;  // nobody has control of a recording
constexpr double kTimelinePeriod_s = 1.0;   // while it grows
constexpr double kMostTurn_s = 0.5;         // a process that was stopped goes on where it was

Now of_log(std::int64_t utime_us) { return {static_cast<double>(utime_us) * 1e-6, utime_us}; }

// Passes a recorded message to the console as if it came from the bus; returns whether it was
// understood.
bool receive(Console& console, const BusMessage& message, Timeline* timeline) {
  const Now now = of_log(message.received_utime_us);
  if (const auto station = station_from(message)) {
    console.receive(*station, now);
  } else if (const auto target = target_from(message)) {
    if (timeline != nullptr) timeline->receive(*target, now.utime_us);
    console.receive(*target, now);
  } else if (const auto bearing = bearing_from(message)) {
    console.receive_bearing(bearing->first, bearing->second);
  } else if (const auto occlusion = occlusion_from(message)) {
    console.receive(*occlusion, now);
  } else if (const auto skyline = skyline_from(message)) {
    console.receive(*skyline);
  } else if (const auto fusion = fusion_from(message)) {
    console.receive(*fusion, now);
  } else if (auto picture = picture_from(message)) {
    console.receive(std::move(*picture));
  } else if (const auto order = wire::decode_order(message)) {
    console.receive(*order, now);
  } else if (const auto reply = wire::decode_reply(message)) {
    console.receive(*reply);
  } else {
    return false;
  }
  return true;
}

bool is_shown(const std::string& channel) {
  constexpr std::array kShown{kStatusChannel, kBearingChannel,   kPreviewChannel,
                              kPtuChannel,    kReplyChannel,     kDesignateChannel,
                              kRecordChannel, kOcclusionChannel, kSkylineChannel};
  return channel == kTargetChannel || channel == kFusionStatusChannel ||
         std::ranges::any_of(kShown, [&](std::string_view c) { return channel.starts_with(c); });
}

// Updates ages and outcomes at each tenth of a second.
void turn_if_due(Console& console, std::int64_t before_us, std::int64_t now_us) {
  constexpr std::int64_t kPeriod_us = 100'000;
  if (before_us / kPeriod_us != now_us / kPeriod_us)
    static_cast<void>(console.turn(of_log(now_us)));
}

}  // namespace

Replay::Replay(const std::string& log, RecordedFrames frames, Console& console)
    : log_(log),
      console_(console),
      scanner_(log),
      player_(log),
      frames_(std::move(frames)),
      scanned_(std::make_unique<Console>(kControlTimeout_s)) {
  waiting_ = player_.next();  // there is one, else it throws
  playback_.at_us = static_cast<double>(waiting_->received_utime_us);
  tell();
}

void Replay::scan() {
  if (is_scanned_) return;
  for (int i = 0; i < kScannedAtOnce; ++i) {
    const auto message = scanner_.next();
    if (!message) {
      is_scanned_ = true;
      return timeline_.end(*scanned_);
    }
    if (!receive(*scanned_, *message, &timeline_) && is_shown(message->channel)) {
      scanner_.reject(*message);
    }
    turn_if_due(*scanned_, timeline_.last_us(), message->received_utime_us);
    timeline_.reach(message->received_utime_us, scanner_.offset(), *scanned_);
  }
}

bool Replay::catch_up(Console& console, std::int64_t until_us) {
  std::int64_t before_us = until_us;
  for (int i = 0; i < kPlayedAtOnce; ++i) {
    if (!waiting_ || waiting_->received_utime_us > until_us) return true;
    const std::int64_t now_us = waiting_->received_utime_us;
    turn_if_due(console, before_us, now_us);
    before_us = now_us;
    receive(console, *waiting_, nullptr);
    waiting_ = player_.next();
  }
  return false;
}

void Replay::seek(std::int64_t wanted_us) {
  if (timeline_.snapshots() == 0) return;
  const std::int64_t at_us = std::clamp(wanted_us, timeline_.first_us(), timeline_.last_us());
  const Snapshot* snapshot = timeline_.before(at_us);
  const auto now_us = static_cast<std::int64_t>(playback_.at_us);
  const bool is_nearer = !ahead_ && now_us <= at_us && (!snapshot || now_us >= snapshot->utime_us);
  const Moment here = console_.moment();
  ahead_ = std::make_unique<Console>(kControlTimeout_s);
  playback_.at_us = static_cast<double>(at_us);
  if (is_nearer) return ahead_->show(here);
  if (snapshot) ahead_->show(snapshot->moment);
  player_.seek(snapshot ? snapshot->offset : 0, snapshot ? snapshot->utime_us : 0);
  waiting_ = player_.next();
}

void Replay::obey() {
  for (const ReplayRequest& request : console_.take_replay_requests()) {
    if (request.at_us) seek(*request.at_us);
    playback_.is_playing = request.playing.value_or(playback_.is_playing);
    playback_.speed = request.speed.value_or(playback_.speed);
    told_.is_urgent = true;
  }
}

void Replay::play(double elapsed_s) {
  const auto now_us = static_cast<std::int64_t>(playback_.at_us);
  if (ahead_) {
    if (!catch_up(*ahead_, now_us)) return;
    static_cast<void>(ahead_->turn(of_log(now_us)));
    console_.show(std::exchange(ahead_, nullptr)->moment());
    frames_.give_again();
    return;
  }
  if (!playback_.is_playing) return;
  // If the machine cannot keep up with the speed, the time of the replay waits.
  if (waiting_ && waiting_->received_utime_us <= now_us) {
    if (!catch_up(console_, now_us)) return;
  }
  playback_.at_us += elapsed_s * playback_.speed * 1e6;
  if (is_scanned_ && playback_.at_us >= static_cast<double>(timeline_.last_us())) {
    playback_.at_us = static_cast<double>(timeline_.last_us());
    playback_.is_playing = false;
    told_.is_urgent = true;
  }
  const auto until_us = static_cast<std::int64_t>(playback_.at_us);
  catch_up(console_, until_us);
  static_cast<void>(console_.turn(of_log(until_us)));
}

void Replay::show_frames() {
  if (ahead_) return;
  for (const std::string& station : frames_.stations()) {
    if (auto picture = frames_.newest(station, static_cast<std::int64_t>(playback_.at_us))) {
      console_.receive(std::move(*picture));
    }
  }
}

std::string Replay::problem() const {
  std::string text = scanner_.damage();
  for (const std::string& of_frames : frames_.problems()) {
    text += (text.empty() ? "" : "; ") + of_frames;
  }
  return text;
}

void Replay::tell_timeline() {
  const bool is_soon = !is_scanned_ && turned_s_ < told_.timeline_s + kTimelinePeriod_s;
  if (told_.changes == timeline_.changes() || is_soon) return;
  told_.timeline_s = turned_s_;
  told_.changes = timeline_.changes();
  Json timeline = timeline_.json();
  timeline["recorded"] = frames_.events();
  console_.timeline_is(timeline);
}

void Replay::tell() {
  tell_timeline();
  const double read =
      is_scanned_ ? 1.0
                  : static_cast<double>(scanner_.offset()) / static_cast<double>(scanner_.size());
  console_.replay_is({{"file", plain_text(std::filesystem::path(log_).filename().string())},
                      {"at_us", static_cast<std::int64_t>(playback_.at_us)},
                      {"first_us", timeline_.first_us()},
                      {"last_us", timeline_.last_us()},
                      {"read", std::min(1.0, read)},
                      {"playing", playback_.is_playing && !ahead_},
                      {"speed", playback_.speed},
                      {"marks", told_.changes},
                      {"problem", problem()}},
                     std::exchange(told_.is_urgent, false));
}

void Replay::turn(double monotonic_s) {
  const double elapsed_s =
      turned_s_ < 0.0 ? 0.0 : std::clamp(monotonic_s - turned_s_, 0.0, kMostTurn_s);
  turned_s_ = monotonic_s;
  scan();
  obey();
  play(elapsed_s);
  show_frames();
  tell();
}

std::string Replay::in_one_line() const {
  return "replay of " + log_ + (is_scanned_ ? "" : ", being read") +
         (problem().empty() ? "" : "; " + problem());
}

}  // namespace ols::console
