// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/Atomic_file.h"
#include "files/open_file_named.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>

#include <cerrno>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

// Writes a file so that it appears whole or not at all, whatever fails or interrupts the writing.

namespace selvedge::files {

Atomic_file::Atomic_file(const std::filesystem::path& path) : m_name(path.string()), m_target(path)
{
  if (const int number = open_file_named(path); number >= 0) {
    m_descriptor = ::dup(number);
    if (m_descriptor < 0)
      fail(errno);
    return;
  }
  // A rename would replace a symbolic link instead of what it points to.
  std::error_code dangling;
  if (std::filesystem::is_symlink(path, dangling)) {
    m_target = std::filesystem::weakly_canonical(path, dangling);
    if (dangling)
      fail(dangling.value());
  }
  struct stat status = {};
  const bool exists = ::stat(m_target.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode))
    fail(EISDIR);
  if (exists && ::access(m_target.c_str(), W_OK) != 0)
    fail(errno);
  if (exists && !S_ISREG(status.st_mode)) {
    open_device(S_ISFIFO(status.st_mode));
    return;
  }
  open_temporary();
  // Where this is not allowed, the new file has the owner and the permissions of any new file.
  if (exists && ::fchown(m_descriptor, status.st_uid, status.st_gid) != 0 &&
      ::fchown(m_descriptor, uid_t(-1), status.st_gid) != 0)
    status.st_mode &= 0777; // nobody else's program or folder may take on an owner
  if (exists)
    static_cast<void>(::fchmod(m_descriptor, status.st_mode & 07777) == 0);
}

Atomic_file::~Atomic_file()
{
  if (m_descriptor >= 0)
    ::close(m_descriptor);
  if (!m_temporary.empty())
    ::unlink(m_temporary.c_str());
}

// Opens a device or a pipe. A pipe may have no reader at first (ENXIO) and may be full later; both are waited
// for.
void Atomic_file::open_device(bool is_pipe)
{
  for (;;) {
    Cancellation_scope::check();
    m_descriptor = ::open(m_target.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK);
    if (m_descriptor >= 0)
      return;
    if (!(errno == EINTR || (is_pipe && errno == ENXIO)))
      fail(errno);
    ::poll(nullptr, 0, s_milliseconds);
  }
}

void Atomic_file::open_temporary()
{
  // Not derived from the target's name, which may be as long as names can be.
  const std::string stem = ".selvedge-" + std::to_string(::getpid()) + "-";
  for (unsigned attempt = 0;; ++attempt) {
    const std::filesystem::path candidate =
        m_target.parent_path() / (stem + std::to_string(attempt) + ".tmp");
    m_descriptor = ::open(candidate.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (m_descriptor >= 0) {
      m_temporary = candidate;
      return;
    }
    if (errno != EEXIST)
      fail(errno);
  }
}

void Atomic_file::write(const char* data, std::size_t size)
{
  while (size != 0) {
    const ssize_t written = ::write(m_descriptor, data, size);
    if (written < 0 && errno == EAGAIN) {
      Cancellation_scope::check();
      pollfd ready{m_descriptor, POLLOUT, 0};
      ::poll(&ready, 1, s_milliseconds);
    } else if (written < 0 && errno != EINTR) {
      fail(errno);
    }
    if (written > 0) {
      data += written;
      size -= static_cast<std::size_t>(written);
    }
  }
}

void Atomic_file::commit()
{
  if (!m_temporary.empty() && ::fsync(m_descriptor) != 0)
    fail(errno);
  const int descriptor = m_descriptor;
  m_descriptor = -1;
  if (::close(descriptor) != 0)
    fail(errno);
  if (m_temporary.empty())
    return;
  if (::rename(m_temporary.c_str(), m_target.c_str()) != 0)
    fail(errno);
  m_temporary.clear();
}

void Atomic_file::fail(int error) const
{
  throw Output_error(m_name + ": cannot be written: " + std::generic_category().message(error));
}

} // namespace selvedge::files
