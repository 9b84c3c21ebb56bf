// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_TEMPORARY_FOLDER_H
#define SELVEDGE_TEST_SUPPORT_TEMPORARY_FOLDER_H

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include <stdlib.h>

namespace selvedge::test {

inline std::string contents_of(const std::filesystem::path& path)
{
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A new folder that is gone, with all that is in it, at the end of the scope.
class Temporary_folder
{
public:
  Temporary_folder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "selvedge-test-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw std::runtime_error("no folder can be made in " + std::filesystem::temp_directory_path().string());
    m_path = name;
  }

  ~Temporary_folder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
  }

  Temporary_folder(const Temporary_folder&) = delete;
  Temporary_folder& operator=(const Temporary_folder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return m_path / name; }
  const std::filesystem::path& path() const { return m_path; }

private:
  std::filesystem::path m_path;
};

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_TEMPORARY_FOLDER_H
