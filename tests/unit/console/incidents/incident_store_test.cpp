#include "console/incidents/incident_store.h"

#include <gtest/gtest.h>

#include <filesystem>
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

constexpr double kNow_s = 100.0;

IncidentBook book_of(KeptIncidents kept) {
  IncidentBook book{IncidentRecording{}};
  book.resume(std::move(kept), 0.0);
  return book;
}

TEST(IncidentStore, KeepsAreasIncidentsAndPictures) {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/new/incidents";
  IncidentStore before(path);
  EXPECT_TRUE(before.read().areas.empty());
  Incident with_picture = incident(3);
  with_picture.picture = {{"station", "alfa"}};
  const KeptIncidents made{.areas = {gate()},
                           .incidents = {with_picture, incident(4), incident(9)},
                           .pictures = {{3, "jpeg"}}};
  before.keep(book_of(made), {true, {3, 4, 9}, {3}, {}}, kNow_s);
  before.keep(book_of(made), {.forgotten = {4}}, kNow_s);
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
  IncidentStore(folder.path())
      .keep(book_of({.areas = {gate()}, .incidents = {incident(1)}}), {true, {1}, {}, {}}, kNow_s);
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
  IncidentStore store(path), unlisted(path);
  EXPECT_FALSE(unlisted.read().may_change_areas);
  const IncidentBook book =
      book_of({.incidents = {incident(1), incident(2)}, .pictures = {{1, "jpeg"}}});
  store.keep(book, {false, {1}, {1}, {}}, kNow_s);
  ASSERT_EQ(store.alarms().size(), 1U);
  EXPECT_EQ(store.alarms()[0].id, "incidents_unsaved");
  std::remove(path.c_str());
  unlisted.keep(book, {.incidents = {1}}, kNow_s);
  EXPECT_EQ(unlisted.alarms().back().id, "incidents_unsaved");
  EXPECT_FALSE(std::filesystem::exists(path)) << "its numbers may be taken";
  std::filesystem::create_directories(path + "/1.json");  // one that goes on failing
  store.keep(book, {.incidents = {2}}, kNow_s);
  EXPECT_EQ(store.alarms().size(), 1U) << "another's success does not end it";
  EXPECT_EQ(content(path + "/1.jpg"), "jpeg");
  std::filesystem::remove(path + "/1.json");
  store.keep(book, {}, kNow_s + 0.9 * IncidentStore::kAgain_s);
  EXPECT_FALSE(store.alarms().empty());
  store.keep(book, {}, kNow_s + IncidentStore::kAgain_s);
  EXPECT_TRUE(store.alarms().empty());
  EXPECT_NE(content(path + "/1.json"), "");
}

}  // namespace
}  // namespace ols::console
