#include "console/incidents/incident_store.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/unit/temporary_folder.h"

namespace ols::console {
namespace {

using Json = nlohmann::json;

Area gate() {
  return {"Gate", {{11.0, 48.0}, {11.01, 48.0}, {11.0, 48.01}}, 0.0, 900.0, {"drone"}, 60, 120};
}

Incident incident(std::uint64_t number) {
  Incident one;
  one.number = number;
  one.area = "Gate";
  one.target = "5/1";
  one.track = {{7, 11.001, 48.001, 100.0}};
  one.verdict = Judgement::kConfirmed;
  one.judged_by = "ana";
  return one;
}

std::string content(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(IncidentStore, KeepsAreasIncidentsAndPictures) {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/new/incidents";
  IncidentStore before(path);
  EXPECT_TRUE(before.read().areas.empty());
  Incident with_picture = incident(3);
  with_picture.picture = {{"station", "alfa"}};
  before.write(std::vector{gate()});
  before.write(with_picture);
  before.write_picture(3, "jpeg");
  before.write(incident(4));
  before.write(incident(9));
  before.remove(4);
  EXPECT_TRUE(before.alarms().empty());

  IncidentStore after(path);
  const KeptIncidents kept = after.read();
  EXPECT_TRUE(after.alarms().empty());
  ASSERT_EQ(kept.areas.size(), 1U);
  EXPECT_EQ(json_of(kept.areas[0]), json_of(gate()));
  ASSERT_EQ(kept.incidents.size(), 2U);
  for (const Incident& one : kept.incidents) {
    EXPECT_EQ(json_of(one), json_of(one.number == 3 ? with_picture : incident(9)));
  }
  EXPECT_EQ(kept.pictures, (std::map<std::uint64_t, std::string>{{3, "jpeg"}}));
  EXPECT_EQ(kept.numbers, 9U);
}

TEST(IncidentStore, NamesABadFileAndLeavesIt) {
  const TemporaryFolder folder;
  IncidentStore(folder.path()).write(std::vector{gate()});
  IncidentStore(folder.path()).write(incident(1));
  struct Case {
    const char *file, *content, *why;
  };
  for (const Case& c : {Case{"areas.json", "{", "parse error"},
                        Case{"areas.json", R"({"version": 2, "areas": []})", "version 2"},
                        Case{"2.json", R"({"version": 1, "incident": {}})", "number"},
                        Case{"8.json", R"({"version": 1})", "incident"}}) {
    const std::string path = folder.path() + "/" + c.file;
    std::ofstream(path) << c.content;
    IncidentStore store(folder.path());
    const KeptIncidents kept = store.read();
    EXPECT_EQ(kept.incidents.size(), 1U);
    ASSERT_FALSE(store.alarms().empty());
    EXPECT_NE(store.alarms().back().text.find(c.file), std::string::npos);
    EXPECT_NE(store.alarms().back().text.find(c.why), std::string::npos)
        << store.alarms().back().text;
    EXPECT_FALSE(kept.may_change_areas);
    EXPECT_EQ(content(path), c.content);
  }
  EXPECT_EQ(IncidentStore(folder.path()).read().numbers, 8U);
}

TEST(IncidentStore, SaysThatItCannotWriteUntilItCan) {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/incidents";
  std::ofstream(path) << "no folder";
  IncidentStore store(path);
  store.write(incident(1));
  ASSERT_EQ(store.alarms().size(), 1U);
  EXPECT_EQ(store.alarms()[0].id, "incidents_unsaved");
  std::remove(path.c_str());
  store.write(incident(1));
  EXPECT_TRUE(store.alarms().empty());
}

}  // namespace
}  // namespace ols::console
