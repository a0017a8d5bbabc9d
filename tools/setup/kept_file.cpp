#include "tools/setup/kept_file.h"

#include "base/config/toml_merge.h"
#include "tools/setup/flat_toml.h"

namespace ols::setup {

Rewrite rewrite(const std::optional<std::string>& present, const std::optional<std::string>& last,
                const std::string& wanted) {
  if (!present) return {wanted, "written"};
  if (!last) return {std::nullopt, "kept: it was there before ols-setup"};
  const Values before = flat(*last);
  Values changes;
  for (const auto& [key, value] : flat(wanted)) {
    const std::string* old = find(before, key);
    if (old == nullptr || *old != value) changes.emplace_back(key, value);
  }
  if (changes.empty()) return {std::nullopt, "kept: the answers have not changed"};
  std::string note = "changed:";
  for (const auto& [key, value] : changes) note += " " + key;
  return {toml_merged(*present, as_toml(changes)), note};
}

Rewrite rewrite_whole(const std::optional<std::string>& present,
                      const std::optional<std::string>& last, const std::string& wanted) {
  if (!present) return {wanted, "written"};
  if (*present == wanted) return {std::nullopt, "kept: it is as it should be"};
  if (last && *present == *last) return {wanted, "written"};
  return {std::nullopt, "kept: a person has changed it"};
}

}  // namespace ols::setup
