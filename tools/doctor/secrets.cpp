#include "tools/doctor/secrets.h"

#include <regex>
#include <sstream>

namespace ols::doctor {
namespace {

constexpr const char* kRemoved = "[removed]";

std::string line_without_secrets(const std::string& line) {
  static const auto kFlags = std::regex::ECMAScript | std::regex::icase | std::regex::optimize;
  // Its name, then what stands between it and the value: blanks, =, :, quotes.
  static const std::regex kNamed(
      R"(([-\w.]*(?:key|seed|secret|pass(?:word|wd|phrase)?|psk|token|invitation|credential)s?["']?(?:\s*[=:]\s*|\s+))(["']?)([^\s"']+|(?:(?!\2).)+)\2)",
      kFlags);
  static const std::regex kHex(R"([0-9a-f]{24,})", kFlags);
  static const std::regex kUrl(R"((\w+://)[^/@\s]+@)", kFlags);
  std::string result = std::regex_replace(line, kNamed, std::string("$1$2") + kRemoved + "$2");
  result = std::regex_replace(result, kHex, kRemoved);
  return std::regex_replace(result, kUrl, std::string("$1") + kRemoved + "@");
}

}  // namespace

std::string without_secrets(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  bool in_key = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("-----BEGIN") != std::string::npos && line.find("PRIVATE") != std::string::npos) {
      in_key = true;
      result.append(kRemoved).append("\n");
    }
    const bool ends = line.find("-----END") != std::string::npos;
    if (!in_key) result += line_without_secrets(line.substr(0, kLongestLine)) + "\n";
    if (ends) in_key = false;
  }
  return result;
}

}  // namespace ols::doctor
