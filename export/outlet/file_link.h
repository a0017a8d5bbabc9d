// Writes each packet as a file, which appears whole or not at all. Packet::where is inserted into
// the file's name before the extension.
#pragma once

#include <string>

#include "export/outlet/link.h"

namespace ols::exports {

class FileLink : public Link {
 public:
  explicit FileLink(std::string path) : path_(std::move(path)) {}

  // Checks that the file can be written. If not, throws LinkError, and the link stays closed.
  void open() override;
  void send(const Packet& packet) override;
  void wait(int wake_fd, double seconds) override;
  void close() override {}
  bool forgets() const override { return false; }

 private:
  std::string path_;
};

// For example "site-live.kml" from "site.kml" and "-live".
std::string file_name(const std::string& path, const std::string& where);

}  // namespace ols::exports
