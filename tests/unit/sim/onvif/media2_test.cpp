// What ols-setup learns of a camera by the services Media and Media2.
#include <gtest/gtest.h>

#include "edge/mount/onvif/onvif_link.h"
#include "sim/onvif/server.h"
#include "tests/unit/edge/mount/onvif/fake_camera.h"

namespace ols::sim {
namespace {

onvif::Offer offer_of(const std::string& encoding) {
  OnvifConfig config;
  config.port = 0;
  config.encoding = encoding;
  config.stream_uri = "rtsp://127.0.0.1:8554/video";
  const OnvifServer camera(config, 1);
  return onvif::OnvifLink(
             {5.0, ""},
             "http://127.0.0.1:" + std::to_string(camera.port()) + "/onvif/device_service",
             {config.user, config.password})
      .offer();
}

TEST(Media2, AStreamOfH265IsToldByItAlone) {
  for (const auto& [encoding, of_media2] : {std::pair{"H264", false}, {"H265", true}}) {
    const onvif::Offer offer = offer_of(encoding);
    ASSERT_EQ(offer.streams.size(), 1) << "the profile is the same in both services";
    const auto& stream = offer.streams[0];
    EXPECT_EQ(stream.profile.encoding, encoding);
    EXPECT_EQ(stream.profile.of_media2, of_media2);
    EXPECT_EQ(stream.profile.width_px, 1280);
    EXPECT_EQ(stream.url, "rtsp://127.0.0.1:8554/video");
    EXPECT_TRUE(stream.ptz);
  }
}

// The service Media is not there, or Media2 is announced and answers nonsense.
TEST(Media2, ACameraMayHaveEitherAlone) {
  constexpr const char* kCapabilities =
      "<GetCapabilitiesResponse><Capabilities/></GetCapabilitiesResponse>";
  constexpr const char* kServices =
      "<GetServicesResponse><Service><Namespace>http://www.onvif.org/ver20/media/wsdl</Namespace>"
      "<XAddr>http://10.0.0.5/m2</XAddr></Service></GetServicesResponse>";
  constexpr const char* kProfiles =
      "<GetProfilesResponse><Profiles token=\"a\"><Configurations><VideoEncoder><Encoding>H265"
      "</Encoding></VideoEncoder></Configurations></Profiles></GetProfilesResponse>";
  constexpr const char* kOldProfiles =
      "<GetProfilesResponse><Profiles token=\"a\"><VideoEncoderConfiguration><Encoding>JPEG"
      "</Encoding></VideoEncoderConfiguration></Profiles></GetProfilesResponse>";
  for (const bool new_alone : {true, false}) {
    onvif::FakeCamera camera([&](const std::string& name, const onvif::FakeCamera::Request& at) {
      const bool is_new = at.target() == "/m2";
      std::string content = "<Fault/>";
      if (name == "GetSystemDateAndTime") content = "<GetSystemDateAndTimeResponse/>";
      if (name == "GetCapabilities") content = kCapabilities;
      if (name == "GetServices") content = kServices;
      if (name == "GetProfiles" && is_new == new_alone) content = is_new ? kProfiles : kOldProfiles;
      if (name == "GetStreamUri" && is_new)
        content = "<GetStreamUriResponse><Uri>rtsp://10.0.0.5/new</Uri></GetStreamUriResponse>";
      if (name == "GetStreamUri" && !is_new)
        content =
            "<GetStreamUriResponse><MediaUri><Uri>rtsp://10.0.0.5/old</Uri></MediaUri>"
            "</GetStreamUriResponse>";
      return onvif::FakeCamera::Answer{200, content};
    });
    const onvif::Offer offer = onvif::OnvifLink({5.0, ""}, camera.url(), {}).offer();
    ASSERT_EQ(offer.streams.size(), 1);
    EXPECT_EQ(offer.streams[0].profile.encoding, new_alone ? "H265" : "JPEG");
    EXPECT_EQ(offer.streams[0].url, new_alone ? "rtsp://127.0.0.1/new" : "rtsp://127.0.0.1/old");
  }
}

}  // namespace
}  // namespace ols::sim
