// One station over the bus, for a procedure: moves its unit with an operator's commands, asks it
// for frames, hears its status, and carries the procedure's state and a person's answers.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/lcm_bus.h"
#include "calibration/procedure/preconditions.h"
#include "calibration/procedure/stage.h"
#include "ols_msg/frame_part_t.hpp"
#include "ols_msg/procedure_t.hpp"
#include "ols_msg/station_status_t.hpp"
#include "tools/calibrate/answer_box.h"
#include "tools/calibrate/awaited_picture.h"
#include "tools/calibrate/manual_hold.h"

namespace ols::calibration {

// The station is stopped, by a person or an emergency: the procedure ends.
class StationStopped : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct FrameFile {
  Taken taken;
  std::vector<std::uint8_t> file;  // as it came
  bool lossless = true;
};

// kPasses: near there is enough, moving or not.
enum class Arrival { kStands, kPasses };

class StationLink {
 public:
  // What the process is on the bus: an operator. Null in mode off; throws ConfigError.
  static std::shared_ptr<trust::BusTrust> open_trust(const trust::TrustConfig& config);
  // Throws BusError. `bus` outlives it.
  StationLink(LcmBus& bus, std::string station);

  // Handles messages for at most this long.
  void handle(int timeout_ms) { bus_.handle(timeout_ms); }
  // The newest status; waits for one that was sent after this call, at most so long.
  std::optional<ols_msg::station_status_t> status(double within_s);
  double heard_s() const { return heard_s_; }  // monotonic, of the newest status
  // Throws StationStopped.
  void check_not_stopped() const;

  // Whether a status says that pointing ends no stop (motion_leave.h).
  bool may_point() const;
  // Where the unit stands, by its newest status; nothing while it does not know.
  std::optional<PanTilt> angles() const;
  // From now on the unit is wanted there, with a picture.
  void set_out(const PanTilt& angles);
  // Turns the unit to where it is wanted, and stays. Only where it may.
  void point();
  // Gives the unit back that it has pointed, if a fresh status says that it is under manual
  // operation: a release would end a person's stop, or another operator's hold. False: not sent.
  bool release();
  // [s] Between two statuses that follow each other, the least of some; infinite where none came.
  double status_gap_s();
  // Asks for a frame from where the unit is wanted.
  void ask_frame(Arrival arrival, bool lossless);
  // The frame that was asked for since the unit set out, once.
  std::optional<FrameFile> take_frame();
  // Of the last set_out().
  const AwaitedPicture& awaited() const { return awaited_; }

  void publish(ols_msg::procedure_t message);
  // A console wants the procedure to end.
  bool take_abort() { return answers_.take_abort(); }
  // An answer of a console to this question; those to others are dropped.
  std::optional<Answer> take_answer(std::int64_t question) { return answers_.take(question); }

  // What the unit says that a count is [rad]; nothing before the first frame.
  const std::optional<PanTilt>& count() const { return count_; }

 private:
  void hear_status(const BusMessage& message);
  void hear_part(const BusMessage& message);
  void hear_answer(const BusMessage& message);
  double status_age_s() const;
  void command(std::int8_t what, const PanTilt& angles);
  void complete(std::vector<std::uint8_t> file, const ols_msg::frame_part_t& any);
  template <class Message>
  void address(Message& message, double lease_s);

  std::string station_;
  LcmBus& bus_;
  std::int64_t boot_id_;
  std::int64_t sequence_ = 0, procedure_sequence_ = 0;
  std::optional<ols_msg::station_status_t> status_;
  double heard_s_ = 0.0;
  std::int64_t arrived_utime_us_ = 0;  // of the newest status
  AwaitedPicture awaited_;
  ManualHold hold_;
  std::optional<FrameFile> frame_;
  AnswerBox answers_;
  std::optional<PanTilt> count_;
};

// Of a status, for preconditions().
StationFacts facts_of(const ols_msg::station_status_t& status);

}  // namespace ols::calibration
