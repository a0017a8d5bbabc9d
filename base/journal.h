// Writes events into the system's journal with their fields, or, where the journal does not listen,
// as lines of the program's log.
#pragma once

#include <cstdint>
#include <string>

#include "base/journal_event.h"

namespace ols {

// Once: as fields if the standard error output is the journal, which would take a line there for
// another entry; otherwise as a line. From any thread.
void write_to_journal(const JournalEvent& event);

// Whether systemd's JOURNAL_STREAM, "device:inode", names this file.
bool names_stream(const std::string& journal_stream, std::uint64_t device, std::uint64_t inode);

}  // namespace ols
