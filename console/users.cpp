#include "console/users.h"

#include <sodium.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "conditions/sayings.h"

namespace ols::console {
namespace {

constexpr std::size_t kMostNameBytes = 40;
constexpr std::size_t kFewestPasswordBytes = 8, kMostPasswordBytes = 200;
constexpr std::size_t kMostUsers = 1000;

void start_sodium() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium cannot be initialised");
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

}  // namespace

std::string_view name(Role role) {
  return role == Role::kAdmin ? "admin" : role == Role::kOperator ? "operator" : "viewer";
}

std::optional<Role> role_named(std::string_view text) {
  for (const Role role : {Role::kViewer, Role::kOperator, Role::kAdmin}) {
    if (name(role) == text) return role;
  }
  return std::nullopt;
}

Outcome name_problem(std::string_view text) {
  const bool good = std::ranges::all_of(text, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
  });
  if (text.empty() || text.size() > kMostNameBytes || !good) {
    return outcome::user_name_wrong();
  }
  return {};
}

Outcome password_problem(std::string_view password) {
  if (password.size() >= kFewestPasswordBytes && password.size() <= kMostPasswordBytes) return {};
  return outcome::password_length();
}

Users parse_users(const std::string& text, const std::string& file) {
  Users users;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const auto wrong = [&](const std::string& what) {
      return std::invalid_argument(file + ":" + std::to_string(number) + ": " + what);
    };
    const auto words = words_of(line);
    if (words.empty() || words[0].starts_with('#')) continue;
    if (words.size() != 3) throw wrong("a line is NAME ROLE HASH");
    if (const auto problem = name_problem(words[0]); !problem.empty()) throw wrong(problem.text);
    const auto role = role_named(words[1]);
    if (!role) throw wrong("the role must be viewer, operator or admin");
    if (!words[2].starts_with("$argon2id$") || words[2].size() >= crypto_pwhash_STRBYTES) {
      throw wrong("the hash is not one that ols-console --add-user makes");
    }
    if (users.size() >= kMostUsers) throw wrong("more than 1000 users");
    if (!users.emplace(words[0], User{*role, words[2]}).second) {
      throw wrong("this user was named before");
    }
  }
  return users;
}

std::string users_text(const Users& users) {
  std::string text = "# Users of ols-console: name, role, hash. Made by ols-console --add-user.\n";
  for (const auto& [user, entry] : users) {
    text.append(user).append(" ").append(name(entry.role)).append(" ").append(entry.hash) += '\n';
  }
  return text;
}

Outcome users_problem(const Users& users) {
  const bool has_admin =
      std::ranges::any_of(users, [](const auto& user) { return user.second.role == Role::kAdmin; });
  if (!has_admin) return outcome::last_admin();
  return users.size() > kMostUsers ? outcome::too_many_users(kMostUsers) : Outcome{};
}

std::string hash_password(const std::string& password) {
  start_sodium();
  std::array<char, crypto_pwhash_STRBYTES> hash{};
  if (crypto_pwhash_str(hash.data(), password.c_str(), password.size(),
                        crypto_pwhash_OPSLIMIT_INTERACTIVE,
                        crypto_pwhash_MEMLIMIT_INTERACTIVE) != 0) {
    throw std::runtime_error("not enough memory to hash a password");
  }
  return hash.data();
}

bool verify_password(const std::string& hash, const std::string& password) {
  start_sodium();
  static const std::string kNobody = hash_password("nobody");
  const std::string& against = hash.empty() ? kNobody : hash;
  const bool same =
      crypto_pwhash_str_verify(against.c_str(), password.c_str(), password.size()) == 0;
  return same && !hash.empty();
}

}  // namespace ols::console
