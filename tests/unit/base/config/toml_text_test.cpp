#include "base/config/toml_text.h"

#include <gtest/gtest.h>

#include "base/config/toml_config.h"

namespace ols {
namespace {

TEST(TomlText, IsReadAsItWas) {
  const std::string texts[] = {"",
                               "/dev/ols/ptu",
                               "a \"b\" \\ 'c'",
                               "1\n2\r\n\t3\b\f",
                               std::string("\x01\x1b\x7f\0", 4),
                               "Gr\u00fcn \u20ac \U0001f600"};
  for (const std::string& text : texts) {
    ConfigFile file("k = " + toml_text(text) + "\n", "f");
    EXPECT_EQ(file.root().text("k", "nothing"), text);
  }
}

TEST(TomlText, IsOneLineOfAscii) {
  EXPECT_EQ(toml_text("/dev/ols/ptu"), "\"/dev/ols/ptu\"");
  EXPECT_EQ(toml_text("a \"b\" \\ 'c'"), R"("a \"b\" \\ 'c'")");
  EXPECT_EQ(toml_text("1\n2\r\n\t3\x1b[0m\x7f"), R"("1\n2\r\n\t3\u001B[0m\u007F")");
  EXPECT_EQ(toml_text("Gr\u00fcn"), R"("Gr\u00FCn")");
}

// A terminal that is not set to UTF-8 sends such bytes: still a file that can be read.
TEST(TomlText, TakesWhatIsNoUtf8) {
  ConfigFile file("k = " + toml_text("Gr\xfcn") + "\n", "f");
  EXPECT_EQ(file.root().text("k", ""), "Gr\u00fcn");
}

}  // namespace
}  // namespace ols
