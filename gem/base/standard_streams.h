// Descriptors 0, 1 and 2 of the process.
#pragma once

namespace gem {

/// Opens /dev/null for each of standard input, output and error that is closed. Otherwise the next file that the
/// program opens gets its number, and messages are written into that file. What is written to a closed output still
/// fails with EBADF. Call it first in main. Ends the process with exit code 4 if /dev/null cannot be opened: no message
/// can be given.
void open_standard_streams();

}  // namespace gem
