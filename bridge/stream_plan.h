// Plans which messages of a site or a region a server stores: bearings, statuses and targets, but
// never commands, because a queued command is a stale command. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bridge/bridge_config.h"

namespace ols::bridge {

struct StreamSource {
  std::string stream, domain;
};

struct StreamPlan {
  std::string name;
  std::vector<std::string> subjects;  // that this server itself receives; empty: it copies streams
  std::vector<StreamSource> sources;
  std::int64_t keep_ns = 0, most_bytes = 0;
};

// nullopt if no stream is configured.
std::optional<StreamPlan> plan_stream(const BridgeConfig& config);

// Whether an existing stream of the planned name belongs to this bridge, by its subjects and
// sources: all that it stores is from this region or site. It may be of an earlier configuration.
bool is_same_stream(const BridgeConfig& config, const std::vector<std::string>& subjects,
                    const std::vector<std::string>& sources);

// Whether a subject with wildcards covers this one, by NATS's rules.
bool covers(const std::string& pattern, const std::string& subject);

}  // namespace ols::bridge
