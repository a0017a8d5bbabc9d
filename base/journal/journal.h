// Writes events into the system's journal with their fields. Without a journal, writes lines into
// the program's log instead.
#pragma once

#include <cstdint>
#include <string>

#include "base/journal/journal_event.h"

namespace ols {

// Writes the event once: with its fields if the standard error output is the journal, otherwise as
// a line. Never both: the journal would take the line for another entry. Call from any thread.
void write_to_journal(const JournalEvent& event);

// Whether systemd's JOURNAL_STREAM ("device:inode") names this file.
bool names_stream(const std::string& journal_stream, std::uint64_t device, std::uint64_t inode);

}  // namespace ols
