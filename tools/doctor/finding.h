// A finding of ols-doctor: one line per check, with advice. Pure.
#pragma once

#include <string>
#include <vector>

#include "conditions/alarm.h"

namespace ols::doctor {

enum class Verdict { kOk, kWarn, kFail };  // in order of severity

struct Finding {
  Verdict verdict = Verdict::kOk;
  std::string what;    // "ptu: PTU-D46 v2.12.1 on /dev/ols/ptu"
  std::string advice;  // what to do; empty if the check passed
};

inline Finding ok(std::string what) { return {Verdict::kOk, std::move(what), {}}; }
inline Finding warn(std::string what, std::string advice) {
  return {Verdict::kWarn, std::move(what), std::move(advice)};
}
inline Finding fail(std::string what, std::string advice) {
  return {Verdict::kFail, std::move(what), std::move(advice)};
}

// The advice for this alarm in the table of conditions.
std::string advice_on(const Alarm& alarm);

using Findings = std::vector<Finding>;

void append(Findings& all, const Findings& more);

// The finding as a line: "FAIL what — what to do".
std::string line(const Finding& finding);
// {"verdict": "warn", "findings": [{"verdict": "ok", "what": "...", "advice": ""}, ...]}
std::string to_json(const Findings& findings);
// The exit status for the most severe verdict: 0 ok, 1 warning, 2 failure.
int exit_status(const Findings& findings);

}  // namespace ols::doctor
