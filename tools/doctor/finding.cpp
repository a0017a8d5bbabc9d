#include "tools/doctor/finding.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/text/plain_text.h"
#include "conditions/alarm.h"

namespace ols::doctor {
namespace {

const char* word(Verdict verdict) {
  switch (verdict) {
    case Verdict::kOk:
      return "ok";
    case Verdict::kWarn:
      return "warn";
    case Verdict::kFail:
      return "FAIL";
  }
  return "FAIL";
}

Verdict gravest(const Findings& findings) {
  Verdict verdict = Verdict::kOk;
  for (const Finding& finding : findings) verdict = std::max(verdict, finding.verdict);
  return verdict;
}

}  // namespace

std::string advice_on(const Alarm& alarm) { return std::string(alarm.row().action); }

void append(Findings& all, const Findings& more) {
  all.insert(all.end(), more.begin(), more.end());
}

std::string line(const Finding& finding) {
  std::string text = word(finding.verdict);
  text.resize(6, ' ');
  text += finding.what;
  if (!finding.advice.empty()) text += "  — " + finding.advice;
  return plain_text(text);
}

std::string to_json(const Findings& findings) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Finding& finding : findings) {
    // Devices may answer with any byte.
    list.push_back({{"verdict", word(finding.verdict)},
                    {"what", plain_text(finding.what)},
                    {"advice", plain_text(finding.advice)}});
  }
  return nlohmann::ordered_json{{"verdict", word(gravest(findings))}, {"findings", list}}.dump(2);
}

int exit_status(const Findings& findings) { return static_cast<int>(gravest(findings)); }

}  // namespace ols::doctor
