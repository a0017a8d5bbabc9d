// Decides which targets lead stations: stations that do not see such a target are slewed to it. A
// target that an operator has designated in a picture always leads stations. A target that only
// detectors have found is proposed, allowed or dismissed; the site's policy and the operator
// decide. Pure.
//
//  - The policy for targets found by detectors is one of three. off: they lead no station. propose:
//    each waits for an operator. automatic: targets of the configured `classes` lead at once, and
//    all other targets wait for an operator.
//  - An operator's decision takes effect at once, and also applies to designated targets. It lasts
//    until the target loses its number. Designating a dismissed target takes the dismissal back.
//  - If a target is lost, the decision on it passes to the first new target that appears at its
//    predicted position.
//  - A lost target that led stations is searched for at its predicted position, with growing
//    uncertainty, until it is found or seek_s have passed.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
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
  // In mode kAutomatic, objects of these classes lead stations without an operator's decision.
  std::vector<ObjectClass> classes{ObjectClass::kUnknown, ObjectClass::kDrone, ObjectClass::kBird,
                                   ObjectClass::kAircraft, ObjectClass::kOther};
  std::vector<std::string> staring{};  // stations that are never led
  double seek_s = 10.0;                // how long a lost target is searched for
  double remember_s = 10.0;            // how long the decision on a lost target is kept
  // 1-sigma of the assumed acceleration. It determines how fast a lost target's uncertainty grows.
  double acceleration_sd_m_s2 = 3.0;
};

class HandoverPolicy {
 public:
  explicit HandoverPolicy(const HandoverConfig& config) : config_(config) {}

  // Takes note of the present targets. Does nothing within 0.1 s of its last call.
  void settle(std::int64_t now_us, const std::vector<Track>& tracks);
  // Changes the mode. Operators' decisions remain in force.
  void set_mode(HandoverMode mode) { config_.mode = mode; }
  HandoverMode mode() const { return config_.mode; }
  // Takes an operator's decision. Returns false if the target is unknown, or if it is allowed while
  // the mode is off. Targets that were allowed before the mode was switched off lead again when it
  // is switched on.
  bool order(std::int64_t target_id, bool allow);
  // The target's priority when stations are allocated; 0 if it leads no station. The priority is
  // the probability that the target exists, times the probability that its class is one that leads
  // stations. If an operator has designated or allowed the target, the second factor is 10.
  double priority(const Track& track) const;
  // Whether an operator has designated or allowed the target. The stations that track such a target
  // are not led elsewhere.
  bool is_wanted(std::int64_t target_id) const;
  // Whether trackers are to let go of the target. Either an operator has dismissed it; or the mode
  // is automatic, the target has led stations, and its class now turns out to be one that leads
  // none.
  bool is_let_go(std::int64_t target_id) const;
  bool is_dismissed(std::int64_t target_id) const;
  // Lost targets at whose predicted positions stations are to search.
  std::vector<CueAim> lost(std::int64_t now_us) const;
  // Targets that detectors have found or on which an operator has decided, each under its number.
  // The states are those of a cue: waiting (proposed), found (it leads stations), searched (lost
  // and being searched for), forbidden (dismissed). Empty if the mode is off.
  std::vector<CueHealth> health(std::int64_t now_us) const;
  // Whether an object of this class leads stations without an operator's decision.
  bool leads_by_itself(ObjectClass object_class) const;
  void clear() {
    targets_.clear();
    settled_us_.reset();
  }

 private:
  struct Known {
    KinematicState last;  // its last state
    ObjectClass object_class = ObjectClass::kUnknown;
    bool is_designated = false;  // an operator has designated it in a picture
    bool has_led = false;
    bool is_live = false;           // there is a track of this target
    std::optional<bool> allowed{};  // the operator's decision
    // The trackers that followed the target when it was dismissed (station, track id). nullopt
    // until the first settle() after the dismissal.
    std::optional<std::set<std::pair<std::string, std::int64_t>>> dismissed{};
  };
  void note(const Track& track, std::int64_t now_us);
  void note_dismissed(Known& known, const Track& track);
  void inherit(Known& known, const Track& track, std::int64_t now_us);
  bool leads(const Known& known) const;
  double probability_to_lead(const Track& track) const;
  bool is_sought(const Known& known, std::int64_t now_us) const;
  bool is_remembered(const Known& known, std::int64_t now_us) const;
  CueState state_of(const Known& known) const;

  HandoverConfig config_;
  std::map<std::int64_t, Known> targets_;  // by target number
  std::optional<std::int64_t> settled_us_;
};

}  // namespace ols::fusion
