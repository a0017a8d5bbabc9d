#include "console/add_user.h"

#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "base/files/atomic_file.h"
#include "base/files/small_file.h"

namespace ols::console {
namespace {

constexpr std::size_t kMostFileBytes = 1 << 20;

// Restores the terminal however it is left.
class NoEcho {
 public:
  NoEcho() {
    if (tcgetattr(STDIN_FILENO, &before_) != 0) return;
    termios silent = before_;
    silent.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    is_set_ = tcsetattr(STDIN_FILENO, TCSAFLUSH, &silent) == 0;
  }
  ~NoEcho() {
    if (is_set_) tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
  }
  NoEcho(const NoEcho&) = delete;
  NoEcho& operator=(const NoEcho&) = delete;

 private:
  termios before_{};
  bool is_set_ = false;
};

std::string asked(const char* question) {
  std::fputs(question, stderr);
  std::string line;
  if (!std::getline(std::cin, line)) throw std::invalid_argument("no password was given");
  return line;
}

std::string ask_password() {
  if (isatty(STDIN_FILENO) == 0) return asked("");
  const NoEcho silence;
  const std::string first = asked("Password: ");
  const std::string second = asked("\nAgain: ");
  std::fputs("\n", stderr);
  if (first != second) throw std::invalid_argument("the two passwords differ");
  return first;
}

}  // namespace

Users read_users(const std::string& file) {
  if (!std::filesystem::exists(file)) return {};
  return parse_users(read_small_file(file, kMostFileBytes), file);
}

void write_users(const std::string& file, const Users& users) {
  const mode_t before = ::umask(0077);
  try {
    AtomicFile out(file);
    out.stream() << users_text(users);
    out.commit();
  } catch (...) {
    ::umask(before);
    throw;
  }
  ::umask(before);
}

void add_user(const std::string& file, const std::string& user, const std::string& role) {
  if (const auto problem = name_problem(user); !problem.empty()) {
    throw std::invalid_argument(problem);
  }
  const auto known = role_named(role);
  if (!known) throw std::invalid_argument("the role must be viewer, operator or admin");
  Users users = read_users(file);
  const std::string password = ask_password();
  if (const auto problem = password_problem(password); !problem.empty()) {
    throw std::invalid_argument(problem);
  }
  users[user] = {*known, hash_password(password)};
  write_users(file, users);
}

}  // namespace ols::console
