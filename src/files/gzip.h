// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_GZIP_H
#define SELVEDGE_SRC_FILES_GZIP_H

#include <functional>
#include <memory>
#include <string>
#include <string_view>

// Packs and unpacks files of gzip (RFC 1952), by zlib.

namespace selvedge::files {

/// Returns the contents of a packed file. `name` stands for the file in messages. Throws `Input_error` when
/// `packed` is no gzip file, is damaged or ends too early, and when its contents are more than 64 KiB and
/// more than 100 times its size: no mesh is packed that well, and a small file must not fill the memory.
std::string unpacked(std::string_view packed, const std::string& name);

/// Packs bytes part by part. The same bytes give the same packed bytes: there is no name and no time in them.
class Gzip_packer
{
public:
  using Sink = std::function<void(const char* data, std::size_t size)>;

  /// `sink` receives the packed bytes.
  explicit Gzip_packer(Sink sink);
  ~Gzip_packer();

  void add(const char* data, std::size_t size);

  /// Packs what is left. To be called once, after the last `add`.
  void finish();

private:
  struct Implementation;
  void pack(const char* data, std::size_t size, bool is_last);

  Sink m_sink;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_GZIP_H
