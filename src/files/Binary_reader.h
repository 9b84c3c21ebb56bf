// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_BINARY_READER_H
#define SELVEDGE_SRC_FILES_BINARY_READER_H

#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace selvedge::files {

/// Reads numbers of a given byte order from bytes in memory, for the readers of binary formats. Copies are
/// cheap bookmarks. Precondition of every function: as many bytes as it passes remain.
class Binary_reader
{
public:
  Binary_reader(std::string_view bytes, bool big_endian)
      : m_at(reinterpret_cast<const unsigned char*>(bytes.data())), m_remaining(bytes.size()),
        m_big_endian(big_endian)
  {
  }

  std::size_t remaining() const { return m_remaining; }

  void skip(std::size_t bytes)
  {
    m_at += bytes;
    m_remaining -= bytes;
  }

  template <class Number>
  Number take()
  {
    using Bits = std::conditional_t<
        sizeof(Number) == 8, std::uint64_t,
        std::conditional_t<sizeof(Number) == 4, std::uint32_t,
                           std::conditional_t<sizeof(Number) == 2, std::uint16_t, std::uint8_t>>>;
    static_assert(sizeof(Bits) == sizeof(Number));
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(Number); ++i)
      bits |= std::uint64_t{m_at[i]} << 8 * (m_big_endian ? sizeof(Number) - 1 - i : i);
    skip(sizeof(Number));
    const Bits exact = static_cast<Bits>(bits);
    Number number;
    std::memcpy(&number, &exact, sizeof number);
    return number;
  }

private:
  const unsigned char* m_at;
  std::size_t m_remaining;
  bool m_big_endian;
};

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_BINARY_READER_H
