#include "edge/mount/onvif/discovery.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ols::onvif {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kQuestion = "urn:uuid:1b9d2f3e-0000-4000-8000-000000000001";
const std::string kSender = "10.0.0.5";

struct Match {
  std::string id = "urn:uuid:c0ffee";
  std::string types = "dn:NetworkVideoTransmitter tds:Device";
  std::string addresses = "http://10.0.0.5/onvif/device_service";
  std::string scopes = "onvif://www.onvif.org/type/ptz onvif://www.onvif.org/name/PTZ%204";

  std::string text() const {
    return "<d:ProbeMatch><a:EndpointReference><a:Address>" + id +
           "</a:Address></a:EndpointReference><d:Types>" + types + "</d:Types><d:Scopes>" + scopes +
           "</d:Scopes><d:XAddrs>" + addresses + "</d:XAddrs></d:ProbeMatch>";
  }
};

std::string answer(const std::string& matches, const std::string& question = kQuestion) {
  return "<?xml version=\"1.0\"?><E:Envelope><E:Header><a:RelatesTo>" + question +
         "</a:RelatesTo></E:Header><E:Body><d:ProbeMatches>" + matches +
         "</d:ProbeMatches></E:Body></E:Envelope>";
}

TEST(Discovery, ACameraIsFoundOnceHoweverOftenItAnswers) {
  Discovery discovery(kQuestion);
  Match routed{.addresses =
                   " http://192.168.1.64/onvif/device_service\n"
                   "http://[fe80::1]/onvif/device_service " +
                   Match{}.addresses};
  for (int i = 0; i < 2; ++i) discovery.add(answer(routed.text()), kSender);
  ASSERT_EQ(discovery.cameras().size(), 1u);
  EXPECT_EQ(discovery.cameras().front().url, Match{}.addresses);
  EXPECT_EQ(discovery.cameras().front().name, "PTZ 4");
  // Some devices leave out "urn:".
  discovery.add(answer(Match{.id = "urn:uuid:2", .addresses = "https://10.0.0.6:8443/x"}.text(),
                       kQuestion.substr(4)),
                "10.0.0.6");
  EXPECT_EQ(discovery.cameras().size(), 2u);
  EXPECT_THAT(discovery.refused(), IsEmpty());
}

TEST(Discovery, WhatIsNoAnswerOfACameraIsRefusedByName) {
  std::string nested = answer(Match{}.text());
  nested.insert(nested.find("<E:Envelope"),
                "<!DOCTYPE x [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;&a;\">]>");
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "no XML"},
      {std::string(60000, '<'), "no XML"},
      {nested, "document type"},
      {"<E:Envelope><E:Body/></E:Envelope>", "no ProbeMatches"},
      {answer(Match{}.text(), "urn:uuid:another"), "another question"},
      {answer(Match{}.text(), ""), "another question"},
      {answer(Match{.types = "wprt:PrintDeviceType\n"}.text()), "no camera: wprt:Print"},
      {answer(Match{.types = ""}.text()), "no camera"},
      {answer(Match{.id = ""}.text()), "no usable Address"},
      {answer(Match{.addresses = " "}.text()), "no XAddrs"},
      {answer(Match{.addresses = "http://10.0.0.9/onvif"}.text()), "no address of its own"},
      {answer(Match{.addresses = "http://u:p@10.0.0.5/onvif"}.text()), "no address of its own"},
      {answer(Match{.addresses = "file://10.0.0.5/etc"}.text()), "no address of its own"}};
  for (const auto& [text, why] : cases) {
    Discovery discovery(kQuestion);
    discovery.add(text, kSender);
    EXPECT_THAT(discovery.cameras(), IsEmpty()) << why;
    EXPECT_THAT(discovery.refused(), ElementsAre(HasSubstr(kSender + ": "))) << why;
    EXPECT_THAT(discovery.refused(), ElementsAre(HasSubstr(why)));
  }
}

TEST(Discovery, ContradictionsAreRefusedAndMuchIsBounded) {
  Discovery discovery(kQuestion);
  const std::string elsewhere = "http://10.0.0.5:81/onvif";
  discovery.add(answer(Match{}.text() + Match{.addresses = elsewhere}.text() +
                       Match{.id = "urn:uuid:other"}.text()),
                kSender);
  EXPECT_EQ(discovery.cameras().size(), 1u);
  EXPECT_THAT(discovery.refused(),
              ElementsAre(HasSubstr("the same camera as"), HasSubstr("another camera at")));
  for (int i = 0; i < 1000; ++i) {
    const std::string number = std::to_string(i), sender = "10.1.0." + number;
    discovery.add(answer(Match{.id = number, .addresses = "http://" + sender + "/o"}.text()),
                  sender);
  }
  EXPECT_EQ(discovery.cameras().size(), Discovery::kMostCameras);
  EXPECT_EQ(discovery.refused().size(), Discovery::kMostRefused);
}

TEST(Discovery, AProbeAsksForCameras) {
  const std::string text = probe(kQuestion);
  EXPECT_THAT(text, HasSubstr("<a:MessageID>" + kQuestion + "<"));
  EXPECT_THAT(text, HasSubstr("n:NetworkVideoTransmitter</d:Types>"));
}

}  // namespace
}  // namespace ols::onvif
