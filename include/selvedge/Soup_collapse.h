// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_COLLAPSE_H
#define SELVEDGE_SOUP_COLLAPSE_H

#include <array>
#include <cstddef>
#include <optional>

namespace selvedge {

/// A collapse of a soup.
struct Soup_collapse
{
  std::size_t removed = 0; ///< a vertex at the position that moves away
  std::size_t kept = 0;    ///< a vertex at the position with which it merges

  /// Where both go, if that is neither of the two positions.
  std::optional<std::array<double, 3>> place = std::nullopt;
  bool is_removed_first = false; ///< whether `removed` goes there before `kept`

  friend bool operator==(const Soup_collapse& a, const Soup_collapse& b)
  {
    return a.removed == b.removed && a.kept == b.kept && a.place == b.place &&
           a.is_removed_first == b.is_removed_first;
  }
};

} // namespace selvedge

#endif // SELVEDGE_SOUP_COLLAPSE_H
