#include "tools/key/log_check.h"

#include <cstdio>
#include <exception>
#include <utility>

#include "base/bus_inbox.h"
#include "base/trust/messages_trust.h"

namespace ols::key {
namespace {

// Of a log that anybody may have written to: more channels are counted together.
constexpr std::size_t kMostChannels = 10'000;
constexpr const char* kOtherChannels = "(others)";

}  // namespace

std::optional<std::int64_t> told_number(std::string_view channel, trust::Bytes message) {
  if (channel != trust::kTrustChannel) return std::nullopt;
  const auto text = trust::list_from(trust::without_trailer(message));
  if (!text) return std::nullopt;
  try {
    return trust::read_list(*text, "OLS_TRUST").number;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

LogCheck::LogCheck(std::map<std::int64_t, trust::TrustList> lists)
    : lists_(std::move(lists)),
      in_force_(lists_.rbegin()->first),
      verifier_({.clock_tolerance_us = 30'000'000, .takes_stale_statuses = true}, std::nullopt,
                lists_.rbegin()->second) {}

void LogCheck::follow_list(std::string_view channel, trust::Bytes message) {
  const auto number = told_number(channel, message);
  if (!number || *number == in_force_ || !lists_.contains(*number)) return;
  in_force_ = *number;
  verifier_.adopt(lists_.at(in_force_));
}

void LogCheck::add(std::string_view channel, trust::Bytes message, std::int64_t utime_us) {
  if (channel == kSelfTestChannel) return;
  follow_list(channel, message);
  std::string name(channel);
  if (channels_.size() >= kMostChannels && !channels_.contains(name)) name = kOtherChannels;
  const auto verdict =
      verifier_.judge(channel, message, {utime_us, static_cast<double>(utime_us) * 1e-6});
  Count& count = channels_[name];
  if (verdict.distrust) {
    ++count.bad[to_string(*verdict.distrust)];
  } else {
    ++count.good;
  }
}

std::uint64_t LogCheck::bad() const {
  std::uint64_t sum = 0;
  for (const auto& [channel, count] : channels_) {
    for (const auto& [reason, number] : count.bad) sum += number;
  }
  return sum;
}

std::string LogCheck::text() const {
  std::string text;
  for (const auto& [channel, count] : channels_) {
    char line[128];
    std::snprintf(line, sizeof line, "%-48s %10llu good", channel.c_str(),
                  static_cast<unsigned long long>(count.good));
    text += line;
    for (const auto& [reason, number] : count.bad) {
      text += ", " + std::to_string(number) + " " + reason;
    }
    text += '\n';
  }
  return text;
}

}  // namespace ols::key
