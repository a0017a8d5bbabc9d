#include "base/trust/site_settings.h"

#include <string_view>

#include "base/config/toml_config.h"
#include "base/trust/signed_text.h"
#include "base/trust/trust_words.h"

namespace ols::trust {
namespace {

constexpr std::string_view kKind = "OLS-site-v1";
constexpr std::int64_t kGreatestNumber = 1'000'000'000;

SiteSettings read_values(ConfigTable& root, const std::string& body) {
  SiteSettings settings;
  settings.geoid = root.text("geoid", "");
  if (root.has("geoid") && settings.geoid.empty()) throw root.error("geoid", "must not be empty");
  static_cast<void>(root.table("station"));
  settings.body = body;
  return settings;
}

}  // namespace

SiteSettings read_wanted_settings(const std::string& wanted, const std::string& name) {
  ConfigFile file(wanted, name);
  file.root().refuse_unknown({"geoid", "station"});
  return read_values(file.root(), wanted);
}

std::string sign_settings(const SiteSettings& head, const std::string& wanted,
                          const std::string& name, const SigningKey& root) {
  static_cast<void>(read_wanted_settings(wanted, name));
  require_member_name(head.site);
  std::string body = "site = \"" + head.site + "\"\nnumber = " + std::to_string(head.number) +
                     "\nroot = \"" + to_hex(root.public_key()) + "\"\n" + wanted;
  if (body.back() != '\n') body += '\n';
  std::string text = sign_text(body, kKind, root);
  if (text.size() > kLargestSettings) throw ConfigError(name + ": is too long for the bus");
  static_cast<void>(read_settings(text, name, root.public_key()));
  return text;
}

SiteSettings read_settings(const std::string& text, const std::string& name,
                           const PublicKey& root) {
  const SignedText parts = split_signed(text, name);
  require_signed(parts, kKind, root, name);
  ConfigFile file(parts.body, name);
  ConfigTable& table = file.root();
  table.refuse_unknown({"site", "number", "root", "geoid", "station"});
  SiteSettings settings = read_values(table, parts.body);
  settings.site = read_name(table, "site");
  settings.number = table.integer("number", 0, 1, kGreatestNumber);
  if (settings.number == 0) throw table.error("number", "is missing");
  settings.root = read_hex(table, "root");
  if (settings.root != root) throw table.error("root", "is not this site's");
  return settings;
}

}  // namespace ols::trust
