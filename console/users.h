// The people who may log in: a file with one line "NAME ROLE HASH" each, made by `ols-console
// --add-user`. Pure, except for the hash, which takes a tenth of a second and 64 MB.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "conditions/refusal.h"

namespace ols::console {

// Each role may do all that the previous role may. In order: look; command; manage the users.
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
// The error in a list of users, such as a missing admin; empty: the list is valid.
Outcome users_problem(const Users& users);
// The error in a name or a password for a new user; empty: it is valid.
Outcome name_problem(std::string_view name);
Outcome password_problem(std::string_view password);

std::string hash_password(const std::string& password);
// Takes as long for an unknown user (empty hash) as for a known one, so that names cannot be
// guessed.
bool verify_password(const std::string& hash, const std::string& password);

}  // namespace ols::console
