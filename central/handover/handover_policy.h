// Which targets lead stations. A target that an operator has designated in a picture always does.
// If only detectors have found it, the site's policy and the operator decide: it is proposed,
// allowed or dismissed. Pure.
//
//  - off: targets of detections lead no station. propose: each waits for an operator. automatic:
//    each leads at once if its class is one of `classes`; the others wait for an operator.
//  - An operator's decision counts at once, for designated targets too, and until the target loses
//    its number.
//  - If a target is lost, its decision passes to the first new target that appears where the lost
//    one must be by then.
//  - A lost target that led stations is looked for where it must be by then, with growing
//    uncertainty, until it is found or seek_s are over.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "central/cues/cue_registry.h"
#include "central/tracking/target_appearance.h"

namespace ols::fusion {

enum class HandoverMode { kOff, kPropose, kAutomatic };
// "off", "propose", "automatic".
std::string to_string(HandoverMode mode);
std::optional<HandoverMode> handover_mode_named(std::string_view name);

struct HandoverConfig {
  HandoverMode mode = HandoverMode::kOff;
  // Classes whose objects lead without an operator's decision, in mode kAutomatic.
  std::vector<ObjectClass> classes{ObjectClass::kUnknown, ObjectClass::kDrone, ObjectClass::kBird,
                                   ObjectClass::kAircraft, ObjectClass::kOther};
  std::vector<std::string> staring{};  // stations that are never led
  double seek_s = 10.0;                // how long a lost target is looked for
  double remember_s = 10.0;            // how long the decision on a lost target is kept
  double acceleration_sd_m_s2 = 3.0;   // growth of a lost target's uncertainty
};

class HandoverPolicy {
 public:
  explicit HandoverPolicy(const HandoverConfig& config) : config_(config) {}

  // Takes note of the present targets, at a limited rate.
  void settle(std::int64_t now_us, const std::vector<Track>& tracks);
  // Changes the mode. Decisions that an operator has made stay.
  void set_mode(HandoverMode mode) { config_.mode = mode; }
  HandoverMode mode() const { return config_.mode; }
  // An operator's decision. False if there is no such target, or if it is allowed while the mode is
  // off. What was allowed before leads again when the mode is on.
  bool order(std::int64_t target_id, bool allow);
  // The target's priority when stations are allocated; 0: it leads no station. Higher for targets
  // that an operator has designated or allowed, lower for doubtful ones.
  double priority(const Track& track) const;
  // Lost targets, as places to look at.
  std::vector<CueAim> lost(std::int64_t now_us) const;
  // Targets that were found by detection or that an operator has judged, each under its number, in
  // the states of a cue: waiting (proposed), found (it leads stations), searched (lost, looked
  // for), forbidden (dismissed). None if the mode is off.
  std::vector<CueHealth> health(std::int64_t now_us) const;
  // Whether an object of this class leads stations without an operator's decision.
  bool leads_by_itself(ObjectClass object_class) const;
  void clear() {
    targets_.clear();
    settled_us_.reset();
  }

 private:
  struct Known {
    CueAim last;  // its last state
    ObjectClass object_class = ObjectClass::kUnknown;
    bool is_designated = false;  // a tracker followed it before the fusion led a station there
    bool has_led = false;        // a tracker that appears on it is no longer proof of an operator
    bool is_live = false;        // there is a track of it
    std::optional<bool> allowed{};  // the operator's decision
  };
  void note(const Track& track, std::int64_t now_us);
  void inherit(Known& known, const Track& track, std::int64_t now_us);
  bool leads(const Known& known) const;
  bool is_sought(const Known& known, std::int64_t now_us) const;
  bool is_remembered(const Known& known, std::int64_t now_us) const;
  CueState state_of(const Known& known) const;

  HandoverConfig config_;
  std::map<std::int64_t, Known> targets_;  // by their numbers
  std::optional<std::int64_t> settled_us_;
};

}  // namespace ols::fusion
