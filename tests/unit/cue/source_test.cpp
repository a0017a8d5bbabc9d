#include "cue/source.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ols::cues {
namespace {

TEST(Source, EachWayIsRead) {
  const Source group = parse_source("udp://239.2.3.1:6969?interface=10.0.0.5");
  EXPECT_EQ(group.carrier, Carrier::kUdp);
  EXPECT_EQ(group.host, "239.2.3.1");
  EXPECT_EQ(group.port, 6969);
  EXPECT_EQ(group.interface, "10.0.0.5");
  EXPECT_EQ(parse_source("tcp://adsb.site:30003").carrier, Carrier::kTcp);
  EXPECT_EQ(parse_source("file:///run/readsb/aircraft.json").path, "/run/readsb/aircraft.json");
  const Source web = parse_source("http://adsb.site/data/aircraft.json");
  EXPECT_EQ(web.carrier, Carrier::kHttp);
  EXPECT_EQ(web.host, "adsb.site");
  EXPECT_EQ(web.port, 80);
  EXPECT_EQ(web.path, "/data/aircraft.json");
  EXPECT_EQ(parse_source("http://[::1]:8080/a").port, 8080);
  EXPECT_EQ(parse_source("http://[::1]/a").port, 80);
}

TEST(Source, AnythingElseIsRefused) {
  for (const char* text :
       {"", "adsb.site", "tls://a:1", "mqtt://a", "https://a/b", "http://a", "http://a/b c",
        "http://a:0/b", "udp://host:1", "tcp://host", "http://a/b\r\nX: y"}) {
    EXPECT_THROW(parse_source(text), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace ols::cues
