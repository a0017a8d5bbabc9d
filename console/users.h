// The people who may log in. They are listed in a file, which `ols-console --add-user` makes, with
// a line "NAME ROLE HASH" for each. Pure. hash_password() and verify_password() take a tenth of a
// second and 64 MB of memory.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "conditions/refusal.h"

namespace ols::console {

// A kViewer may look, a kOperator may also give commands, and a kAdmin may also manage the users.
enum class Role { kViewer, kOperator, kAdmin };
std::string_view name(Role role);
std::optional<Role> role_named(std::string_view name);

struct User {
  Role role = Role::kViewer;
  std::string hash;  // libsodium's crypto_pwhash_str: Argon2id with its parameters and salt
  bool operator==(const User&) const = default;
};
using Users = std::map<std::string, User>;

// Throws std::invalid_argument: "FILE:LINE: what is wrong".
Users parse_users(const std::string& text, const std::string& file);
std::string users_text(const Users& users);
// What is wrong with a list of users, for example that it has no admin; empty: nothing.
Outcome users_problem(const Users& users);
// What is wrong with the name or the password of a new user; empty: nothing.
Outcome name_problem(std::string_view name);
Outcome password_problem(std::string_view password);

std::string hash_password(const std::string& password);
// Takes as long for an unknown user (empty hash) as for a known one, so that the time does not
// reveal which names exist.
bool verify_password(const std::string& hash, const std::string& password);

}  // namespace ols::console
