#include "base/trust/site_keeper.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "base/config/toml_config.h"
#include "base/files/atomic_file.h"
#include "base/files/small_file.h"
#include "conditions/alarms.h"

namespace ols::trust {

SiteKeeper::SiteKeeper(const PublicKey& root, SiteFiles files, SettingsCheck check)
    : root_(root), files_(std::move(files)), check_(std::move(check)) {
  try {
    if (!files_.kept.empty()) offer(read_small_file(files_.kept, kLargestSettings), files_.kept);
  } catch (const std::system_error&) {
    // No settings were heard yet.
  } catch (const ConfigError& problem) {
    heard_trouble_ = problem.what();
  }
  written_ = settings_.number;
  read_given();
}

SiteSettings SiteKeeper::settings() const {
  const std::lock_guard lock(mutex_);
  return settings_;
}

std::int64_t SiteKeeper::number() const {
  const std::lock_guard lock(mutex_);
  return settings_.number;
}

// Throws ConfigError with the reason why the settings in force stay.
void SiteKeeper::offer(const std::string& text, const std::string& name) {
  {
    const std::lock_guard lock(mutex_);
    if (text == text_) return;
  }
  const SiteSettings offered = read_settings(text, name, root_);
  {
    const std::lock_guard lock(mutex_);
    if (offered.number < highest_ || offered.number == settings_.number) {
      throw ConfigError(name + ": number " + std::to_string(offered.number) + " does not replace " +
                        std::to_string(highest_) + ", which the root has signed since");
    }
    highest_ = offered.number;
  }
  if (check_) check_(offered, name);
  const std::lock_guard lock(mutex_);
  if (offered.number < highest_) return;  // newer ones came meanwhile
  settings_ = offered;
  text_ = text;
}

// The settings in force are repeated every two seconds. A refusal of others must outlast a few
// repetitions to be seen.
void SiteKeeper::hear(const std::string& text) {
  constexpr int kCalm = 5;
  std::string trouble;
  try {
    offer(text, "OLS_SITE");
  } catch (const ConfigError& problem) {
    trouble = problem.what();
  }
  const std::lock_guard lock(mutex_);
  calm_ = trouble.empty() ? std::min(calm_ + 1, kCalm) : 0;
  if (!trouble.empty()) heard_trouble_ = trouble;
  if (calm_ == kCalm) heard_trouble_.clear();
}

void SiteKeeper::read_given() {
  std::string trouble;
  try {
    const std::string text = read_small_file(files_.given, kLargestSettings);
    if (text == read_) return;
    read_ = text;
    offer(text, files_.given);
  } catch (const std::system_error& problem) {
    // If the file never existed, the settings are received from the bus instead.
    const bool never_was = problem.code() == std::errc::no_such_file_or_directory && read_.empty();
    if (!never_was) trouble = problem.what();
  } catch (const ConfigError& problem) {
    trouble = problem.what();
  }
  const std::lock_guard lock(mutex_);
  file_trouble_ = trouble;
}

void SiteKeeper::look() {
  read_given();
  std::string text;
  std::int64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    text = text_;
    number = settings_.number;
  }
  if (files_.kept.empty() || number == written_) return;
  try {
    AtomicFile file(files_.kept);
    file.stream() << text;
    file.commit();
    written_ = number;
  } catch (const std::exception& problem) {
    const std::lock_guard lock(mutex_);
    file_trouble_ = problem.what();
  }
}

std::optional<std::string> SiteKeeper::to_tell(double now_s) {
  const std::lock_guard lock(mutex_);
  if (now_s < tell_s_ || text_.empty()) return std::nullopt;
  tell_s_ = now_s + kTell_s;
  return text_;
}

Alarm SiteKeeper::trouble() const {
  const std::lock_guard lock(mutex_);
  const std::string& why = file_trouble_.empty() ? heard_trouble_ : file_trouble_;
  return why.empty() ? Alarm() : alarm::site_settings_refused(why);
}

}  // namespace ols::trust
