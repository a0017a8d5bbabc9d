#include "base/config/toml_merge.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ols {
namespace {

TEST(TomlMerge, ChangesValuesAndNothingElse) {
  EXPECT_EQ(toml_merged("# first\n"
                        "id = \"s1\"\n"
                        "[pose]   # of GROUND\n"
                        "heading_deg = -12 # by compass\n"
                        "\n"
                        "[calibration]\n"
                        "sd = { heading_deg = 2.0, mount_deg = 0.1 }\n"
                        "[ptu]\n"
                        "device = \"x\"",
                        "[pose]\nheading_deg = 211.5\ntilt_x_deg = 0.1\ntilt_y_deg = 0.2\n"
                        "[chain]\nmount_z_deg = 0.5\n[calibration.sd]\nheading_deg = 0.01\n"),
            "# first\n"
            "id = \"s1\"\n"
            "[pose]   # of GROUND\n"
            "heading_deg = 211.5 # by compass\n"
            "tilt_x_deg = 0.1\n"
            "tilt_y_deg = 0.2\n"
            "\n"
            "[calibration]\n"
            "sd = { heading_deg = 0.01, mount_deg = 0.1 }\n"
            "[ptu]\n"
            "device = \"x\"\n"
            "\n"
            "[chain]\n"
            "mount_z_deg = 0.5\n");
}

TEST(TomlMerge, RefusesAFormThatItWouldSpoil) {
  EXPECT_THROW(toml_merged("sd = { heading_deg = 2.0 }\nx = 1\n", "[sd]\ntilt_deg = 1.0\n"),
               std::runtime_error);
}

}  // namespace
}  // namespace ols
