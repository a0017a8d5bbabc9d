#include "tools/doctor/finding.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/plain_text.h"

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

// Device texts may contain any byte.
std::string quoted(const std::string& text) { return nlohmann::json(plain_text(text)).dump(); }

}  // namespace

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
  std::string out = "{\"verdict\": " + quoted(word(gravest(findings))) + ", \"findings\": [";
  bool first = true;
  for (const Finding& finding : findings) {
    out += first ? "\n" : ",\n";
    first = false;
    out += "  {\"verdict\": " + quoted(word(finding.verdict)) +
           ", \"what\": " + quoted(finding.what) + ", \"advice\": " + quoted(finding.advice) + "}";
  }
  return out + "\n]}";
}

int exit_status(const Findings& findings) { return static_cast<int>(gravest(findings)); }

}  // namespace ols::doctor
