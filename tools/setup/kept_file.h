// Rewrites a file but keeps a person's changes in it. Pure.
#pragma once

#include <optional>
#include <string>

namespace ols::setup {

struct Rewrite {
  std::optional<std::string> text{};  // nullopt: the file stays as it is
  std::string note{};                 // for a person
};

// `present`: the existing text; nullopt: there is no file. `last`: the text that ols-setup wanted
// at its last run; nullopt: it never ran. `wanted`: the text that it wants now. In `present`,
// changes only what differs between `last` and `wanted`: comments and other values stay. Throws
// std::runtime_error if the form of the file does not allow that.
Rewrite rewrite(const std::optional<std::string>& present, const std::optional<std::string>& last,
                const std::string& wanted);
// The same for a file that is not TOML: replaces the whole file, but only if nobody has changed it.
Rewrite rewrite_whole(const std::optional<std::string>& present,
                      const std::optional<std::string>& last, const std::string& wanted);

}  // namespace ols::setup
