// Writes events into the system's journal with their fields. Where the journal does not listen, it
// writes lines into the program's log.
#pragma once

#include <cstdint>
#include <string>

#include "base/journal_event.h"

namespace ols {

// Writes the event once. If the standard error output is the journal, it writes fields (the journal
// would take a line for another entry); otherwise a line. From any thread.
void write_to_journal(const JournalEvent& event);

// Whether systemd's JOURNAL_STREAM ("device:inode") names this file.
bool names_stream(const std::string& journal_stream, std::uint64_t device, std::uint64_t inode);

}  // namespace ols
