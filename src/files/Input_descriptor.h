// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_INPUT_DESCRIPTOR_H
#define SELVEDGE_SRC_FILES_INPUT_DESCRIPTOR_H

#include <cstddef>
#include <filesystem>
#include <string>

namespace selvedge::files {

/// A file that `read_mesh` reads. Where nothing can be read yet, as from a pipe, reading waits, and the wait
/// can be cancelled. Throws `Input_error` when the file cannot be read, and `Interrupted` when the wait is
/// cancelled.
class Input_descriptor
{
public:
  explicit Input_descriptor(const std::filesystem::path& path);
  ~Input_descriptor();
  Input_descriptor(const Input_descriptor&) = delete;
  Input_descriptor& operator=(const Input_descriptor&) = delete;

  /// Reads at most `size` bytes and returns their number; 0 at the end of the file.
  std::size_t read(char* data, std::size_t size);

private:
  std::string m_name;
  int m_descriptor;
  bool m_is_awaited; // it is no regular file
};

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_INPUT_DESCRIPTOR_H
