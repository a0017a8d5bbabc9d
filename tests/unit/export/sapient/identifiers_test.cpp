#include "export/sapient/identifiers.h"

#include <gtest/gtest.h>

#include <regex>

namespace ols::exports {
namespace {

TEST(Identifiers, AUuidIsOfVersion4AndOfItsName) {
  const std::regex form("[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}");
  for (const char* name : {"", "brno.fusion", "x"}) {
    EXPECT_TRUE(std::regex_match(uuid_of(name), form)) << uuid_of(name);
    EXPECT_TRUE(is_uuid(uuid_of(name)));
  }
  EXPECT_NE(uuid_of("a"), uuid_of("b"));
  // It must never change: receivers would take the site for another one.
  EXPECT_EQ(uuid_of("brno.fusion"), "1fa38d49-b6a4-4f84-a99f-1c71c5f25d8c");
}

TEST(Identifiers, OtherTextsAreNoUuid) {
  for (const char* text :
       {"", "brno", "6F1D0C5E-9342-4A8B-B725-0E61D48F3A19", "6f1d0c5e-9342-1a8b-b725-0e61d48f3a19",
        "6f1d0c5e-9342-4a8b-c725-0e61d48f3a19", "6f1d0c5e-9342-4a8b-b725-0e61d48f3a1",
        "6f1d0c5e+9342-4a8b-b725-0e61d48f3a19"}) {
    EXPECT_FALSE(is_uuid(text)) << text;
  }
}

TEST(Identifiers, AUlidHasItsTimeAndItsName) {
  const std::regex form("[0-7][0-9A-HJKMNP-TV-Z]{25}");
  EXPECT_TRUE(std::regex_match(ulid_of(0, "a"), form));
  EXPECT_TRUE(std::regex_match(ulid_of(281'474'976'710'655, "a"), form));
  // The example of the ULID's own specification.
  EXPECT_EQ(ulid_of(1'469'918'176'385, "a").substr(0, 10), "01ARYZ6S41");
  EXPECT_EQ(ulid_of(1, "a").substr(10), ulid_of(2, "a").substr(10));
  EXPECT_NE(ulid_of(1, "a"), ulid_of(1, "b"));
  EXPECT_EQ(ulid_of(0, "brno.target.000000000000004d.7"), "0000000000B9CAX047A1PHF75P");
}

}  // namespace
}  // namespace ols::exports
