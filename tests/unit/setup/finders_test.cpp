// The finders of mounts, against heads on pseudo terminals and INDI's own telescope simulator.
#include "tools/setup/finders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/config/toml_text.h"
#include "tests/unit/edge/mount/indi/indi_server.h"
#include "tests/unit/edge/mount/serial/head_on_a_line.h"
#include "tests/unit/eventually.h"
#include "tests/unit/setup/answers_fixture.h"
#include "tools/setup/find_heads.h"
#include "tools/setup/find_indi.h"
#include "tools/setup/plan.h"

namespace ols::setup {
namespace {

using serial_mount::Head;
using serial_mount::Language;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::string file_with(const Found& mount) {
  Answers answers = read_answers(station_answers(), "a");
  answers.values.emplace_back("station.camera.device", "\"Maker-1\"");
  answers.values.insert(answers.values.end(), mount.values.begin(), mount.values.end());
  EXPECT_TRUE(has_mount(answers.values));
  return plan_station(answers).files[0].text;
}

TEST(FindHeads, AHeadIsFoundByItsAnswerAndBecomesAMount) {
  Head visca(Language::kVisca), pelco(Language::kPelcoD);
  pelco.listen_at(B2400);
  const std::vector lines{std::string("/nonexistent/line"), visca.device(), pelco.device()};
  const auto viscas = find_heads(lines, Language::kVisca, 1);
  ASSERT_THAT(viscas, SizeIs(1));
  EXPECT_EQ(viscas[0].device, visca.device());
  const auto pelcos = find_heads(lines, Language::kPelcoD, 1);
  ASSERT_THAT(pelcos, SizeIs(1));
  EXPECT_EQ(pelcos[0].device, pelco.device());
  EXPECT_EQ(pelcos[0].baud, 2400);
  EXPECT_FALSE(visca.turns() || pelco.turns());

  const std::string text = file_with(found_head(pelcos[0]));
  for (const char* line : {"kind = \"pelco-d\"", "baud = 2400", "pan_gain_deg = -1 "})
    EXPECT_THAT(text, HasSubstr(line));
  EXPECT_THAT(file_with(found_head(viscas[0])), HasSubstr("kind = \"visca\""));
}

TEST(FindHeads, AHeadWithAnotherAddressIsNotFound) {
  const Head head(Language::kPelcoD);
  EXPECT_THAT(find_heads({head.device()}, Language::kPelcoD, 2), IsEmpty());
}

TEST(FindIndi, TelescopesOfAServerAreFound) {
  const indi::Server server(7741);
  std::vector<Found> found;
  ASSERT_TRUE(eventually([&] {
    found = find_indi("localhost", 7741);
    return !found.empty();
  }));
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].words, "Telescope Simulator at localhost:7741");
  const std::string text = file_with(found[0]);
  for (const char* line : {"kind = \"indi\"", "device = \"Telescope Simulator\"", "port = 7741"})
    EXPECT_THAT(text, HasSubstr(line));
  EXPECT_THAT(find_indi("localhost", 7742), IsEmpty()) << "no server";
}

TEST(FindIndi, OtherDevicesAreNot) {
  const indi::Server server(7743, "indi_simulator_focus");
  EXPECT_TRUE(eventually([&] { return indi::has_devices(7743); }));
  EXPECT_THAT(find_indi("localhost", 7743), IsEmpty());
}

TEST(Finders, ALineOnWhichADeviceIsFoundIsNotSearchedAgain) {
  std::vector<std::string> searched;
  const Finder first{
      "a", "a", [](const Search&) {
        return std::vector<Found>{{"one", {{"station.mount.device", toml_text("/dev/one")}}}};
      }};
  const Finder second{"b", "b", [&](const Search& search) {
                        searched = search.lines;
                        return std::vector<Found>{};
                      }};
  EXPECT_THAT(find_all({first, second}, {{"/dev/one", "/dev/two"}}), SizeIs(1));
  EXPECT_EQ(searched, std::vector<std::string>{"/dev/two"});
}

}  // namespace
}  // namespace ols::setup
