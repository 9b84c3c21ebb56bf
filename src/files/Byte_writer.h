// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_BYTE_WRITER_H
#define SELVEDGE_SRC_FILES_BYTE_WRITER_H

#include "files/Atomic_file.h"
#include "files/gzip.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/mesh_files.h>

#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

namespace selvedge::files {

/// Writes text and binary numbers to an `Atomic_file` through a buffer, and packs them when the name of the
/// file ends in .gz. The writers of all formats use it.
class Byte_writer
{
public:
  explicit Byte_writer(const std::filesystem::path& path) : m_file(path), m_buffer(capacity)
  {
    if (is_gzip(path))
      m_packer.emplace([this](const char* data, std::size_t size) { m_file.write(data, size); });
  }

  Byte_writer& operator<<(std::string_view text)
  {
    if (text.size() > m_buffer.size() - m_size)
      flush();
    if (text.size() > m_buffer.size()) {
      put(text.data(), text.size());
    } else {
      std::memcpy(m_buffer.data() + m_size, text.data(), text.size());
      m_size += text.size();
    }
    return *this;
  }

  Byte_writer& operator<<(char c) { return *this << std::string_view(&c, 1); }

  /// Writes an integer as a decimal, and a floating-point number as the shortest decimal that reads back as
  /// the same number.
  template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
  Byte_writer& operator<<(Number number)
  {
    constexpr std::size_t longest = 32;
    if (m_buffer.size() - m_size < longest)
      flush();
    char* const begin = m_buffer.data() + m_size;
    m_size += static_cast<std::size_t>(std::to_chars(begin, begin + longest, number).ptr - begin);
    return *this;
  }

  /// Writes the bytes of an unsigned integer or of a floating-point number, the least significant first, or
  /// last when `big_endian`.
  template <class Number>
  void binary(Number number, bool big_endian = false)
  {
    using Bits = std::conditional_t<sizeof(Number) == 8, std::uint64_t,
                                    std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint16_t>>;
    static_assert(sizeof(Bits) == sizeof(Number));
    Bits bits;
    std::memcpy(&bits, &number, sizeof bits);
    std::array<char, sizeof bits> bytes;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      bytes[big_endian ? bytes.size() - 1 - i : i] = static_cast<char>(bits >> (8 * i) & 0xff);
    *this << std::string_view(bytes.data(), bytes.size());
  }

  /// Writes what is left in the buffer and makes the file appear. Once the last bytes are written, this is
  /// not cancelled.
  void commit()
  {
    flush();
    if (m_packer)
      m_packer->finish();
    m_file.commit();
  }

private:
  static constexpr std::size_t capacity = 1 << 18;

  void flush()
  {
    Cancellation_scope::check();
    put(m_buffer.data(), m_size);
    m_size = 0;
  }

  void put(const char* data, std::size_t size)
  {
    if (m_packer)
      m_packer->add(data, size);
    else
      m_file.write(data, size);
  }

  Atomic_file m_file;
  std::optional<Gzip_packer> m_packer;
  std::vector<char> m_buffer;
  std::size_t m_size = 0;
};

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_BYTE_WRITER_H
