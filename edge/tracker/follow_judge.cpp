#include "edge/tracker/follow_judge.h"

#include <algorithm>
#include <cmath>

#include "edge/tracker/belief.h"

namespace ols::tracker {
namespace {

constexpr double kFallTime_s = 0.12;
constexpr double kRiseTime_s = 0.15;
constexpr double kSure = 0.8;
constexpr double kDoubted = 0.2;
constexpr double kLetsGo_s = 0.5;
constexpr double kLeast = 2.0;  // of the prominence: noise
constexpr double kNamed = 0.7;  // it has hardly left the place where a caller said it is

double smoothed(double before, double log_odds, double interval_s) {
  const double probability = 1.0 / (1.0 + std::exp(-log_odds));
  const double time_s = probability < before ? kFallTime_s : kRiseTime_s;
  return before + (probability - before) * (1.0 - std::exp(-interval_s / time_s));
}

}  // namespace

// Both are nearly normal with equal deviations on the target and off it, so the logarithm of the
// likelihood ratio is linear in them; docs/tracker.md has the data behind the weights.
double follow_log_odds(const FollowEvidence& evidence, double own) {
  // A response to noise has 7 (Bolme et al.) to 12; whatever its own, a target is believed
  // above 24.
  constexpr double kNoise = 12.0, kPlain = 24.0;
  constexpr double kEvenShare = 0.8, kProminenceWeight = 2.5;
  constexpr double kEvenChange = 0.8, kChangeWeight = 1.6;
  constexpr double kLeastChange = -1.0, kMostChange = 2.5;
  const double even = std::clamp(kEvenShare * own, kNoise, kPlain);
  const double odds = kProminenceWeight * std::log(std::max(kLeast, evidence.prominence) / even);
  if (!evidence.change) return odds + kNamed;
  const double change = std::clamp(*evidence.change, kLeastChange, kMostChange);
  return odds + kChangeWeight * (change - kEvenChange);
}

double colour_log_odds(const FollowEvidence& evidence) {
  constexpr double kColourWeight = 6.0, kEvenColours = 0.4;
  constexpr double kLeastColours = -0.5, kMostColours = 1.0;
  const double colours = std::clamp(evidence.colours, kLeastColours, kMostColours);
  return kColourWeight * evidence.separability * (colours - kEvenColours);
}

void FollowJudge::update(const FollowEvidence& evidence, double interval_s) {
  const double own = learn_own(evidence.prominence, interval_s);
  const double odds = follow_log_odds(evidence, own);
  value_ = smoothed(value_, odds, interval_s);
  belief_ = smoothed(belief_, odds + colour_log_odds(evidence), interval_s);
  wary_ = doubts() || (wary_ && !believes());
  doubted_s_ = doubts() ? doubted_s_ + interval_s : 0.0;
}

// Only while it is fresh: what it would learn later, it might learn of something else.
double FollowJudge::learn_own(double prominence, double interval_s) {
  constexpr double kFresh_s = 0.5;
  if (named_s_ < kFresh_s) {
    named_s_ += interval_s;
    const double log_prominence = std::log(std::max(kLeast, prominence));
    log_own_ += (log_prominence - log_own_) * std::min(1.0, interval_s / named_s_);
  }
  return std::exp(log_own_);
}

double FollowJudge::log_odds_elsewhere(const FollowEvidence& evidence) const {
  return follow_log_odds(evidence, std::exp(log_own_)) - (evidence.change ? 0.0 : kNamed);
}

bool FollowJudge::sure() const { return value_ > kSure; }

bool FollowJudge::believes() const { return value_ >= kBelieved; }

bool FollowJudge::doubts() const { return value_ < kDoubted; }

bool FollowJudge::lets_go() const { return doubted_s_ > kLetsGo_s; }

}  // namespace ols::tracker
