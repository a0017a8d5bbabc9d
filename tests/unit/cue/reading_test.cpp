#include "cue/reading.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

#include "cue/source.h"
#include "cue/text_time.h"

namespace ols::cues {
namespace {

TEST(Reading, EachRefusalHasANameOfItsOwn) {
  std::set<std::string> names;
  for (int i = 0; i < static_cast<int>(Refusal::kCount); ++i) {
    names.insert(to_string(static_cast<Refusal>(i)));
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(Refusal::kCount));
  EXPECT_FALSE(names.contains("unknown"));
}

TEST(TextTime, IsTheInstantThatItNames) {
  EXPECT_EQ(utime_of_iso("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(utime_of_iso("2026-11-23T10:15:30.250Z"), 1'795'428'930'250'000);  // date -u +%s
  EXPECT_EQ(utime_of_iso("2024-02-29T23:59:59.999999Z"), 1'709'251'199'999'999);
}

TEST(TextTime, AnythingElseIsNone) {
  for (const char* text :
       {"", "2026-11-23", "2026-11-23T10:15:30", "2026-13-23T10:15:30Z", "2026-11-23T24:15:30Z",
        "2026-11-23T10:15:30Zx", "2026-11-23T10:15:nanZ", "1969-11-23T10:15:30Z",
        "2026-11-23T10:15:-1Z", "2026-11-23T10:15:infZ"}) {
    EXPECT_FALSE(utime_of_iso(text)) << text;
  }
}

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
