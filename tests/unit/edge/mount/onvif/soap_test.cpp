#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "edge/mount/onvif/soap_answer.h"
#include "edge/mount/onvif/soap_request.h"

namespace ols::onvif {
namespace {

using ::testing::HasSubstr;

// With prefixes as some cameras write them: other names, and one that is not declared.
std::string envelope_of(const std::string& content) {
  return "<?xml version=\"1.0\"?><E:Envelope xmlns:E=\"http://www.w3.org/2003/05/soap-envelope\">"
         "<E:Header/><E:Body>" +
         content + "</E:Body></E:Envelope>";
}

std::string status_of(const std::string& position) {
  return envelope_of("<q:GetStatusResponse><q:PTZStatus>" + position +
                     "</q:PTZStatus></q:GetStatusResponse>");
}

std::string options_of(const std::string& spaces, const std::string& more = "") {
  return envelope_of("<GetConfigurationOptionsResponse><PTZConfigurationOptions><Spaces>" + spaces +
                     "</Spaces>" + more +
                     "</PTZConfigurationOptions></GetConfigurationOptionsResponse>");
}

TEST(OnvifRequest, TheDigestIsThatOfTheProgrammersGuide) {
  const std::string nonce("\x2c\xaa\x88\xe8\x6f\xc0\x8a\x42\x82\x42\xb3\x74\xce\xa6\x45\x96", 16);
  EXPECT_EQ(password_digest(nonce, "2010-09-16T07:50:45Z", "userpassword"),
            "tuOSpGlFlIXsozq4HFNeeGeFLEI=");
  const std::string text = envelope(stop("a<b"), {{"user", "userpassword"}, nonce, 1284623445});
  EXPECT_THAT(text, HasSubstr("tuOSpGlFlIXsozq4HFNeeGeFLEI="));
  EXPECT_THAT(text, HasSubstr("<ProfileToken>a&lt;b</ProfileToken>"));
  EXPECT_EQ(text.find("userpassword"), std::string::npos);
}

TEST(OnvifRequest, AMoveStatesItsVelocityAndItsLease) {
  const Request move = continuous_move("p", {-0.25, 1.0}, 1.0);
  EXPECT_THAT(move.body, HasSubstr("x=\"-0.250000\" y=\"1.000000\""));
  EXPECT_THAT(move.body, HasSubstr("<Timeout>PT1S</Timeout>"));
  EXPECT_THAT(continuous_move("p", {}, 1.5).body, HasSubstr("<Timeout>PT1.5S</Timeout>"));
  EXPECT_EQ(move.name(), "ContinuousMove");
}

TEST(OnvifAnswer, AStatusIsReadWithAnyPrefixes) {
  const PtzStatus read = status(
      status_of("<a:Position><b:PanTilt x=\" -0.5 \" y=\"2.5e-1\"/><Zoom x=\"0\"/></a:Position>"
                "<MoveStatus><PanTilt>MOVING</PanTilt></MoveStatus>"));
  EXPECT_EQ(read.x, -0.5);
  EXPECT_EQ(read.y, 0.25);
  EXPECT_EQ(read.zoom, 0.0);
  EXPECT_EQ(read.moving, true);
}

TEST(OnvifAnswer, WhatACameraCanDoIsRead) {
  const auto space = [](const std::string& name) {
    return "<" + name +
           "><URI>u</URI><XRange><Min>-1</Min><Max>1</Max></XRange><YRange><Min>0</Min>"
           "<Max>90</Max></YRange></" +
           name + ">";
  };
  const PtzOptions all = options(
      options_of(space("AbsolutePanTiltPositionSpace") + space("ContinuousPanTiltVelocitySpace") +
                     "<AbsoluteZoomPositionSpace><URI/><XRange><Min>0</Min><Max>1</Max></XRange>"
                     "</AbsoluteZoomPositionSpace>",
                 "<PTZTimeout><Min>PT0.5S</Min><Max>PT1M</Max></PTZTimeout>"));
  ASSERT_TRUE(all.absolute && all.continuous && all.zoom && all.timeout);
  EXPECT_EQ(all.absolute->y.max, 90.0);
  EXPECT_FALSE(all.relative);
  EXPECT_EQ(all.timeout->min, 0.5);
  EXPECT_EQ(all.timeout->max, 60.0);
  EXPECT_FALSE(options(options_of("")).absolute);
}

TEST(OnvifAnswer, ProfilesServicesAndTheClockAreRead) {
  const auto read = profiles(envelope_of(
      "<GetProfilesResponse><Profiles token=\"a\"/><Profiles token=\"b\"><PTZConfiguration "
      "token=\"c\"/><VideoEncoderConfiguration><Encoding>H264</Encoding><Resolution><Width>1280</"
      "Width>"
      "<Height>720</Height></Resolution></VideoEncoderConfiguration></Profiles>"
      "</GetProfilesResponse>"));
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].configuration, "");
  EXPECT_EQ(read[1].configuration, "c");
  EXPECT_EQ(read[1].encoding + std::to_string(read[1].width_px + read[1].height_px), "H2642000");
  EXPECT_EQ(read[1].frame_rate_hz + read[0].width_px, 0.0);
  EXPECT_EQ(stream_uri(envelope_of("<GetStreamUriResponse><MediaUri><Uri>rtsp://h/v</Uri>"
                                   "</MediaUri></GetStreamUriResponse>")),
            "rtsp://h/v");
  EXPECT_EQ(services(envelope_of("<GetCapabilitiesResponse><Capabilities><PTZ><XAddr> http://h/p "
                                 "</XAddr></PTZ></Capabilities></GetCapabilitiesResponse>"))
                .ptz,
            "http://h/p");
  const std::string clock =
      "<GetSystemDateAndTimeResponse><SystemDateAndTime><UTCDateTime><Time><Hour>7</Hour>"
      "<Minute>50</Minute><Second>45</Second></Time><Date><Year>2010</Year><Month>9</Month><Day>16"
      "</Day></Date></UTCDateTime></SystemDateAndTime></GetSystemDateAndTimeResponse>";
  EXPECT_EQ(date_and_time(envelope_of(clock)), 1284623445);
}

