// What a file becomes that ols-setup writes again: what a person has changed stays. Pure.
#pragma once

#include <optional>
#include <string>

namespace ols::setup {

struct Rewrite {
  std::optional<std::string> text{};  // nothing: it stays as it is
  std::string note{};                 // for a person
};

// `present`: the file as it is; nothing if there is none. `last`: what ols-setup would have written
// when it ran before; nothing if it never did. `wanted`: what it would write now. Only what differs
// between the last two is changed, in place: comments and other values stay. Throws
// std::runtime_error if the file has a form in which that cannot be done.
Rewrite rewrite(const std::optional<std::string>& present, const std::optional<std::string>& last,
                const std::string& wanted);
// The same for a file that is no TOML: it is replaced only if nobody has changed it.
Rewrite rewrite_whole(const std::optional<std::string>& present,
                      const std::optional<std::string>& last, const std::string& wanted);

}  // namespace ols::setup
