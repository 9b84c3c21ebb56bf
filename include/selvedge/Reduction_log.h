// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_REDUCTION_LOG_H
#define SELVEDGE_REDUCTION_LOG_H

#include <selvedge/collapse_log.h>
#include <selvedge/simplify.h>

#include <cstddef>
#include <ostream>

namespace selvedge {

/// Writes the log of a reduction by `simplify_soup`, in the format of collapse_log.h.
class Reduction_log
{
public:
  /// Writes the header, the snaps, and the groups of coincident vertices. `header` describes the input file,
  /// its rounding, and the file of the obstacle, if there is one. The limits are added from `options`; the
  /// weld distance, an obstacle and poses that `header` does not describe, and the digests of the obstacle in
  /// the poses are added from `prepared`. (An obstacle has lost its triangles with two corners at one
  /// position there.)
  ///
  /// **Preconditions** `stream`, `numbering` and `prepared` outlive the log.
  Reduction_log(std::ostream& stream, Log_header header, const Log_numbering& numbering,
                const Prepared_soup& prepared, const Simplify_options& options);

  /// Writes one collapse. To be called by `Simplify_options::on_collapse`.
  void add_collapse(const Soup_collapse& collapse);

  /// Writes the last line, which describes the result.
  void finish(const Simplified_soup& result);

private:
  Log_writer m_writer;
  const Log_numbering& m_numbering;
  const Prepared_soup& m_prepared;
  std::size_t m_collapses = 0;
};

} // namespace selvedge

#endif // SELVEDGE_REDUCTION_LOG_H
