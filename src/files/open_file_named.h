// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_OPEN_FILE_NAMED_H
#define SELVEDGE_SRC_FILES_OPEN_FILE_NAMED_H

#include <charconv>
#include <filesystem>
#include <string>
#include <system_error>

#include <unistd.h>

namespace selvedge::files {

/// Returns the number of the open file that /dev/stdin, /dev/stdout, /dev/fd/3 and the like name; -1 for
/// other paths. To open such a path anew would begin at the start of the file that is open already, and is
/// not possible for every kind of file.
inline int open_file_named(const std::filesystem::path& path)
{
  const std::string name = path.string();
  if (name == "/dev/stdin")
    return STDIN_FILENO;
  if (name == "/dev/stdout")
    return STDOUT_FILENO;
  if (name == "/dev/stderr")
    return STDERR_FILENO;
  for (const std::string folder : {"/dev/fd/", "/proc/self/fd/"})
    if (int number = -1; name.compare(0, folder.size(), folder) == 0) {
      const char* const end = name.data() + name.size();
      const auto [last, error] = std::from_chars(name.data() + folder.size(), end, number);
      return error == std::errc() && last == end ? number : -1;
    }
  return -1;
}

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_OPEN_FILE_NAMED_H
