// The driver's insides, of driver*.cpp alone. What happens with a unit that is ready is in
// edge/ptu/steady_state.*, the line's budget in edge/ptu/budget.h.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edge/ptu/budget.h"
#include "edge/ptu/codec.h"
#include "edge/ptu/driver.h"
#include "edge/ptu/reference_watch.h"
#include "edge/ptu/start_sequence.h"
#include "edge/ptu/steady_state.h"

namespace ols {

struct PtuDriver::Impl {
  static constexpr double kQuiet_s = 0.06;  // silence that ends a flush
  static constexpr double kLongestFlush_s =
      2.0;  // a line that is not silent after so long is not a PTU's
  static constexpr double kFirstPause_s = 0.25;  // after a fault; doubles
  static constexpr double kLongestPause_s =
      1.0;  // with the other rate tried in between, healed in 4 s
  static constexpr double kShortestHoming_s = 2.0, kLongestHoming_s = 90.0;
  static constexpr int kRetries = 2;  // of a question of the start that was not answered

  enum class Phase { kFlush, kStart, kHoming, kReady, kPause };

  explicit Impl(const PtuConfig& ptu_config) : config(ptu_config), baud(ptu_config.baud) {}

  double byte_s() const { return byte_time_s(baud); }

  // The rate that the port has now. In pauses it is the one at which a unit that was switched on
  // homes itself and says so.
  int line_rate() const { return listening.value_or(baud); }

  // driver_start.cpp: the way to a unit that is ready, and back to it when it was lost.
  void begin(double time_s);
  void end_line(double time_s);
  void begin_flush(double time_s);
  void fault(double time_s, std::string reason);
  void change_rate(double time_s);
  std::string step_pause(double time_s);
  std::string step_flush(double time_s);
  std::string step_start(double time_s);
  void take_start_reply(const PtuReply& reply, double time_s);
  void become_ready(double time_s);
  void note_gears();
  void trust();
  void note_power_cycle();

  // driver_homing.cpp.
  bool may_home() const;
  bool home_if(bool wanted, double time_s);
  void want_home(double time_s);
  void give_up_homing(double time_s);
  void leave_homing();
  std::string step_homing(double time_s);
  void take_homing_reply(const PtuReply& reply, double time_s);

  // driver_ready.cpp: bytes and time to whom they concern, and a unit that can be driven.
  std::string step_ready(double time_s);
  void note_limit_hits(const std::vector<PtuReply>& replies, double time_s);
  void heed_trouble(double time_s);
  std::string step(double time_s);
  void note_call(double time_s);
  void take(const PtuReply& reply, double time_s);

  PtuConfig config;
  int baud;  // that is tried or in use
  Phase phase = Phase::kPause;
  PtuReplyParser parser;
  std::unique_ptr<PtuStartSequence> start;
  std::unique_ptr<PtuSteadyState> steady;
  std::optional<ServoGoal> goal;
  PtuCounters counters;
  ReferenceWatch reference;
  PtuLimitHits hits_noted;
  std::string error, urgent;
  bool emergency = false, link_lost = false, unreferenced = false, homed = false;
  bool rehoming_allowed = true;
  bool failed = false;           // since it was ready
  bool home_wanted = false;      // as soon as the unit stands
  bool homing = false;           // from then until it is ready
  std::optional<int> listening;  // line_rate() in a pause
  bool outstanding = false, flush_sent = false;
  bool answered = false;  // since begin(), at this rate
  int retries = 0;
  double called_s = 0.0;  // all bytes of before were read then
  double last_unread_s = 0.0;
  double late_s = 0.0;  // so long bytes may lie unread: the last two pauses between calls
  double sent_s = 0.0, flush_began_s = 0.0, last_byte_s = 0.0;
  double paused_s = 0.0, resume_s = 0.0, pause_s = kFirstPause_s;
  bool was_ready = false;
  // Some units do not know their gears before they are homed: nobody can vouch for their counts.
  bool gears_lost = false;
  double step_rad = 0.0;  // of a count of pan: when it was last trusted, or else first seen
  std::uint64_t banners_at_start = 0;
};

}  // namespace ols
