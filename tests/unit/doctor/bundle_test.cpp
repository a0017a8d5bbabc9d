#include "tools/doctor/bundle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "base/process/command_output.h"
#include "tests/unit/folder_test.h"

namespace ols::doctor {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class Bundle : public FolderTest<std::filesystem::path> {
 protected:
  Bundle() { fs::create_directories(folder_ / "etc"); }

  void plant(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / "etc" / name) << text;
  }
  // All that is in the archive, one file after the other.
  static std::string unpacked(const std::string& file) {
    return command_output({"tar", "--extract", "--gzip", "--to-stdout", "--file", file}, 20.0)
        .value_or("");
  }
  BundleContents contents() const { return {"1.2.3", findings_, (folder_ / "etc").string()}; }

  Findings findings_;
};

TEST_F(Bundle, HoldsTheConfigurationWithoutItsSecrets) {
  plant("alfa.toml", "[site]\nname = \"alfa\"\nsite_key = \"Zebra-77\"\n");
  plant("bravo.toml", "[x]\ntokens = [\n  \"Zebra-77\",\n]\nname = \"bravo\"\n");
  plant("bus.env", "OLS_INTERFACE=eth0\nAPI_TOKEN=Zebra-77\n");
  plant("key.pem", "Zebra-77");
  const std::string file = (folder_ / "b.tar.gz").string();
  write_bundle(file, contents());
  const std::string all = unpacked(file);
  EXPECT_THAT(all, HasSubstr("name = \"alfa\""));
  EXPECT_THAT(all, HasSubstr("name = \"bravo\""));
  EXPECT_THAT(all, HasSubstr("OLS_INTERFACE=eth0"));
  EXPECT_THAT(all, HasSubstr("1.2.3"));
  EXPECT_THAT(all, Not(HasSubstr("Zebra-77")));
}

TEST_F(Bundle, HoldsFindingsAndStatuses) {
  findings_ = {fail("alfa: x = 1; password Zebra-77", "mend")};
  BundleContents all_of_it = contents();
  all_of_it.statuses = {{"alfa", "station alfa, boot 7"},
                        {"../bravo", "station bravo\npsk=Zebra-77"}};
  const std::string file = (folder_ / "b.tar.gz").string();
  write_bundle(file, all_of_it);
  const std::string all = unpacked(file);
  EXPECT_THAT(all, HasSubstr("\"what\": \"alfa: x = 1; password [removed]\","));
  EXPECT_THAT(all, HasSubstr("station bravo\npsk=[removed]\nstation alfa, boot 7\n"));
  EXPECT_THAT(all, Not(HasSubstr("Zebra-77")));
}

TEST_F(Bundle, SaysWhereItCannotBeWritten) {
  const std::string file = (folder_ / "none" / "b.tar.gz").string();
  EXPECT_THAT([&] { write_bundle(file, contents()); },
              testing::ThrowsMessage<std::runtime_error>(file + ": cannot be written"));
}

}  // namespace
}  // namespace ols::doctor
