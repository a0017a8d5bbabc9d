#include "edge/recorder/recorder.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <thread>
#include <utility>

#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "edge/device/behind_control_loop.h"
#include "edge/recorder/event_folder.h"
#include "edge/recorder/event_queue.h"
#include "edge/recorder/event_store.h"
#include "edge/recorder/record_command.h"

namespace ols::recorder {
namespace {

constexpr double kSurvey_s = 2.0;  // interval of the disk checks
constexpr double kRetry_s = 2.0;   // until finishing an event is retried
constexpr double kAtEnd_s = 5.0;   // to write the remaining frames when the station stops

// The disk as last checked by the writing thread.
struct DiskState {
  std::string trouble;  // its present fault
  std::optional<double> good_s;
  double free_bytes = 0.0, stored_bytes = 0.0, room_bytes = 0.0;
  std::size_t stored_events = 0;
  std::uint64_t events_removed = 0;
};

struct RecorderCounters {
  std::uint64_t frames_written = 0, frames_dropped = 0, events_written = 0, events_failed = 0,
                refused = 0, refused_no_room = 0, refused_too_many = 0;
};

}  // namespace

struct Recorder::Impl {
  explicit Impl(const RecorderConfig& recorder_config)
      : config(recorder_config),
        store({config.folder, config.quota_bytes, config.disk_reserve_bytes, config.protect_s}),
        queue(config) {}

  // --- of any thread

  void add(const RecordedFrame& frame) {
    const std::lock_guard lock(mutex);
    note_dropped(queue.add(frame));
    wake.notify_all();
  }

  void note_dropped(int frames) {
    for (; frames > 0; --frames) {
      ++counters.frames_dropped;
      note("the disk is too slow");
    }
  }

  std::string refusal(const RecordCommand& command, double now_s) {
    std::string why = queue.refusal(command, now_s);
    if (why.empty()) why = disk.trouble;
    if (!why.empty()) return why;
    const double wanted = queue.expected_bytes(command);
    if (disk.good_s && wanted + queue.still_to_write() > disk.room_bytes) {
      ++counters.refused_no_room;
      wanted_bytes = wanted;
      return "no space for " + std::to_string(std::llround(wanted * 1e-6)) + " MB";
    }
    if (rate.admit(now_s)) return {};
    ++counters.refused_too_many;
    return "too many recordings in a short time";
  }

  std::string record(const RecordCommand& command) {
    const double now_s = clock_monotonic_s();
    const std::lock_guard lock(mutex);
    if (std::string why = refusal(command, now_s); !why.empty()) {
      ++counters.refused;
      return why;
    }
    wanted_bytes = 0.0;
    note_dropped(
        queue.begin(command, clock_utime_us() - std::llround((now_s - command.event_s) * 1e6)));
    wake.notify_all();
    return {};
  }

  void note(const std::string& what) {
    error = what;
    ++errors;
  }

  // --- of the writing thread

  void run(const std::stop_token& ended) {
    go_behind();
    double survey_s = 0.0;
    while (!ended.stop_requested()) {
      if (clock_monotonic_s() >= survey_s) {
        survey();
        survey_s = clock_monotonic_s() + kSurvey_s;
      }
      if (write_one()) continue;
      std::unique_lock lock(mutex);
      wake.wait_for(lock, ended, std::chrono::duration<double>(0.2),
                    [this] { return queue.work_waits(); });
    }
    const double end_s = clock_monotonic_s() + kAtEnd_s;
    {
      const std::lock_guard lock(mutex);
      queue.close(std::numeric_limits<double>::infinity());
      queue.retry_all();
    }
    while (clock_monotonic_s() < end_s && write_one()) {
    }
  }

  void go_behind() {
    std::string failed = device::go_behind_control_loop();
    const std::lock_guard lock(mutex);
    beside = std::move(failed);
  }

  // The disk's condition, for the report and for later commands.
  void survey() {
    std::string found;
    try {
      bool in_trouble = false;
      {
        const std::lock_guard lock(mutex);
        in_trouble = !disk.trouble.empty();
      }
      in_trouble ? store.try_writing() : store.survey();
      if (store.full()) found = store.full_text();
    } catch (const std::exception& failure) {
      found = failure.what();
    }
    set_trouble(found);
  }

  void set_trouble(const std::string& what) {
    const double room = store.room_bytes(open_names(), clock_utime_us());
    const std::lock_guard lock(mutex);
    // Free space changes all the time; only too little of it is news.
    if (!what.empty() && disk.trouble.empty()) note(what);
    if (what.empty()) disk.good_s = clock_monotonic_s();
    disk = {what, disk.good_s,    store.free_bytes(), store.bytes(),
            room, store.events(), store.removed()};
  }

  // One frame, or the end of one event. False: nothing to do.
  bool write_one() {
    const double now_s = clock_monotonic_s();
    std::optional<EventQueue::Job> job;
    {
      const std::lock_guard lock(mutex);
      queue.close(now_s);
      job = queue.next(now_s);
    }
    if (!job) return false;
    job->frame ? write_frame(*job->event, *job->frame) : end_event(*job->event);
    return true;
  }

  std::set<std::string> open_names() const {
    const std::lock_guard lock(mutex);
    return queue.names();
  }

