#include "sim/camera/gige_description.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

namespace ols::sim::gige {
namespace {

std::set<std::string> matches(const std::string& text, const char* pattern) {
  std::set<std::string> found;
  const std::regex regex(pattern);
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) {
    found.insert((*it)[1]);
  }
  return found;
}

class GigeDescriptionTest : public testing::TestWithParam<FeatureNames> {
 protected:
  const std::string xml_ = description(GetParam());
};
INSTANTIATE_TEST_SUITE_P(BothNamings, GigeDescriptionTest,
                         testing::Values(FeatureNames::kGt1290c, FeatureNames::kSfnc));

// A client that finds a reference to nothing refuses the camera.
TEST_P(GigeDescriptionTest, EverythingThatIsReferredToIsDescribed) {
  const auto named = matches(xml_, R"re( Name="([^"]+)")re");
  for (const char* reference : {R"(<pValue>([^<]+)<)", R"(<pFeature>([^<]+)<)",
                                R"(<pVariable[^>]*>([^<]+)<)", R"(<pPort>([^<]+)<)"}) {
    for (const std::string& name : matches(xml_, reference)) {
      EXPECT_TRUE(named.contains(name)) << name;
    }
  }
}

TEST_P(GigeDescriptionTest, AFeatureIsNamedByOneConventionOnly) {
  const auto named = matches(xml_, R"re( Name="([^"]+)")re");
  const bool sfnc = GetParam() == FeatureNames::kSfnc;
  EXPECT_EQ(named.contains("ExposureTime"), sfnc);
  EXPECT_EQ(named.contains("ExposureTimeAbs"), !sfnc);
  EXPECT_TRUE(named.contains("Width") && named.contains("PixelFormat"));
}

}  // namespace
}  // namespace ols::sim::gige
