// A site's settings as texts: refused with an error that names the file, or what was signed. They
// are read as told, and as a body that the fuzzer's root signs: what is signed may be nonsense too.
#include "base/trust/site_settings.h"

#include <string>

#include "base/config/config_section.h"
#include "base/config/toml_config.h"
#include "base/trust/signed_text.h"
#include "edge/config/config.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

namespace trust = ols::trust;

void read(const std::string& text, const trust::SigningKey& root) {
  try {
    const trust::SiteSettings site = trust::read_settings(text, "site.toml", root.public_key());
    ols::fuzz::require(site.number > 0 && text.starts_with(site.body), "it is what was signed");
    ols::ConfigFile file(site.body, "site.toml");
    ols::station::StationSettings station;
    ols::config::read(ols::station::site_section(station), file.root().table("station"));
    ols::fuzz::require(station.station.max_age_s > 0.0 && station.station.max_age_s <= 10.0,
                       "a value is within its range");
  } catch (const ols::ConfigError& error) {
    ols::fuzz::require(std::string(error.what()).starts_with("site.toml"), "it names the file");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const trust::SigningKey kRoot(trust::Seed{1});
  const std::string text(ols::fuzz::text(data, size));
  read(text, kRoot);
  std::string body =
      "site = \"s\"\nnumber = 1\nroot = \"" + trust::to_hex(kRoot.public_key()) + "\"\n" + text;
  if (body.back() != '\n') body += '\n';
  read(trust::sign_text(body, "OLS-site-v1", kRoot), kRoot);
  return 0;
}
