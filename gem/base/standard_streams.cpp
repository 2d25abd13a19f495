// Looks at each of the three descriptors, by POSIX calls.
#include "gem/base/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "gem/base/error.h"

namespace gem {

void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    // open() takes the lowest free number. That is this one, since all below are open.
    const int flags = stream == STDOUT_FILENO ? O_RDONLY : O_RDWR;
    if (open("/dev/null", flags) != stream) _exit(static_cast<int>(ExitCode::file_system));
  }
}

}  // namespace gem
