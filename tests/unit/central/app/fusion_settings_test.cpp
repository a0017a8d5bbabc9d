#include "central/app/fusion_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/config/toml_config.h"
#include "tests/unit/error_text.h"
#include "tests/unit/folder_test.h"

namespace ols::fusion {
namespace {

class FusionSettingsTest : public FolderTest<std::filesystem::path> {
 protected:
  FusionSettings load(const std::string& text) const {
    std::ofstream(path()) << text;
    return load_fusion_settings(path());
  }
  std::string path() const { return (folder_ / "fusion.toml").string(); }
  std::string refusal(const std::string& text) const {
    return error_text<ConfigError>([&] { load(text); }, "none");
  }
};

const std::vector<Motion>& models(const FusionSettings& settings) {
  return settings.fusion.tracks.filter.motion.models;
}

TEST_F(FusionSettingsTest, AllModelsAreMixedByDefault) {
  EXPECT_THAT(models(load("")),
              testing::ElementsAre(Motion::kConstantVelocity, Motion::kCoordinatedTurn,
                                   Motion::kAcceleration));
}

TEST_F(FusionSettingsTest, ModelsAreChosenByName) {
  EXPECT_THAT(models(load("[motion]\nmodels = [\"acceleration\", \"constant-velocity\"]\n")),
              testing::ElementsAre(Motion::kAcceleration, Motion::kConstantVelocity));
}

TEST_F(FusionSettingsTest, ModelsThatCannotBeMixedAreRefusedByName) {
  const std::string place = path() + ":2: motion.models: ";
  EXPECT_EQ(refusal("[motion]\nmodels = [\"hovering\"]\n"),
            place + "\"hovering\" is not one of constant-velocity, coordinated-turn, acceleration");
  EXPECT_EQ(refusal("[motion]\nmodels = [\"acceleration\", \"acceleration\"]\n"),
            place + "\"acceleration\" appears twice");
  EXPECT_EQ(refusal("[motion]\nmodels = []\n"), place + "needs at least one entry");
}

TEST_F(FusionSettingsTest, TheLandIsUnknownUntilItIsNamed) {
  EXPECT_EQ(load("").land_folder, "");
  const auto known = load("[land]\nfolder = \"/var/lib/ols/land\"\non_ground = [\"alfa\"]\n");
  EXPECT_EQ(known.land_folder, "/var/lib/ols/land");
  EXPECT_EQ(known.fusion.land.on_ground, std::vector<std::string>{"alfa"});
  EXPECT_EQ(refusal("[land]\non_ground = [\"alfa\"]\n"),
            path() + ":2: land.on_ground: needs folder: no land is known");
}

TEST_F(FusionSettingsTest, ACuesAccelerationHasLimits) {
  EXPECT_EQ(load("[cues]\nacceleration_sd_m_s2 = 100.0\n").fusion.cues.acceleration_sd_m_s2, 100.0);
  EXPECT_THAT(refusal("[cues]\nacceleration_sd_m_s2 = 101.0\n"),
              testing::HasSubstr(":2: cues.acceleration_sd_m_s2: "));
}

}  // namespace
}  // namespace ols::fusion
