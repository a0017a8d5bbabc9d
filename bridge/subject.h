// The subjects of messages between sites, and the bus channel of each. Pure.
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

// Whether the text may name a region, a site or a station: 1 to 40 letters, digits, - or _. A
// station named "*" or "a.b" would give its subject another meaning.
bool is_name(std::string_view text);
// What a station reports, as a subject names it: "bearing", "status", ...
const std::vector<std::string>& reports();
// The word of such a kind; empty for commands and targets.
std::string_view report_word(Kind kind);
// The commands that a subject may carry.
const std::vector<std::string>& commands();

// nullopt for any other subject, and for one with wildcards.
std::optional<Subject> parse_subject(std::string_view text);
std::string to_text(const Subject& subject);

// The kind of message on a station's channel; nullopt for a channel that never crosses.
struct Content {
  Kind kind = Kind::kTarget;
  std::string station, command;
};
std::optional<Content> content_of(std::string_view channel);
// The channel on the bus. A station's message keeps its channel, because the channel is signed.
std::string channel_of(const Subject& subject);

// Stations by "REGION.SITE.STATION", each part a name or *.
struct Selection {
  std::string region, site, station;

  bool has(const Subject& subject) const;
};
// Throws std::invalid_argument.
Selection parse_selection(const std::string& text);

}  // namespace ols::bridge
