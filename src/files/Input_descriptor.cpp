// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/Input_descriptor.h"
#include "files/open_file_named.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>

#include <cerrno>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

namespace selvedge::files {

// Opens a file to read. Without O_NONBLOCK, opening a pipe that nobody writes to yet would wait.
Input_descriptor::Input_descriptor(const std::filesystem::path& path) : m_name(path.string())
{
  const int number = open_file_named(path);
  m_descriptor = number >= 0 ? ::dup(number) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (m_descriptor < 0)
    throw Input_error(m_name + ": cannot be opened; check its permissions");
  struct stat status = {};
  m_is_awaited = ::fstat(m_descriptor, &status) == 0 && !S_ISREG(status.st_mode);
}

Input_descriptor::~Input_descriptor()
{
  ::close(m_descriptor);
}

std::size_t Input_descriptor::read(char* data, std::size_t size)
{
  constexpr int milliseconds = 100;
  for (;;) {
    Cancellation_scope::check();
    pollfd ready{m_descriptor, POLLIN, 0};
    if (m_is_awaited && ::poll(&ready, 1, milliseconds) <= 0)
      continue;
    const ssize_t count = ::read(m_descriptor, data, size);
    if (count >= 0)
      return static_cast<std::size_t>(count);
    if (errno != EINTR && errno != EAGAIN)
      throw Input_error(m_name + ": cannot be read to its end; check the disk");
  }
}

} // namespace selvedge::files
