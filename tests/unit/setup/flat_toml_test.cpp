#include "tools/setup/flat_toml.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "base/config/toml_text.h"

namespace ols::setup {
namespace {

TEST(FlatToml, EachValueHasItsFullKeyAndIsWrittenAsItWasRead) {
  const Values values = flat("a = \"x \\\"y\\\"\"\nb = [1, 2]\n[t]\nc = 0.5\n[t.u]\nd = true\n");
  EXPECT_EQ(*find(values, "t.c"), "0.5");
  EXPECT_EQ(*find(values, "t.u.d"), "true");
  EXPECT_EQ(find(values, "t"), nullptr);
  EXPECT_EQ(flat(as_toml(values)), values);
  EXPECT_EQ(of_table(values, "t"), (Values{{"c", "0.5"}, {"u.d", "true"}}));
}

TEST(FlatToml, ATextIsWrittenInOneWay) {
  for (const std::string text : {"/dev/ols/ptu", "a \"b\" \\ c", "a\n\x1b", "Gr\u00fcn", ""}) {
    const Values values = flat("k = " + toml_text(text) + "\n");
    EXPECT_EQ(*find(values, "k"), toml_text(text));
    EXPECT_EQ(text_in(*find(values, "k")), text);
  }
  EXPECT_EQ(*find(flat("k = 'a\\b'"), "k"), toml_text("a\\b"));
}

TEST(FlatToml, ANumberIsNoText) {
  EXPECT_EQ(text_in("1"), std::nullopt);
  EXPECT_EQ(text_in(""), std::nullopt);
}

TEST(FlatToml, NonsenseIsAnError) { EXPECT_THROW(flat("a = = 1"), std::runtime_error); }

}  // namespace
}  // namespace ols::setup
