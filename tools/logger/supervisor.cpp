#include "tools/logger/supervisor.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>

namespace ols {
namespace {

constexpr double kFirstPause_s = 0.5;  // before another start; doubles
constexpr double kLongestPause_s = 15.0;
constexpr double kHealthy_s = 20.0;  // having run so long, it starts again without a long pause

std::string disk_full(double free_bytes) {
  char text[64];
  std::snprintf(text, sizeof text, "disk full (%.1f GB free)", free_bytes * 1e-9);
  return text;
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return result + '"';
}

}  // namespace

std::string to_json(const LoggerStatus& status, std::int64_t utime_us) {
  char numbers[320];
  std::snprintf(numbers, sizeof numbers,
                ", \"logger_pid\": %d, \"files\": %zu, \"bytes\": %.0f, \"disk_free_bytes\": %.0f, "
                "\"starts\": %llu, "
                "\"failures\": %llu, \"files_removed\": %llu, \"messages_dropped\": %llu}",
                status.logger_pid, status.files, status.bytes, status.free_bytes,
                static_cast<unsigned long long>(status.starts),
                static_cast<unsigned long long>(status.failures),
                static_cast<unsigned long long>(status.removed),
                static_cast<unsigned long long>(status.dropped));
  return "{\"utime_us\": " + std::to_string(utime_us) +
         ", \"recording\": " + (status.recording ? "true" : "false") +
         ", \"text\": " + quoted(status.text) + numbers;
}

Supervisor::Supervisor(const LoggerConfig& config)
    : config_(config), folder_(config.folder, config.name), pause_s_(kFirstPause_s) {}

Supervisor::~Supervisor() = default;

void Supervisor::turn(double now_s) {
  if (child_) look_after_child(now_s);
  try {
    folder_.survey();
    // Room for what is written until the next turn, and for one file more.
    folder_.make_room(config_.quota_bytes, config_.disk_reserve_bytes, 2.0 * config_.split_bytes,
                      child_ ? child_->current_file() : std::string());
  } catch (const std::exception& failure) {
    fail(failure.what(), now_s + kFirstPause_s);
    return;
  }
  if (child_ && folder_.free_bytes() < config_.disk_reserve_bytes) {
    fail(disk_full(folder_.free_bytes()), now_s + kFirstPause_s);
  } else if (!child_ && now_s >= retry_s_) {
    start(now_s);
  }
}

void Supervisor::look_after_child(double now_s) {
  const std::uint64_t dropped_before = child_->dropped();
  std::string last;
  for (const std::string& line : child_->listen()) {
    spdlog::warn("lcm-logger: {}", line);
    last = line;
  }
  dropped_ += child_->dropped() - dropped_before;
  if (const auto why = child_->ended()) {
    fail(*why + (last.empty() ? "" : ": " + last), now_s + pause_s_);
    pause_s_ = std::min(2.0 * pause_s_, kLongestPause_s);
  } else if (now_s - started_s_ > kHealthy_s) {
    pause_s_ = kFirstPause_s;
  }
}

void Supervisor::start(double now_s) {
  const double wanted_bytes = config_.disk_reserve_bytes + config_.split_bytes;
  if (folder_.free_bytes() < wanted_bytes) {
    fail(disk_full(folder_.free_bytes()), now_s + kFirstPause_s);
    return;
  }
  try {
    child_ = std::make_unique<ChildLogger>(logger_command(config_));
  } catch (const std::exception& failure) {
    fail(failure.what(), now_s + kLongestPause_s);
    return;
  }
  ++starts_;
  started_s_ = now_s;
  trouble_.clear();
  spdlog::info("records {} to {}", config_.lcm_url, config_.folder);
}

void Supervisor::fail(const std::string& why, double retry_s) {
  child_.reset();
  // One trouble is told and counted once, not at every try.
  if (why != trouble_) {
    ++failures_;
    spdlog::error("nothing is recorded: {}", why);
  }
  trouble_ = why;
  retry_s_ = retry_s;
}

LoggerStatus Supervisor::status() const {
  LoggerStatus status;
  status.recording = child_ != nullptr;
  status.text = child_ ? child_->current_file() : trouble_;
  status.logger_pid = child_ ? child_->pid() : 0;
  status.files = folder_.files().size();
  status.bytes = folder_.bytes();
  status.free_bytes = folder_.free_bytes();
  status.starts = starts_;
  status.failures = failures_;
  status.removed = folder_.removed();
  status.dropped = dropped_;
  return status;
}

}  // namespace ols
