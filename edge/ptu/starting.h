// The phase of PtuDriver that starts a unit. Waits until the line is quiet, then sends the start
// sequence, one command at a time. Pure.
#pragma once

#include <optional>
#include <string>

#include "edge/ptu/driver_types.h"
#include "edge/ptu/start_sequence.h"

namespace ols::ptu {

class PtuStarting {
 public:
  // What follows the start sequence.
  enum class Purpose { kDrive, kHome, kDriveAfterHoming };

  // `counters` must outlive this object.
  PtuStarting(const PtuStartOptions& options, double reply_timeout_s, Purpose purpose,
              double time_s, PtuCounters& counters);

  enum class Event {
    kNone,
    // The caller must drop an incomplete reply: the line has become quiet, or a reply is missing.
    kLineDropped,
    kLineNotQuiet,  // bytes arrive for longer than a PTU would send
    kNoReply,
    kComplete,  // the start sequence is complete
  };
  struct Step {
    std::string bytes;  // bytes to write now
    Event event = Event::kNone;
  };
  Step step(double time_s, double byte_s, bool emergency);

  // Begins a flush: waits until the line is quiet, then sends the pending command again.
  void flush(double time_s);
  bool flushing() const { return flush_.has_value(); }
  void bytes_came(double time_s);

  bool waits_for_reply() const { return !flush_ && asked_s_; }
  // Takes the reply to the pending command. Returns false if the unit cannot be driven; refusal()
  // then states the reason.
  bool take(const PtuReply& reply);
  // The unit has answered at least one command at this baud rate.
  bool answered() const { return answered_; }
  std::string refusal(const PtuReply& reply) const { return sequence_.refusal(reply); }
  bool not_referenced() const { return sequence_.not_referenced(); }
  bool changed_baud() const { return sequence_.changed_baud(); }

  Purpose purpose() const { return purpose_; }
  void give_up_homing() { purpose_ = Purpose::kDrive; }
  const PtuFacts& facts() const { return sequence_.facts(); }
  std::string asked() const;  // the pending command

 private:
  struct Flush {
    double began_s, last_byte_s;
    bool sent = false;
  };
  Step step_flush(double time_s, double byte_s, bool emergency);
  Step step_question(double time_s);

  PtuStartSequence sequence_;
  const double reply_timeout_s_;
  Purpose purpose_;
  PtuCounters& counters_;
  std::optional<Flush> flush_;
  std::optional<double> asked_s_;  // time at which the pending command was sent
  bool answered_ = false;
  int retries_ = 0;
};

}  // namespace ols::ptu
