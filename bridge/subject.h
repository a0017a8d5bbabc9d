// The NATS subjects of messages between sites, and the bus channel of each. Pure.
//
//   ols.v1.<region>.<site>.<station>.bearing | status | reply | skyline | cmd.<command>
//   ols.v1.<region>.target
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ols::bridge {

enum class Kind { kBearing, kStatus, kReply, kSkyline, kCommand, kTarget };

struct Subject {
  Kind kind = Kind::kTarget;
  std::string region;
  std::string site{}, station{};  // empty for a target
  std::string command{};          // only for kCommand, for example "slew"

  friend bool operator==(const Subject&, const Subject&) = default;
};

// Whether the text may name a region, a site or a station: 1 to 40 letters, digits, - or _. NATS
// would read a station named "*" or "a.b" in a subject as something else.
bool is_name(std::string_view text);
// The words for a station's reports in a subject: "bearing", "status", ...
const std::vector<std::string>& reports();
// The word for this kind of report; empty for commands and targets.
std::string_view report_word(Kind kind);
// The commands that a subject may carry.
const std::vector<std::string>& commands();

// nullopt for any other subject, and for a subject with wildcards.
std::optional<Subject> parse_subject(std::string_view text);
std::string to_text(const Subject& subject);

// What a channel carries; nullopt for a channel whose messages never pass a bridge.
struct Content {
  Kind kind = Kind::kTarget;
  std::string station, command;
};
std::optional<Content> content_of(std::string_view channel);
// The bus channel for messages of this subject. It is always the channel on which they were sent,
// because their signatures cover the channel.
std::string channel_of(const Subject& subject);

// A selection of stations: "REGION.SITE.STATION", each part a name or *.
struct Selection {
  std::string region, site, station;

  bool has(const Subject& subject) const;
};
// Throws std::invalid_argument.
Selection parse_selection(const std::string& text);

}  // namespace ols::bridge
