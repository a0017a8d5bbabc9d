// Computes the duration of a poll cycle on a serial line. Pure.
//
// A cycle in motion requests each position twice (edge/ptu/poll_cycle.h):
//
//    PP PS18700 TS18700 TP PP-49467 TP TP-14622 PP        out, 49 bytes
//   * -49467  *  *  * -14622  *  * -14622  *  * -49467    in, 50 bytes; in the worst case, the last
//                                                         20 bytes come after the request's end
//
//   baud      cycle in motion, with 2 ms for the unit    at rest (13 bytes out, 40 in)
//   9600      74 ms                                      48 ms
//   19200     38 ms                                      25 ms
//   38400     20 ms                                      14 ms
//   115200    8 ms                                       6 ms
//
// There is only one request on the line at a time. Replies can then be matched to queries, and the
// instant of a position is known. The period is poll_interval_s or the duration of the cycle,
// whichever is longer. Only commands that differ from the last ones are sent. A period of 25 ms
// needs 38400 baud. If each position were read only once, 9600 baud would allow 21 cycles a second
// instead of 13, but a wrong digit would not be noticed.
#pragma once

namespace ols::ptu {

double byte_time_s(int baud);      // one start bit, eight bits, one stop bit
double longest_cycle_s(int baud);  // cycle in motion
double resting_cycle_s(int baud);  // cycle without commands

}  // namespace ols::ptu
