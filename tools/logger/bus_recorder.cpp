#include "tools/logger/bus_recorder.h"

#include <spdlog/spdlog.h>

#include <exception>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/bus/boot_id.h"
#include "base/files/atomic_file.h"
#include "base/process/clocks.h"

namespace ols::logger {
namespace {

constexpr int kTurn_ms = 50;
constexpr double kFlush_s = 0.1;
constexpr double kLook_s = 1.0;  // between two checks of the file's name

QueueLimits limits_of(const LoggerConfig& config) {
  return {.messages = std::numeric_limits<std::size_t>::max(),
          .bytes = static_cast<std::size_t>(config.max_unwritten_mb * 1e6)};
}

std::shared_ptr<trust::BusTrust> open_trust(const trust::TrustConfig& config) {
  trust::Self self;
  self.name = "logger";
  self.boot_id = draw_boot_id();
  self.commands = true;  // statuses of a station whose clock is wrong are recorded too
  return trust::BusTrust::open(config, trust::process_environment(), self);
}

// With invert: a negative lookahead, all channels that do not match the expression.
std::string wanted(const LoggerConfig& config) {
  return config.invert ? "(?!(?:" + config.channels + ")\\z).*" : config.channels;
}

}  // namespace

BusRecorder::BusRecorder(const LoggerConfig& config, const std::string& file)
    : config_(config),
      single_file_(file),
      names_(config.folder, config.name),
      trust_(open_trust(config.trust)),
      bus_(config.lcm_url, trust_) {
  // Before the file: a failed connection must not leave an empty file.
  bus_.subscribe(
      wanted(config_), [this](const BusMessage& message) { write(message); }, limits_of(config_),
      [this](const BusMessage& message) {
        receive_trust_list(message);
        return false;
      });
  begin_file();
  thread_ = std::thread([this] { run(); });
}

BusRecorder::~BusRecorder() {
  end_ = true;
  thread_.join();
}

RecorderReport BusRecorder::report() const {
  const std::lock_guard lock(mutex_);
  return report_;
}

void BusRecorder::run() {
  try {
    record();
  } catch (const std::exception& failure) {
    const std::lock_guard lock(mutex_);
    report_.ended = failure.what();
  }
}

void BusRecorder::record() {
  while (!end_) {
    bus_.handle(kTurn_ms);
    const double now_s = clock_monotonic_s();
    if (now_s >= due_.flush_s) {
      due_.flush_s = now_s + kFlush_s;
      writer_->flush();
    }
    if (now_s >= due_.look_s) {
      due_.look_s = now_s + kLook_s;
      look_after_file();
    }
    look_at_bus(now_s);
  }
  write_rest();
}

// Writes the messages received before the request to end; a slow disk does not delay the end.
void BusRecorder::write_rest() {
  constexpr double kLongest_s = 5.0;
  bus_.stop_listening();
  const double end_s = clock_monotonic_s() + kLongest_s;
  while (!discard_ && clock_monotonic_s() < end_s && bus_.handle(0) > 0) {
  }
  writer_->flush();
}

void BusRecorder::write(const BusMessage& message) {
  const bool full =
      single_file_.empty() && static_cast<double>(writer_->bytes()) >= config_.split_bytes;
  if (full) {
    writer_->flush();
    begin_file();
  }
  write_trust_lists(message);
  writer_->write(message);
  const std::lock_guard lock(mutex_);
  ++report_.messages;
}

void BusRecorder::look_after_file() {
  if (writer_->is_in_place()) return;
  spdlog::error("{}: was deleted, renamed or replaced while it was written", writer_->path());
  begin_file();
  const std::lock_guard lock(mutex_);
  ++report_.files_lost;
}

// In the receiving thread. The list by which the message was judged is the newest one, unless that
// was replaced in the meantime: then the newer one is taken with the next message.
void BusRecorder::receive_trust_list(const BusMessage& received) {
  if (received.list_number <= lists_.received.newest()) return;
  ReceivedList list{received.list_number, trust_->list_text(),
                    trust_->list_telling(received.received_utime_us)};
  if (trust_->list_number() == received.list_number) lists_.received.add(std::move(list));
}

// Each file begins with the list in force, and has each later one where it begins to hold: so
// `ols-key verify` can verify it by itself. lcm-logplayer plays it as any other message.
void BusRecorder::write_trust_lists(const BusMessage& next) {
  for (const ReceivedList& list : lists_.received.due(next.list_number, lists_.written)) {
    keep_beside(list);
    lists_.written = list.number;
    if (!list.telling) continue;
    writer_->write({std::string(trust::kTrustChannel), *list.telling, next.received_utime_us});
  }
}

// Each under its number: `ols-key verify` reads them years later.
void BusRecorder::keep_beside(const ReceivedList& list) {
  if (list.number <= lists_.kept) return;
  const auto folder = std::filesystem::absolute(writer_->path()).parent_path();
  AtomicFile file((folder / ("trust-" + std::to_string(list.number) + ".toml")).string());
  file.stream() << list.text;
  file.commit();
  lists_.kept = list.number;
}

void BusRecorder::begin_file() {
  const std::string path = single_file_.empty() ? names_.next(clock_utime_us()) : single_file_;
  writer_.emplace(path);
  lists_.written = 0;
  const std::lock_guard lock(mutex_);
  report_.file = path;
}

void BusRecorder::look_at_bus(double now_s) {
  const BusTraffic traffic = bus_.traffic();
  watch_.monitor.look(traffic, now_s);
  Alarm alarm = watch_.monitor.alarm(now_s);
  if (alarm.empty()) alarm = watch_.monitor.trust_alarm(now_s);
  watch_.journal.look(alarm.empty() ? std::vector<Alarm>{} : std::vector{alarm}, now_s);
  {
    const std::lock_guard lock(mutex_);
    report_.bus_alarm = alarm;
    report_.traffic = traffic;
    report_.dropped = traffic.overflowed;
  }
  if (bus_.is_deaf()) {
    throw std::runtime_error("no messages arrive any more, not even this program's own");
  }
}

}  // namespace ols::logger
