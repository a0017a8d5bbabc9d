// Reads and writes the file of the people who may log in. Adds a user to it, or changes a user's
// role and password.
#pragma once

#include <string>

#include "console/users.h"

namespace ols::console {

// The users in the file; empty if there is no such file. Throws std::invalid_argument with the
// position in the file if a line is wrong, or std::system_error if the file cannot be read.
Users read_users(const std::string& file);

// Writes the file, which appears whole or not at all, and is readable only by its owner. Throws
// std::system_error.
void write_users(const std::string& file, const Users& users);

// Asks for the password: on a terminal twice and without echo; otherwise reads it from the first
// line of standard input. Then writes the file as write_users() does. Throws std::invalid_argument
// for a refused name or password, or std::system_error.
void add_user(const std::string& file, const std::string& name, const std::string& role);

}  // namespace ols::console
