#include "bridge/subject.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <utility>

#include "base/bus/channel_names.h"
#include "base/trust/channel_rules.h"

namespace ols::bridge {
namespace {

constexpr std::string_view kPrefix = "ols.v1.";
constexpr std::size_t kLongestName = 40;

constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kCommands{
    {{kSlewChannel, "slew"},
     {kOcclusionChannel, "occlusion"},
     {kPtuChannel, "ptu"},
     {kLensChannel, "lens"},
     {kDesignateChannel, "designate"},
     {kRecordChannel, "record"}}};

struct Report {
  Kind kind;
  std::string_view channel, word;
};
constexpr std::array<Report, 4> kReports{{{Kind::kBearing, kBearingChannel, "bearing"},
                                          {Kind::kStatus, kStatusChannel, "status"},
                                          {Kind::kReply, kReplyChannel, "reply"},
                                          {Kind::kSkyline, kSkylineChannel, "skyline"}}};

std::vector<std::string_view> parts_of(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t dot = text.find('.');
    parts.push_back(text.substr(0, dot));
    if (dot == std::string_view::npos) return parts;
    text.remove_prefix(dot + 1);
  }
}

bool is_command(std::string_view word) { return std::ranges::count(commands(), word) > 0; }

bool is_same(const std::string& wanted, const std::string& name) {
  return wanted == "*" || wanted == name;
}

}  // namespace

bool is_name(std::string_view text) {
  return !text.empty() && text.size() <= kLongestName &&
         std::ranges::all_of(
             text, [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; });
}

const std::vector<std::string>& reports() {
  static const std::vector<std::string> kWords = [] {
    std::vector<std::string> words;
    for (const Report& report : kReports) words.emplace_back(report.word);
    return words;
  }();
  return kWords;
}

std::string_view report_word(Kind kind) {
  const auto* report = std::ranges::find(kReports, kind, &Report::kind);
  return report == kReports.end() ? "" : report->word;
}

const std::vector<std::string>& commands() {
  static const std::vector<std::string> kWords = [] {
    std::vector<std::string> words;
    for (const auto& [channel, word] : kCommands) words.emplace_back(word);
    return words;
  }();
  return kWords;
}

std::optional<Subject> parse_subject(std::string_view text) {
  if (!text.starts_with(kPrefix)) return std::nullopt;
  const auto parts = parts_of(text.substr(kPrefix.size()));
  if (parts.size() == 2) {
    if (!is_name(parts[0]) || parts[1] != "target") return std::nullopt;
    return Subject{Kind::kTarget, std::string(parts[0])};
  }
  if (parts.size() < 4 || parts.size() > 5) return std::nullopt;
  if (!std::all_of(parts.begin(), parts.begin() + 3, is_name)) return std::nullopt;
  Subject subject{Kind::kBearing, std::string(parts[0]), std::string(parts[1]),
                  std::string(parts[2])};
  if (parts.size() == 5) {
    if (parts[3] != "cmd" || !is_command(parts[4])) return std::nullopt;
    subject.kind = Kind::kCommand;
    subject.command = parts[4];
    return subject;
  }
  const auto* report = std::ranges::find(kReports, parts[3], &Report::word);
  if (report == kReports.end()) return std::nullopt;
  subject.kind = report->kind;
  return subject;
}

std::string to_text(const Subject& subject) {
  const std::string region = std::string(kPrefix) + subject.region;
  if (subject.kind == Kind::kTarget) return region + ".target";
  std::string station = region + "." + subject.site + "." + subject.station;
  if (subject.kind == Kind::kCommand) return station + ".cmd." + subject.command;
  return station.append(".").append(report_word(subject.kind));
}

std::optional<Content> content_of(std::string_view channel) {
  const auto known = trust::rule_of(channel);
  if (!known) return std::nullopt;
  const std::string_view name = known->rule->name;
  if (name == kTargetChannel) return Content{Kind::kTarget, "", ""};
  if (!is_name(known->station)) return std::nullopt;
  const std::string station(known->station);
  const auto* report = std::ranges::find(kReports, name, &Report::channel);
  if (report != kReports.end()) return Content{report->kind, station, ""};
  for (const auto& [command, word] : kCommands) {
    if (name == command) return Content{Kind::kCommand, station, std::string(word)};
  }
  return std::nullopt;
}

std::string channel_of(const Subject& subject) {
  if (subject.kind == Kind::kTarget) return std::string(kTargetChannel);
  const auto* report = std::ranges::find(kReports, subject.kind, &Report::kind);
  if (report != kReports.end()) return station_channel(report->channel, subject.station);
  const auto* row = std::ranges::find(kCommands, std::string_view(subject.command),
                                      &decltype(kCommands)::value_type::second);
  return station_channel(row->first, subject.station);
}

bool Selection::has(const Subject& subject) const {
  return is_same(region, subject.region) && is_same(site, subject.site) &&
         is_same(station, subject.station);
}

Selection parse_selection(const std::string& text) {
  const auto parts = parts_of(text);
  const auto good = [](std::string_view part) { return part == "*" || is_name(part); };
  if (parts.size() != 3 || !std::ranges::all_of(parts, good)) {
    throw std::invalid_argument("\"" + text +
                                "\" is not REGION.SITE.STATION, each of letters, digits, - and _, "
                                "or * for all");
  }
  return {std::string(parts[0]), std::string(parts[1]), std::string(parts[2])};
}

}  // namespace ols::bridge