// As the service Media2 has it (ONVIF Media Service Specification 2.x, section 5).
TEST(OnvifAnswer, Media2TellsItsProfilesAndTheirStreams) {
  const auto profiles = media2_profiles(envelope_of(
      R"(<tr2:GetProfilesResponse><tr2:Profiles token="a&amp;b" fixed="true"><tr2:Name>1</tr2:Name>
      <tr2:Configurations><tr2:VideoEncoder token="e"><tt:Encoding>H265</tt:Encoding><tt:Resolution>
      <tt:Width>2560</tt:Width><tt:Height>1440</tt:Height></tt:Resolution><tt:RateControl>
      <tt:FrameRateLimit>12.5</tt:FrameRateLimit></tt:RateControl></tr2:VideoEncoder>
      <tr2:PTZ token="p"><tt:NodeToken>n</tt:NodeToken></tr2:PTZ></tr2:Configurations>
      </tr2:Profiles><tr2:Profiles token="bare"/></tr2:GetProfilesResponse>)"));
  ASSERT_EQ(profiles.size(), 2);
  EXPECT_EQ(profiles[0].token, "a&b");
  EXPECT_EQ(profiles[0].encoding, "H265");
  EXPECT_EQ(profiles[0].width_px, 2560);
  EXPECT_EQ(profiles[0].frame_rate_hz, 12.5);
  EXPECT_EQ(profiles[0].configuration, "p");
  EXPECT_EQ(profiles[0].node, "n");
  EXPECT_TRUE(profiles[0].of_media2);
  EXPECT_EQ(profiles[1].encoding + profiles[1].configuration, "");
  EXPECT_EQ(media2_stream_uri(envelope_of("<GetStreamUriResponse><Uri>rtsp://h/v</Uri>"
                                          "</GetStreamUriResponse>")),
            "rtsp://h/v");
  const Services services = listed_services(envelope_of(
      R"(<GetServicesResponse><Service><Namespace>http://www.onvif.org/ver20/media/wsdl</Namespace>
      <XAddr>http://h/m2</XAddr></Service><Service><Namespace>urn:other</Namespace><XAddr>x</XAddr>
      </Service></GetServicesResponse>)"));
  EXPECT_EQ(services.media2, "http://h/m2");
  EXPECT_EQ(services.media + services.ptz, "");
}

TEST(OnvifAnswer, BadInputIsRefusedByName) {
  const std::string zoom = "<Position><PanTilt x=\"0\" y=\"0\"/><Zoom x=\"-0.1\"/></Position>";
  struct Case {
    std::string answer, words;
  };
  std::string deep, bomb = "<!DOCTYPE z [<!ENTITY a \"0\">]>";
  for (int i = 0; i < 100'000; ++i) deep += "<a>";
  for (const auto& [answer, words] : std::vector<Case>{
           {"", "no XML"},
           {std::string("\xff\xfe<\0a\0", 6), "no XML"},
           {"<html><body>Not found</body></html>", "no SOAP envelope"},
           {deep, "no XML"},
           {envelope_of(""), "another answer"},
           {envelope_of("<GetProfilesResponse/>"), "another answer"},
           {envelope_of("<GetStatusResponse/>"), "no PTZStatus"},
           {status_of(""), "no Position"},
           {status_of("<Position/>"), "no PanTilt"},
           {status_of("<Position><PanTilt x=\"0\"/></Position>"), "PanTilt without y"},
           {status_of("<Position><PanTilt x=\"NaN\" y=\"0\"/></Position>"),
            "PanTilt x is no number"},
           {status_of("<Position><PanTilt x=\"inf\" y=\"0\"/></Position>"),
            "PanTilt x is no number"},
           {status_of("<Position><PanTilt x=\"0,5\" y=\"0\"/></Position>"),
            "PanTilt x is no number"},
           {status_of("<Position><PanTilt x=\"1e9\" y=\"0\"/></Position>"), "PanTilt x is absurd"},
           {status_of(zoom), "Zoom is negative"},
           {bomb + status_of("<Position><PanTilt x=\"&a;\" y=\"0\"/></Position>"),
            "PanTilt x is no number"},
       }) {
    try {
      status(answer);
      ADD_FAILURE() << "accepted: " << answer.substr(0, 300);
    } catch (const AnswerError& error) {
      EXPECT_THAT(error.what(), HasSubstr("GetStatus: " + words));
    }
  }
  EXPECT_THROW(options(options_of("<AbsolutePanTiltPositionSpace><URI/><XRange><Min>1</Min><Max>1"
                                  "</Max></XRange></AbsolutePanTiltPositionSpace>")),
               AnswerError);
  EXPECT_THROW(profiles(envelope_of("<GetProfilesResponse><Profiles/></GetProfilesResponse>")),
               AnswerError);
}

TEST(OnvifAnswer, AFaultSaysWhetherTheLoginIsRefused) {
  const auto fault = [](const std::string& subcode) {
    return envelope_of(
        "<E:Fault><E:Code><E:Value>E:Sender</E:Value><E:Subcode><E:Value>ter:" + subcode +
        "</E:Value></E:Subcode></E:Code><E:Reason><E:Text>no\x1b[2J"
        "</E:Text></E:Reason></E:Fault>");
  };
  for (const auto& [subcode, login] :
       {std::pair{"NotAuthorized", true}, {"InvalidArgVal", false}}) {
    try {
      check_done(fault(subcode), "Stop");
      ADD_FAILURE();
    } catch (const SoapFault& error) {
      EXPECT_EQ(error.not_authorized, login);
      EXPECT_STREQ(error.what(), "Stop refused: no?[2J");
    }
  }
}

}  // namespace
}  // namespace ols::onvif