  void write_frame(RecordedEvent& event, const RecordedFrame& frame) {
    std::string failed;
    try {
      if (!event.folder) {
        store.survey();
        if (event.name.empty()) event.name = store.free_name(event.utime_us, event.label);
      }
      // A frame is hardly ever larger as PNG.
      store.make_room(static_cast<double>(bytes_of(frame)), open_names(), clock_utime_us());
      if (!event.folder) event.folder.emplace(config.folder, event.name);
      const std::size_t bytes = event.folder->write(frame, encode_png(frame));
      store.add(event.name + kPartial, static_cast<double>(bytes));
    } catch (const std::exception& failure) {
      failed = failure.what();
    }
    set_trouble(failed);
    // The folder was removed: create another one as soon as possible.
    const bool lost = event.folder && !event.folder->exists();
    if (lost) event.folder.reset();
    const std::lock_guard lock(mutex);
    if (lost) event.written = 0;
    failed.empty() ? ++counters.frames_written : ++counters.frames_dropped;
    if (failed.empty()) ++event.written;
    event.expected_bytes =
        std::max(0.0, event.expected_bytes - static_cast<double>(bytes_of(frame)));
  }

  void end_event(RecordedEvent& event) {
    const bool vanished = event.folder && !event.folder->exists();
    if (event.folder && !vanished) {
      try {
        event.written > 0 ? event.folder->finish() : event.folder->discard();
        store.finished(event.name);
      } catch (const std::exception& failure) {
        return put_off(event, failure.what());
      }
    }
    {
      const std::lock_guard lock(mutex);
      if (vanished) note(event.name + " vanished before it was complete");
      event.written > 0 && !vanished ? ++counters.events_written : ++counters.events_failed;
      queue.remove(event);
    }
    survey();
  }

  // The others continue meanwhile.
  void put_off(RecordedEvent& event, const std::string& why) {
    const std::lock_guard lock(mutex);
    if (event.unfinished.empty()) note(why);
    event.unfinished = why;
    event.retry_s = clock_monotonic_s() + kRetry_s;
  }

  // The present fault of the disk or of an event; empty: none.
  std::string wrong() const { return disk.trouble.empty() ? queue.unfinished() : disk.trouble; }

  const RecorderConfig config;
  EventStore store;  // used by the writing thread only

  mutable std::mutex mutex;  // guards all members below
  std::condition_variable_any wake;
  EventQueue queue;
  DiskState disk;
  RecordRate rate;
  RecorderCounters counters;
  double wanted_bytes = 0.0;  // of the last recording refused for lack of space
  std::string error;          // the last error
  std::uint64_t errors = 0;
  std::string beside;   // why its thread could not lower its priority; empty: it could
  std::jthread thread;  // last: it uses the rest
};

Recorder::Recorder(const RecorderConfig& config) : impl_(std::make_unique<Impl>(config)) {
  if (config.folder.empty()) return;
  impl_->thread = std::jthread([impl = impl_.get()](const std::stop_token& t) { impl->run(t); });
}

Recorder::~Recorder() = default;  // the jthread asks to stop and joins

void Recorder::add(const camera::Frame& frame, std::int64_t utime_us) {
  if (impl_->config.folder.empty()) return;
  impl_->add({frame.raw.empty() ? frame.gray : frame.raw, frame.pixel_format, utime_us,
              frame.mid_exposure_s, frame.stamp_sd_s, frame.stamp_source, frame.number});
}

std::string Recorder::record(const RecordCommand& command) { return impl_->record(command); }

device::DeviceReport Recorder::report() const {
  const std::lock_guard lock(impl_->mutex);
  device::DeviceReport report;
  report.name = "recorder";
  const DiskState& disk = impl_->disk;
  report.last_good_s = disk.good_s;
  report.last_error = impl_->error;
  report.errors = impl_->errors;
  report.counters = {{"recorder_frames_written", impl_->counters.frames_written},
                     {"recorder_frames_dropped", impl_->counters.frames_dropped},
                     {"recorder_events_written", impl_->counters.events_written},
                     {"recorder_events_failed", impl_->counters.events_failed},
                     {"recorder_events_removed", disk.events_removed},
                     {"recorder_commands_refused", impl_->counters.refused},
                     {"recorder_refused_no_room", impl_->counters.refused_no_room},
                     {"recorder_refused_too_many", impl_->counters.refused_too_many}};
  report.readings = {{"disk_free_bytes", disk.free_bytes},
                     {"recorder_events", static_cast<double>(disk.stored_events)},
                     {"recorder_bytes", disk.stored_bytes},
                     {"recorder_room_bytes", disk.room_bytes}};
  if (impl_->wanted_bytes > disk.room_bytes) {
    report.alarms.push_back(alarm::recorder_refuses());
  }
  if (const std::string wrong = impl_->wrong(); !wrong.empty()) {
    report.state = device::DeviceState::kFault;
    report.text = wrong;
    report.alarms.push_back(alarm::recorder_fails(wrong));
  } else if (!disk.good_s) {
    report.state = device::DeviceState::kStarting;
    report.text = impl_->config.folder;
  } else {
    report.state = device::DeviceState::kOk;
    report.text = std::to_string(disk.stored_events) + " events in " + impl_->config.folder;
    if (!impl_->queue.empty()) report.text += ", recording";
    if (!impl_->beside.empty()) report.text += "; " + impl_->beside;
  }
  return report;
}

}  // namespace ols::recorder
