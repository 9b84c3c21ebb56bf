// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SHA256_H
#define SELVEDGE_SHA256_H

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace selvedge {

/// Computes the SHA-256 (FIPS 180-4) of bytes that are added part by part.
class Sha256
{
public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::string_view bytes);

  /// Returns the digest in 64 lowercase hexadecimal digits. To be called once, after the last `add`.
  std::string digest();

private:
  struct Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

/// Returns the SHA-256 of a file's bytes, in the same form. Throws `Input_error` when the file cannot be
/// read.
std::string sha256_of_file(const std::filesystem::path& path);

} // namespace selvedge

#endif // SELVEDGE_SHA256_H
