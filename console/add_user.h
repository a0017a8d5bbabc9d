// Adds a user to the file of people who may log in, or changes a user's role and password.
#pragma once

#include <string>

#include "console/users.h"

namespace ols::console {

// The users of a file; empty if there is no such file. Throws std::invalid_argument with the
// position in the file, or std::system_error if it cannot be read.
Users read_users(const std::string& file);

// The file appears whole or not at all, readable by its owner alone. Throws std::system_error.
void write_users(const std::string& file, const Users& users);

// Asks for the password: on a terminal twice and without echo, otherwise in the first line of
// standard input. The file appears whole or not at all, readable by its owner alone. Throws
// std::invalid_argument for a refused name or password, or std::system_error.
void add_user(const std::string& file, const std::string& name, const std::string& role);

}  // namespace ols::console
