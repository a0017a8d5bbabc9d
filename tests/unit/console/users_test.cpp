#include "console/users.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/error_text.h"

namespace ols::console {
namespace {

std::string error_of(const std::string& text) {
  return error_text<std::invalid_argument>([&] { parse_users(text, "users"); }, "taken");
}

TEST(Users, AFileIsReadAsItWasWritten) {
  const Users users{{"ana", {Role::kAdmin, "$argon2id$x"}},
                    {"ben", {Role::kViewer, "$argon2id$y"}}};
  const Users read = parse_users(users_text(users), "users");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read.at("ana").role, Role::kAdmin);
  EXPECT_EQ(read.at("ben").hash, "$argon2id$y");
}

TEST(Users, WhatIsWrongIsSaidWithItsLine) {
  EXPECT_EQ(error_of("# x\nana admin\n"), "users:2: a line is NAME ROLE HASH");
  EXPECT_EQ(error_of("ana king $argon2id$x\n"),
            "users:1: the role must be viewer, operator or admin");
  EXPECT_EQ(error_of("ana admin secret\n"),
            "users:1: the hash is not one that ols-console --add-user makes");
  EXPECT_EQ(error_of("ana admin $argon2id$x\nana viewer $argon2id$x\n"),
            "users:2: this user was named before");
  EXPECT_EQ(error_of("a/b admin $argon2id$x\n"),
            "users:1: a user's name is 1 to 40 letters, digits, -, _ or .");
}

TEST(Users, APasswordIsVerifiedByItsHash) {
  const std::string hash = hash_password("correct horse");
  EXPECT_TRUE(verify_password(hash, "correct horse"));
  EXPECT_FALSE(verify_password(hash, "correct horsf"));
  EXPECT_FALSE(verify_password("", "nobody")) << "an unknown user has no password at all";
}

TEST(Users, ShortPasswordsAreRefused) {
  EXPECT_NE(password_problem("1234567"), "");
  EXPECT_EQ(password_problem("12345678"), "");
}

}  // namespace
}  // namespace ols::console
