// The settings that are the same on all hosts of a site. `ols-key settings` makes them at the
// centre and signs them with the site's root key. Each change gives them a higher number; settings
// with a lower number never replace settings with a higher number.
//
//   site = "airfield"
//   number = 3
//   root = "…64 hexadecimal digits…"
//   geoid = "egm96_15.gtx"          # for ols-export
//   [station]                       # some keys of a station's file: edge/config/site_section.h
//   logic.slew_lease_max_s = 1.5
//   # signature …128 hexadecimal digits…
//
// Members are not settings: they are in the trust list. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "base/trust/crypto.h"

namespace ols::trust {

// The largest text that fits into a datagram of the bus [byte].
inline constexpr std::size_t kLargestSettings = 60'000;

struct SiteSettings {
  std::string site;
  std::int64_t number = 0;  // 0: there are no settings
  PublicKey root{};
  std::string geoid;  // empty: not stated
  std::string body;   // all lines but the signature; the station reads its table [station]
};

// Checks settings whose signature was verified: throws ConfigError for a value that cannot be used.
// `name`: the file's name in errors.
using SettingsCheck = std::function<void(const SiteSettings&, const std::string& name)>;

// Makes the signed text. `wanted`: a person's text, without site, number and root. Throws
// ConfigError for keys that are not settings.
std::string sign_settings(const SiteSettings& head, const std::string& wanted,
                          const std::string& name, const SigningKey& root);
// Throws ConfigError if this root has not signed the text as settings.
SiteSettings read_settings(const std::string& text, const std::string& name, const PublicKey& root);
// Reads a person's text, which may have geoid and [station] only. Throws ConfigError.
SiteSettings read_wanted_settings(const std::string& wanted, const std::string& name);

}  // namespace ols::trust
