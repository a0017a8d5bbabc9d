#include "tools/key/log_check.h"

#include <exception>
#include <utility>

#include "base/bus/bus_inbox.h"
#include "base/trust/messages_trust.h"
#include "conditions/printed.h"

namespace ols::key {
namespace {

// Anybody may have written to the log, so further channels are counted together.
constexpr std::size_t kMostChannels = 10'000;
constexpr const char* kOtherChannels = "(others)";

// For recordings, whose time is not the present.
const trust::Verifier::Config kRecorded{
    .clock_tolerance_us = 30'000'000, .takes_stale_statuses = true, .is_stop = trust::is_stop};

// The number of the known list in the message, whoever sent it.
std::optional<std::int64_t> number_in(const Lists& lists, std::string_view channel,
                                      trust::Bytes message) {
  if (channel != trust::kTrustChannel) return std::nullopt;
  const auto text = trust::list_from(trust::without_trailer(message));
  if (!text) return std::nullopt;
  try {
    const std::int64_t number = trust::read_list(*text, "OLS_TRUST").number;
    if (lists.contains(number)) return number;
  } catch (const std::exception&) {  // no list
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::int64_t> told_number(const Lists& lists, std::string_view channel,
                                        trust::Bytes message) {
  const auto number = number_in(lists, channel, message);
  if (!number) return std::nullopt;
  const trust::TrustList& list = lists.at(*number);
  const auto verdict = trust::Verifier(kRecorded, std::nullopt, list).judge(channel, message, {});
  if (verdict.distrust || list.find(verdict.sender)->role == trust::Role::kStation) {
    return std::nullopt;
  }
  return number;
}

LogCheck::LogCheck(Lists lists, std::int64_t first)
    : lists_(std::move(lists)),
      in_force_{first},
      verifier_(kRecorded, std::nullopt, lists_.at(first)) {}

// Follows a list as the site's programs did: if it came from a member, or from one that the newer
// list itself makes a member. Never an older one, by which a revoked key would come back.
bool LogCheck::follow_list(std::string_view channel, trust::Bytes message, bool believed) {
  const auto number =
      believed ? number_in(lists_, channel, message) : told_number(lists_, channel, message);
  if (!number || *number <= in_force_.back()) return false;
  in_force_.push_back(*number);
  verifier_.adopt(lists_.at(*number));
  return true;
}

std::optional<trust::Distrust> LogCheck::judge(std::string_view channel, trust::Bytes message,
                                               std::int64_t utime_us) {
  const double then_s = static_cast<double>(utime_us) * 1e-6;
  return verifier_.judge(channel, message, {utime_us, then_s}).distrust;
}

void LogCheck::add(std::string_view channel, trust::Bytes message, std::int64_t utime_us) {
  if (channel == kSelfTestChannel) return;
  std::string name(channel);
  if (channels_.size() >= kMostChannels && !channels_.contains(name)) name = kOtherChannels;
  auto distrust = judge(channel, message, utime_us);
  const bool follows = follow_list(channel, message, !distrust);
  if (follows && distrust) distrust = judge(channel, message, utime_us);
  Count& count = channels_[name];
  if (distrust) {
    ++count.bad[to_string(*distrust)];
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
    const std::string line =
        printed("%-48s %10llu good", channel.c_str(), static_cast<unsigned long long>(count.good));
    text += line;
    for (const auto& [reason, number] : count.bad) {
      text += ", " + std::to_string(number) + " " + reason;
    }
    text += '\n';
  }
  return text;
}

}  // namespace ols::key
