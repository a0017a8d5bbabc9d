// Writes events into the system's journal with their fields. Where the journal does not listen, it
// writes lines into the program's log.
#pragma once

#include <cstdint>
#include <string>

#include "base/journal/journal_event.h"

namespace ols {

// Writes the event once: with its fields if the standard error output is the journal, otherwise as
// a line. With fields no line is written, because the journal would take it for another entry. From
// any thread.
void write_to_journal(const JournalEvent& event);

// Whether systemd's JOURNAL_STREAM ("device:inode") names this file.
bool names_stream(const std::string& journal_stream, std::uint64_t device, std::uint64_t inode);

}  // namespace ols
