// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_ATOMIC_FILE_H
#define SELVEDGE_SRC_FILES_ATOMIC_FILE_H

#include <cstddef>
#include <filesystem>
#include <string>

namespace selvedge::files {

/// The file that `write_mesh` writes. It appears whole, on `commit`, or not at all: until then its contents
/// are in a new file of the same folder. What is no regular file, such as a pipe, is written to directly.
/// Every function may throw `Output_error` or `Interrupted`; the destructor then removes the new file.
class Atomic_file
{
public:
  explicit Atomic_file(const std::filesystem::path& path);
  ~Atomic_file();
  Atomic_file(const Atomic_file&) = delete;
  Atomic_file& operator=(const Atomic_file&) = delete;

  void write(const char* data, std::size_t size);
  void commit();

private:
  [[noreturn]] void fail(int error) const;
  void open_device(bool is_pipe);
  void open_temporary();

  static constexpr int s_milliseconds = 100; // between two checks for cancellation during a wait

  std::string m_name;
  std::filesystem::path m_target;
  std::filesystem::path m_temporary; // empty when the target is no regular file, and written to directly
  int m_descriptor = -1;
};

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_ATOMIC_FILE_H
