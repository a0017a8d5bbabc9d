// Writes events and their fields into the system's journal. Without a journal, writes lines into
// the program's log instead.
#pragma once

#include <cstdint>
#include <string>

#include "base/journal/journal_event.h"

namespace ols {

// If standard error goes to the journal, writes the event with its fields, otherwise as a line.
// Never writes both, because the journal would take the line for a second event. Call from any
// thread.
void write_to_journal(const JournalEvent& event);

// Whether systemd's JOURNAL_STREAM ("device:inode") names the file with this device and inode.
bool names_stream(const std::string& journal_stream, std::uint64_t device, std::uint64_t inode);

}  // namespace ols
