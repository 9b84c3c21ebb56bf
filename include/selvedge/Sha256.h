// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SHA256_H
#define SELVEDGE_SHA256_H

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace selvedge {

/// The SHA-256 of bytes that come in parts, as FIPS 180-4 defines it.
class Sha256
{
public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::string_view bytes);

  /// In 64 lowercase hexadecimal digits. To be asked once.
  std::string digest();

private:
  struct Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

/// The SHA-256 of a file's bytes. Throws `Input_error` when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

} // namespace selvedge

#endif // SELVEDGE_SHA256_H
