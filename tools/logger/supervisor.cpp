#include "tools/logger/supervisor.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <nlohmann/json.hpp>

#include "base/journal/journal.h"
#include "base/text/plain_text.h"
#include "conditions/printed.h"

namespace ols::logger {
namespace {

constexpr double kFirstPause_s = 0.5;  // before a restart; doubled each time
constexpr double kLongestPause_s = 15.0;
constexpr double kHealthy_s = 20.0;  // after running this long, the pause is short again

std::string disk_full(double free_bytes) {
  return printed("disk full (%.1f GB free)", free_bytes * 1e-9);
}

}  // namespace

std::string to_json(const LoggerStatus& status, std::int64_t utime_us) {
  const nlohmann::ordered_json json{{"utime_us", utime_us},
                                    {"recording", status.recording},
                                    {"text", plain_text(status.text)},
                                    {"bus_alarm", status.bus_alarm},
                                    {"files", status.files},
                                    {"bytes", std::llround(status.bytes)},
                                    {"disk_free_bytes", std::llround(status.free_bytes)},
                                    {"starts", status.starts},
                                    {"failures", status.failures},
                                    {"files_removed", status.removed},
                                    {"files_lost", status.files_lost},
                                    {"messages_dropped", status.dropped},
                                    {"bus_fragments_refused", status.fragments},
                                    {"bus_datagrams_malformed", status.malformed}};
  return json.dump();
}

Supervisor::Supervisor(const LoggerConfig& config)
    : config_(config), folder_(config.folder, config.name), pause_s_(kFirstPause_s) {}

Supervisor::~Supervisor() = default;

void Supervisor::turn(double now_s) {
  if (recorder_) look_after_recorder(now_s);
  try {
    folder_.survey();
    // Headroom for the data until the next call and for one more file.
    folder_.remove_oldest(config_.quota_bytes, config_.disk_reserve_bytes,
                          2.0 * config_.split_bytes,
                          recorder_ ? recorder_->report().file : std::string());
  } catch (const std::exception& failure) {
    fail(failure.what(), now_s + kFirstPause_s);
    return;
  }
  if (recorder_ && folder_.free_bytes() < config_.disk_reserve_bytes) {
    recorder_->discard();
    fail(disk_full(folder_.free_bytes()), now_s + kFirstPause_s);
  } else if (!recorder_ && now_s >= retry_s_) {
    start(now_s);
  }
}

void Supervisor::look_after_recorder(double now_s) {
  if (const auto why = recorder_->report().ended) {
    fail(*why, now_s + pause_s_);
    pause_s_ = std::min(2.0 * pause_s_, kLongestPause_s);
  } else if (now_s - started_s_ > kHealthy_s) {
    pause_s_ = kFirstPause_s;
  }
}

void Supervisor::end_recorder() {
  if (!recorder_) return;
  ended_ = status();
  recorder_.reset();
}

void Supervisor::start(double now_s) {
  const double wanted_bytes = config_.disk_reserve_bytes + config_.split_bytes;
  if (folder_.free_bytes() < wanted_bytes) {
    fail(disk_full(folder_.free_bytes()), now_s + kFirstPause_s);
    return;
  }
  try {
    recorder_ = std::make_unique<BusRecorder>(config_);
  } catch (const std::exception& failure) {
    fail(failure.what(), now_s + pause_s_);
    pause_s_ = std::min(2.0 * pause_s_, kLongestPause_s);
    return;
  }
  ++starts_;
  started_s_ = now_s;
  trouble_.clear();
  spdlog::info("records {} to {}", config_.lcm_url, config_.folder);
}

void Supervisor::fail(const std::string& why, double retry_s) {
  end_recorder();
  // Each fault is logged and counted once, not at every attempt.
  if (why != trouble_) {
    ++failures_;
    write_to_journal({.text = "nothing is recorded: " + why,
                      .bad = true,
                      .id = event::kNotRecorded,
                      .reason = why});
  }
  trouble_ = why;
  retry_s_ = retry_s;
}

LoggerStatus Supervisor::status() const {
  LoggerStatus status = ended_;
  status.recording = recorder_ != nullptr;
  status.text = trouble_;
  status.bus_alarm.clear();
  status.files = folder_.files().size();
  status.bytes = folder_.bytes();
  status.free_bytes = folder_.free_bytes();
  status.starts = starts_;
  status.failures = failures_;
  status.removed = folder_.removed();
  if (!recorder_) return status;
  const RecorderReport report = recorder_->report();
  status.text = report.file;
  status.bus_alarm = report.bus_alarm;
  status.files_lost += report.files_lost;
  status.dropped += report.dropped;
  status.fragments += report.traffic.fragments;
  status.malformed += report.traffic.malformed;
  return status;
}

}  // namespace ols::logger
