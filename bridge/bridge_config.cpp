#include "bridge/bridge_config.h"

#include <algorithm>
#include <span>
#include <stdexcept>

#include "base/config/config_common.h"

namespace ols::bridge {
namespace {

void check_name(const std::string& name) {
  if (!is_name(name)) throw std::invalid_argument("must be 1 to 40 letters, digits, - or _");
}

// In the name of a stream, _ separates region and site: a and b_c must not be a_b and c.
void check_place(const std::string& name) {
  if (!is_name(name) || name.find('_') != std::string::npos) {
    throw std::invalid_argument("must be 1 to 40 letters, digits or -");
  }
}

bool is_tls(const std::string& url) { return url.starts_with("tls://"); }

void check_server(const std::string& url) {
  if (!url.starts_with("nats://") && !is_tls(url)) {
    throw std::invalid_argument("\"" + url + "\" is neither nats://HOST:PORT nor tls://HOST:PORT");
  }
}

template <class Check>
void check_all(ConfigTable& table, const char* key, const std::vector<std::string>& words,
               Check check) {
  try {
    for (const std::string& word : words) check(word);
  } catch (const std::invalid_argument& bad) {
    throw table.error(key, bad.what());
  }
}

// With nats://, everything would be plain text, whatever else is configured.
void check_tls(const ConfigTable& table, const NatsConfig& n) {
  const auto tls = std::ranges::count_if(n.servers, is_tls);
  if (tls != 0 && tls != std::ssize(n.servers)) {
    throw table.error("servers", "either all are tls:// or none");
  }
  if (tls != 0) return;
  if (!n.authority.empty()) throw table.error("authority", "only with servers of tls://");
  if (!n.certificate.empty()) throw table.error("certificate", "only with servers of tls://");
}

config::Section nats_section(NatsConfig& n) {
  return {
      "nats",
      "The server of NATS on this host, a leaf of the network of sites: docs/bridge.md.",
      {config::texts("servers", n.servers,
                     "nats://HOST:PORT, or tls://HOST:PORT, any of them; all of one kind."),
       config::text("credentials", n.credentials,
                    "File of the user's credentials; empty: nkey and seed, if any."),
       config::text("nkey", n.nkey, "The user's public key; empty: none."),
       config::text("seed", n.seed,
                    "File of that key's seed; empty: ols-nats of the service's credentials."),
       config::text("authority", n.authority,
                    "File of the authorities that may sign a server's certificate."),
       config::text("certificate", n.certificate, "File of this user's certificate; empty: none."),
       config::text("key", n.key, "File of its private key.")},
      {},
      [&n](ConfigTable& table) {
        if (n.servers.empty()) throw table.error("servers", "must name one");
        check_all(table, "servers", n.servers, check_server);
        check_tls(table, n);
        if (n.certificate.empty() != n.key.empty()) {
          throw table.error("key", "a certificate and its key belong together");
        }
        if (!n.credentials.empty() && !n.nkey.empty()) {
          throw table.error("nkey", "either credentials or a key");
        }
      }};
}

config::Section archive_section(ArchiveConfig& a) {
  return {"archive",
          "A stream of the server keeps bearings, statuses and targets, never a command.",
          {config::flag("keep", a.is_on, "Whether the server keeps such a stream."),
           config::number("hours", a.keep_h, {0.1, 24.0 * 366}, "h",
                          "How long the stream keeps a message."),
           config::number("most_gb", a.most_bytes, {0.1, 1e5}, config::kGigabytes,
                          "How large the stream may become; then the oldest messages go."),
           config::text("domain", a.domain,
                        "JetStream domain of the server; empty: that of the connected server."),
           config::texts("sources", a.sources,
                         "For a region: JetStream domains of the sites whose streams it copies.")},
          {},
          [&a](ConfigTable& table) { check_all(table, "sources", a.sources, check_place); }};
}

config::Section ownership_section(OwnershipConfig& o) {
  return {
      "ownership",
      "For regions whose fusions see the same targets: each target has one owner.",
      {config::flag(
           "share", o.is_on,
           "Whether other fusions share the targets; otherwise this fusion owns all it has."),
       config::text("name", o.name, "Name of this fusion among them; empty: the region's."),
       config::text("domain", o.domain, "JetStream domain of the server that keeps the owners."),
       config::numbers("cell_deg", std::span<double>(o.cell_deg), {-180.0, 180.0}, "deg",
                       "South, west, north, east: the area whose targets belong to this fusion."),
       config::number(
           "margin_m", o.margin_m, {0.0, 1e5}, "m",
           "A target changes its owner when it is inside another cell by this and 3 sigma.")},
      {},
      [&o](ConfigTable& table) {
        config::check_area(o.cell_deg, "cell_deg", table);
        if (!o.name.empty()) {
          check_all(table, "name", {o.name}, check_name);
        }
      }};
}

bool is_own_station(const BridgeConfig& config, const Selection& one) {
  return std::ranges::count(config.stations, one.station) > 0;
}

void check(const BridgeConfig& c, ConfigTable& root) {
  check_all(root, "stations", c.stations, check_name);
  check_all(root, "takes", c.takes, [&c](const std::string& text) {
    const Selection one = parse_selection(text);
    if (c.role == Role::kSite && is_own_station(c, one)) {
      throw std::invalid_argument("\"" + text + "\": a station of that name goes out");
    }
  });
  check_all(root, "commands", c.commands, [](const std::string& word) {
    if (std::ranges::count(commands(), word) == 0) {
      throw std::invalid_argument("\"" + word + "\" is not a command that crosses");
    }
  });
  if (c.role == Role::kSite && c.ownership.is_on && !c.targets) {
    throw root.error("targets", "without targets there is nothing to own");
  }
}

}  // namespace

bool is_over_tls(const NatsConfig& config) { return std::ranges::all_of(config.servers, is_tls); }

config::Section bridge_section(BridgeConfig& c) {
  return {
      "",
      "",
      {config::bus_url(c.lcm_url), config::status_file(c.status_file),
       config::word("role", c.role, {{"site", Role::kSite}, {"region", Role::kRegion}},
                    "site: stations are on this bus; region: a fusion of several sites' stations."),
       config::text("region", c.region, "Its name in the subjects of NATS.", check_place),
       config::text("site", c.site, "Its name in the subjects of NATS.", check_place),
       config::texts("stations", c.stations,
                     "Stations of this site whose messages pass; empty: all that are heard."),
       config::texts("takes", c.takes,
                     "Other sites' stations to receive: REGION.SITE.STATION; * stands for any."),
       config::texts("commands", c.commands,
                     "Commands that pass from a region to a site: slew, occlusion, ptu, lens, "
                     "designate, record."),
       config::flag("targets", c.targets, "Whether the targets of the fusion on this bus go out."),
       config::number("command_age_s", c.command_age_s, {0.05, 10.0}, "s",
                      "An older command is refused."),
       config::number("live_age_s", c.live_age_s, {0.5, 60.0}, "s",
                      "An older bearing, status or target is not taken in.")},
      {nats_section(c.nats), archive_section(c.archive), ownership_section(c.ownership)},
      [&c](ConfigTable& root) { check(c, root); }};
}

PassageConfig passage_of(const BridgeConfig& config) {
  PassageConfig passage;
  passage.role = config.role;
  passage.region = config.region;
  passage.site = config.site;
  passage.stations = config.stations;
  for (const std::string& text : config.takes) passage.takes.push_back(parse_selection(text));
  if (config.role == Role::kRegion && config.takes.empty()) {
    passage.takes.push_back({config.region, "*", "*"});
  }
  passage.commands = config.commands;
  passage.targets = config.targets;
  passage.command_age_s = config.command_age_s;
  passage.live_age_s = config.live_age_s;
  return passage;
}

BridgeConfig load_bridge_config(const std::string& path) {
  return config::load(path, bridge_section);
}

BridgeConfig parse_bridge_config(const std::string& text, const std::string& name) {
  return config::parse(text, name, bridge_section);
}

}  // namespace ols::bridge
