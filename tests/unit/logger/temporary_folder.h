// A folder of one test's own, removed at its end; and a wait with a deadline.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <string>
#include <thread>

#include "base/clocks.h"

namespace ols {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() /
            ("ols_logger_" + std::string(test->name()) + "_" + std::to_string(::getpid()));
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string path() const { return path_.string(); }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

  // A file of so many bytes, the younger the greater `age_order`.
  void put(const std::string& name, std::size_t bytes, int age_order) const {
    std::ofstream(path_ / name) << std::string(bytes, 'x');
    std::filesystem::last_write_time(path_ / name, std::filesystem::file_time_type::clock::now() +
                                                       std::chrono::hours(-1000 + age_order));
  }
  std::set<std::string> names() const {
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) {
      found.insert(entry.path().filename().string());
    }
    return found;
  }

 private:
  std::filesystem::path path_;
};

inline bool eventually(const std::function<bool()>& condition) {
  const double deadline_s = clock_monotonic_s() + 30.0;
  while (!condition()) {
    if (clock_monotonic_s() > deadline_s) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

}  // namespace ols
