// A procedure's connection to one station: moves the unit with an operator's commands, requests
// frames, receives the station's status, publishes the procedure's state, and receives a person's
// answers.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/bus/lcm_bus.h"
#include "calibration/procedure/preconditions.h"
#include "calibration/procedure/stage.h"
#include "ols_msg/frame_part_t.hpp"
#include "ols_msg/procedure_t.hpp"
#include "ols_msg/station_status_t.hpp"
#include "tools/calibrate/answer_box.h"
#include "tools/calibrate/awaited_picture.h"
#include "tools/calibrate/manual_hold.h"
#include "wire/order.h"

namespace ols::calibration {

// The station was stopped, by a person or by the emergency stop. This ends the procedure.
class StationStopped : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct FrameFile {
  Taken taken;
  std::vector<std::uint8_t> file;  // as received
  bool lossless = true;
};

// When a picture may be taken. kStands: at rest at the requested angles. kPasses: near the
// requested angles, perhaps in motion. kRests: at rest, at any angles. kAnywhere: at any angles,
// perhaps in motion.
enum class Arrival { kStands, kPasses, kRests, kAnywhere };

class StationLink {
 public:
  // Opens the keys with which the procedure signs as an operator. Null in mode off. Throws
  // ConfigError.
  static std::shared_ptr<trust::BusTrust> open_trust(const trust::TrustConfig& config);
  // Throws BusError. `bus` must outlive this object.
  StationLink(LcmBus& bus, std::string station);

  // Waits for messages and handles them, for at most this long.
  void handle(int timeout_ms) { bus_.handle(timeout_ms); }
  // The newest status. First waits, at most `within_s`, for a status that is sent after this call.
  std::optional<ols_msg::station_status_t> status(double within_s);
  double heard_s() const { return heard_s_; }  // when the newest status arrived (monotonic)
  // Throws StationStopped.
  void check_not_stopped() const;

  // Whether the newest status shows that pointing would not end a stop (motion_leave.h).
  bool may_point() const;
  // The unit's angles in its newest status; nullopt if the unit does not know them.
  std::optional<PanTilt> angles() const;
  // Sets the next angles for the unit. From now on, a picture at these angles is awaited. Sends
  // nothing.
  void set_out(const PanTilt& angles);
  // Orders the unit to the angles of the last set_out(). Call only if may_point().
  void point();
  // Turns the unit at these rates for a moment. For a longer motion, call it again at least every
  // 0.3 s. The link must have pointed the unit before.
  void turn_at(const PanTilt& rate_rad_s);
  // Why the station refused the last order to turn, in words; empty: it did not refuse.
  const std::string& refusal() const { return refusal_; }
  // Whether the refusal is final. If the unit does not answer, the refusal is not final: its line
  // may only be interrupted. If the unit has lost its reference after a power cut, it is final.
  bool is_refused_for_good() const { return !refusal_.empty() && !unit_may_come_back_; }
  // Releases the unit if this link has pointed it and a fresh status still shows manual operation.
  // In any other case, a release could end a person's stop or another operator's manual operation.
  // Waits for the answer. Returns false if the unit was not released.
  bool release();
  // [s] The shortest of a few intervals between consecutive statuses; infinite if no statuses came.
  double status_gap_s();
  // Requests a frame; `arrival` says when it may be taken. "The requested angles" are those of the
  // last set_out().
  void ask_frame(Arrival arrival, bool lossless);
  // Returns the frame that was requested since the last set_out(), once.
  std::optional<FrameFile> take_frame();
  // The picture awaited since the last set_out().
  const AwaitedPicture& awaited() const { return awaited_; }

  void publish(ols_msg::procedure_t message);
  // Returns true, once, if a console has asked for an abort of the procedure.
  bool take_abort() { return answers_.take_abort(); }
  // A console's answer to this question; discards other answers.
  std::optional<Answer> take_answer(std::int64_t question) { return answers_.take(question); }

  // The size of the unit's counts [rad], as the station reports it with each frame; nullopt before
  // the first frame.
  const std::optional<PanTilt>& count() const { return count_; }

 private:
  void hear_status(const BusMessage& message);
  void hear_part(const BusMessage& message);
  void hear_answer(const BusMessage& message);
  double status_age_s() const;
  void hear(const wire::Reply& reply);
  // Returns the command's sequence number.
  std::int64_t command(std::int8_t what, const PanTilt& angles);
  void complete(std::vector<std::uint8_t> file, const ols_msg::frame_part_t& any);
  template <class Message>
  void address(Message& message, double lease_s);

  std::string station_;
  LcmBus& bus_;
  std::int64_t boot_id_;
  std::int64_t sequence_ = 0, procedure_sequence_ = 0;
  std::optional<ols_msg::station_status_t> status_;
  double heard_s_ = 0.0;
  std::int64_t arrived_utime_us_ = 0;  // when the newest status arrived
  AwaitedPicture awaited_;
  ManualHold hold_;
  // Sequence numbers of the last commands to point and to release.
  std::int64_t pointed_sequence_ = 0, released_sequence_ = 0;
  std::string refusal_;
  bool unit_may_come_back_ = false;
  std::optional<bool> released_;  // the station's answer to the release
  std::optional<FrameFile> frame_;
  AnswerBox answers_;
  std::optional<PanTilt> count_;
};

// Extracts from a status the facts that preconditions() needs.
StationFacts facts_of(const ols_msg::station_status_t& status);

}  // namespace ols::calibration
