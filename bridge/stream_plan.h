// Plans which messages of a site or a region a server stores. Commands are never stored, because a
// stored command is a stale command. Pure.
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
  std::vector<std::string> subjects;  // what the server stores of the messages that it receives;
                                      // empty: it only copies streams
  std::vector<StreamSource> sources;
  std::int64_t keep_ns = 0, most_bytes = 0;
};

// nullopt if no stream is configured.
std::optional<StreamPlan> plan_stream(const BridgeConfig& config);

// Whether an existing stream with the planned name belongs to this bridge, perhaps from an earlier
// configuration. It does if all its subjects and sources are of this region or site.
bool is_same_stream(const BridgeConfig& config, const std::vector<std::string>& subjects,
                    const std::vector<std::string>& sources);

// Whether a pattern (a subject with NATS wildcards) covers the subject.
bool covers(const std::string& pattern, const std::string& subject);

}  // namespace ols::bridge
