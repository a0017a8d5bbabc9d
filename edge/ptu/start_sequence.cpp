#include "edge/ptu/start_sequence.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "geometry/angles.h"

namespace ols::ptu {

namespace {

constexpr double kSlowReply_s = 10.0;
constexpr double kFinestResolution_arcsec = 0.1;
constexpr double kCoarsestResolution_arcsec = 3600.0;
constexpr int kMaxAsked = 8;  // until two answers in a row agree

bool accepted(const PtuReply& reply) { return reply.ok; }

std::string with_letter(std::string_view command, char letter) {
  return std::string(command) + letter;
}

}  // namespace

// `i`, or verbose "PTU is in Independent Mode" or "Independent speed control mode"; the case of the
// letter differs between units.
bool says_independent(const PtuReply& reply) {
  std::string text = reply.text;
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return reply.ok && (text == "i" || text.find("independent") != std::string::npos);
}

PtuStartSequence::PtuStartSequence(const PtuStartOptions& options)
    : acceleration_rad_s2_(options.acceleration_rad_s2) {
  add("ED");  // no echo
  add("FT");  // short replies
  add("H");   // ends the motion of a previous host
  if (options.change_baud_to > 0) {
    add("@(" + std::to_string(options.change_baud_to) + ",0,F)");
    steps_.back().changes_baud = true;
  }
  // Speeds are bounds of position moves. In velocity mode the unit would continue to move when this
  // host fails, so an answer of `*` is not enough.
  constexpr std::string_view kVelocities = "the unit may be in velocity mode";
  require("CI", accepted, kVelocities, false);
  require("C", says_independent, kVelocities, true);
  add("I");  // moves begin at once
  require("LE", accepted, "the unit's soft limits are not known to be on", false);
  add("A", true);
  add_modes(options);
  steps_.push_back({[] { return PtuRequest().plain("V"); },
                    [this](const PtuReply& reply) {
                      if (reply.ok) facts_.firmware = reply.text;
                      return true;
                    }});
  add_axis(PtuAxis::kPan, &PtuFacts::pan);
  add_axis(PtuAxis::kTilt, &PtuFacts::tilt);
}

void PtuStartSequence::add_modes(const PtuStartOptions& options) {
  for (const char axis : {'P', 'T'}) {
    if (options.step_mode != 0) add(with_letter(std::string("W") + axis, options.step_mode));
    if (options.hold_power != 0) add(with_letter(std::string(1, axis) + "H", options.hold_power));
    if (options.move_power != 0) add(with_letter(std::string(1, axis) + "M", options.move_power));
  }
}

double PtuStartSequence::timeout_s(double normal_s) const {
  return slow() ? std::max(normal_s, kSlowReply_s) : normal_s;
}

bool PtuStartSequence::take(const PtuReply& reply) {
  const Step& step = steps_.at(next_);
  changed_baud_ = false;
  if (step.twice) {
    const std::string answer = (reply.ok ? "*" : "!") + reply.text;
    const bool agreed = asked_ > 0 && answer == previous_;
    previous_ = answer;
    if (!agreed) return ++asked_ < kMaxAsked;  // once more
  }
  if (!step.take(reply)) return false;
  changed_baud_ = step.changes_baud && reply.ok;
  asked_ = 0;
  ++next_;
  return true;
}

std::string PtuStartSequence::refusal(const PtuReply& reply) const {
  const Step& step = steps_.at(next_);
  std::string reason = "unusable reply to " + step.request().bytes();
  reason.back() = ':';  // in place of the delimiter
  reason += (reply.ok ? " * " : " ! ") + reply.text;
  return step.without.empty() ? reason : step.without + ": " + reason;
}

// Some firmware does not support this mode; that is not an error.
void PtuStartSequence::add(std::string_view command, bool slow) {
  steps_.push_back({[text = std::string(command)] { return PtuRequest().plain(text); },
                    [](const PtuReply&) { return true; }, slow});
}

void PtuStartSequence::require(std::string_view command, std::function<bool(const PtuReply&)> take,
                               std::string_view without, bool twice) {
  steps_.push_back({[text = std::string(command)] { return PtuRequest().plain(text); },
                    std::move(take), false, twice, std::string(without)});
}

void PtuStartSequence::add_count(PtuAxis axis, PtuAxisFacts PtuFacts::*facts, PtuQuantity quantity,
                                 std::int32_t PtuAxisFacts::*value) {
  steps_.push_back({[=] { return PtuRequest().query(axis, quantity); },
                    [=, this](const PtuReply& reply) {
                      const auto count = reply.count();
                      if (complaint(reply.text) == PtuComplaint::kNotReferenced) {
                        not_referenced_ = true;
                      }
                      if (!reply.ok || !count) return false;
                      facts_.*facts.*value = *count;
                      return true;
                    },
                    false, true});
}

void PtuStartSequence::add_axis(PtuAxis axis, PtuAxisFacts PtuFacts::*facts) {
  steps_.push_back({[=] { return PtuRequest().query(axis, PtuQuantity::kResolution); },
                    [=, this](const PtuReply& reply) {
                      const double arcsec = reply.number.value_or(0.0);
                      (facts_.*facts).resolution_rad = radians(arcsec / 3600.0);
                      return reply.ok && arcsec >= kFinestResolution_arcsec &&
                             arcsec <= kCoarsestResolution_arcsec;
                    },
                    false, true});
  add_count(axis, facts, PtuQuantity::kMinPosition, &PtuAxisFacts::min);
  add_count(axis, facts, PtuQuantity::kMaxPosition, &PtuAxisFacts::max);
  add_count(axis, facts, PtuQuantity::kLowerSpeed, &PtuAxisFacts::lower_speed);
  add_count(axis, facts, PtuQuantity::kUpperSpeed, &PtuAxisFacts::upper_speed);
  add_acceleration(axis, facts);
}

void PtuStartSequence::add_acceleration(PtuAxis axis, PtuAxisFacts PtuFacts::*facts) {
  add_count(axis, facts, PtuQuantity::kAcceleration, &PtuAxisFacts::acceleration);
  steps_.push_back({[=, this] {
                      const PtuAxisFacts& known = facts_.*facts;
                      const auto wanted = static_cast<std::int32_t>(
                          std::lround(acceleration_rad_s2_ / known.resolution_rad));
                      // Setting takes a real unit seconds: skip it if the value is right already.
                      if (wanted == known.acceleration) {
                        return PtuRequest().query(axis, PtuQuantity::kAcceleration);
                      }
                      return PtuRequest().set(axis, PtuQuantity::kAcceleration, wanted);
                    },
                    [](const PtuReply&) { return true; }, true});
  add_count(axis, facts, PtuQuantity::kAcceleration, &PtuAxisFacts::acceleration);
  const auto& check = steps_.back().take;
  steps_.back().take = [=, this, previous = check](const PtuReply& reply) {
    return previous(reply) && sensible(facts_.*facts);
  };
}

// A unit that was not homed does not know its travel.
bool PtuStartSequence::sensible(const PtuAxisFacts& facts) {
  if (facts.min >= facts.max) not_referenced_ = true;
  return facts.min < facts.max && facts.lower_speed >= 0 && facts.upper_speed > facts.lower_speed &&
         facts.acceleration > 0;
}

}  // namespace ols::ptu
