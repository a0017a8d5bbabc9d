// How ols-setup rewrites a file and keeps a person's changes. Pure.
#pragma once

#include <optional>
#include <string>

namespace ols::setup {

struct Rewrite {
  std::optional<std::string> text{};  // nullopt: the file stays as it is
  std::string note{};                 // for a person
};

// `present`: the file as it is; nullopt: there is none. `last`: what ols-setup would have written
// at its last run; nullopt: it never ran. `wanted`: what it would write now. Only the differences
// between the last two are changed, in place: comments and other values stay. Throws
// std::runtime_error if the file's form does not allow that.
Rewrite rewrite(const std::optional<std::string>& present, const std::optional<std::string>& last,
                const std::string& wanted);
// The same for a file that is not TOML: it is replaced only if nobody has changed it.
Rewrite rewrite_whole(const std::optional<std::string>& present,
                      const std::optional<std::string>& last, const std::string& wanted);

}  // namespace ols::setup
