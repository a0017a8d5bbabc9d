#include "cue/live_cues.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/config/area.h"
#include "conditions/refusal.h"
#include "wire/cue_values.h"

namespace ols::cues {
namespace {

constexpr std::size_t kLongestName = 60;
constexpr double kFuture_s = 1.0;  // clocks may differ by this much

// The text goes into messages, tables and terminals.
std::string plain(const std::string& text) {
  std::string result = text.substr(0, kLongestName);
  for (char& c : result) {
    if (c < ' ' || c > '~') c = '?';
  }
  return result;
}

// Like plain(), but different names stay different: the FNV-1a hash of the whole is appended.
std::string plain_name(const std::string& name) {
  std::string result = plain(name);
  if (result == name) return result;
  std::uint32_t hash = 2'166'136'261U;
  for (const unsigned char c : name) hash = (hash ^ c) * 16'777'619U;
  static constexpr char kDigits[] = "0123456789abcdef";
  result += '~';
  for (int shift = 28; shift >= 0; shift -= 4) result += kDigits[(hash >> shift) & 0xFU];
  return result;
}

// In floating point: the difference from an absurd stamp must not overflow.
double since_s(std::int64_t now_us, std::int64_t utime_us) {
  return 1e-6 * (static_cast<double>(now_us) - static_cast<double>(utime_us));
}

LiveCue cue_of(const Report& report, const InputRules& rules) {
  LiveCue cue;
  cue.id = rules.name + "." + plain_name(report.name);
  cue.label = plain(report.label);
  cue.utime_us = report.utime_us;
  cue.latitude_deg = report.latitude_deg;
  cue.longitude_deg = report.longitude_deg;
  cue.height_m = report.height_m;
  cue.horizontal_sd_m = report.horizontal_sd_m.value_or(rules.horizontal_sd_m);
  cue.vertical_sd_m = report.vertical_sd_m.value_or(
      report.is_pressure_height ? rules.pressure_height_sd_m : rules.vertical_sd_m);
  const bool has_velocity = report.velocity_enu_m_s.has_value();
  if (has_velocity) cue.velocity_enu_m_s = *report.velocity_enu_m_s;
  cue.velocity_sd_m_s =
      has_velocity ? report.velocity_sd_m_s.value_or(rules.velocity_sd_m_s) : rules.speed_sd_m_s;
  return cue;
}

std::optional<Refusal> fault_of(const LiveCue& cue) {
  switch (ols::fault_of({cue.latitude_deg, cue.longitude_deg, cue.height_m, cue.horizontal_sd_m,
                         cue.vertical_sd_m, cue.velocity_enu_m_s, cue.velocity_sd_m_s})) {
    case CueFault::kNotFinite:
      return Refusal::kNotFinite;
    case CueFault::kOutOfRange:
      return Refusal::kOutOfRange;
    case CueFault::kPole:
      return Refusal::kPole;
    case CueFault::kNone:
      break;
  }
  return std::nullopt;
}

// `cue` is made of the report.
std::optional<Refusal> refusal_of(const Report& report, const LiveCue& cue, const InputRules& rules,
                                  std::int64_t now_us) {
  if (report.name.size() > kLongestName) return Refusal::kMalformed;
  if (const auto fault = fault_of(cue)) return fault;
  const double age_s = since_s(now_us, report.utime_us);
  const bool is_over = report.stale_us != 0 && since_s(now_us, report.stale_us) > 0.0;
  if (age_s > rules.max_age_s || is_over) return Refusal::kStale;
  if (age_s < -kFuture_s) return Refusal::kFuture;
  if (!is_inside(rules.area_deg, report.latitude_deg, report.longitude_deg)) {
    return Refusal::kOutOfArea;
  }
  return std::nullopt;
}

}  // namespace

LiveCues::LiveCues(std::vector<InputRules> inputs, int most)
    : inputs_(std::move(inputs)),
      counts_(inputs_.size()),
      most_(std::max<std::size_t>(
          1, static_cast<std::size_t>(most) / std::max<std::size_t>(1, inputs_.size()))) {
  for (InputCounts& counts : counts_) {
    for (int i = 0; i < static_cast<int>(Refusal::kCount); ++i) {
      counts.refused[to_string(static_cast<Refusal>(i))] = 0;
    }
  }
}

void LiveCues::refuse(std::size_t input, const Refused& refused) {
  InputCounts& counts = counts_[input];
  ++counts.refused[to_string(refused.why)];
  counts.last_refusal = plain(refused.what) + ": " + refusal_words(to_string(refused.why), "cue_");
}

void LiveCues::take(std::size_t input, const Readings& readings, std::int64_t now_us) {
  for (const Reading& reading : readings) {
    if (const auto* refused = std::get_if<Refused>(&reading)) {
      refuse(input, *refused);
    } else {
      judge(input, std::get<Report>(reading), now_us);
    }
  }
}

void LiveCues::judge(std::size_t input, const Report& report, std::int64_t now_us) {
  const InputRules& rules = inputs_[input];
  LiveCue cue = cue_of(report, rules);
  if (const auto why = refusal_of(report, cue, rules, now_us)) {
    return refuse(input, {*why, report.name});
  }
  forget(now_us);
  const auto known = kept_.find(cue.id);
  if (known != kept_.end() && cue.utime_us < known->second.cue.utime_us) {
    return refuse(input, {Refusal::kStale, report.name});
  }
  if (known == kept_.end() && is_full(input)) {
    return refuse(input, {Refusal::kTooMany, report.name});
  }
  ++counts_[input].taken;
  std::int64_t until_us = cue.utime_us + std::llround(1e6 * rules.max_age_s);
  if (report.stale_us != 0) until_us = std::min(until_us, report.stale_us);
  Kept& kept = kept_[cue.id];
  kept = {std::move(cue), input, until_us};
}

bool LiveCues::is_full(std::size_t input) const {
  const auto taken =
      std::ranges::count_if(kept_, [&](const auto& one) { return one.second.input == input; });
  return static_cast<std::size_t>(taken) >= most_;
}

void LiveCues::forget(std::int64_t now_us) {
  std::erase_if(kept_, [&](const auto& one) {
    const Kept& kept = one.second;
    return now_us > kept.until_us || since_s(now_us, kept.cue.utime_us) < -kFuture_s;
  });
}

std::vector<LiveCue> LiveCues::live(std::int64_t now_us) {
  forget(now_us);
  std::vector<LiveCue> all;
  for (const auto& [id, kept] : kept_) all.push_back(kept.cue);
  return all;
}

}  // namespace ols::cues
