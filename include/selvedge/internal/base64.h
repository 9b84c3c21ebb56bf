// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_INTERNAL_BASE64_H
#define SELVEDGE_INTERNAL_BASE64_H

#include <selvedge/Cancellation_scope.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace selvedge {
namespace internal {

/// Returns bytes as base64 (RFC 4648, section 4), in one line.
inline std::string base64(const std::string& bytes)
{
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  Cancellation_poll poll;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    poll();
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      result += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return result;
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_INTERNAL_BASE64_H
