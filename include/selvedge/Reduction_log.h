// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_REDUCTION_LOG_H
#define SELVEDGE_REDUCTION_LOG_H

#include <selvedge/collapse_log.h>
#include <selvedge/simplify_soup.h>

#include <cstddef>
#include <ostream>

namespace selvedge {

/// Writes the log of a reduction by `simplify_soup`. Of an obstacle it holds only that there was one.
class Reduction_log
{
public:
  /// `header` names the file, its rounding, and the file of the obstacle if there is one; the limits are
  /// added from the options, the weld distance and an obstacle without a file from `prepared`. Writes snaps
  /// and welds. All arguments but the header and the options outlive the log.
  Reduction_log(std::ostream& stream, Log_header header, const Log_numbering& numbering,
                const Prepared_soup& prepared, const Simplify_options& options);

  /// Called by `Simplify_options::on_collapse`.
  void add_collapse(std::size_t removed, std::size_t kept);

  void finish(const Simplified_soup& result);

private:
  Log_writer m_writer;
  const Log_numbering& m_numbering;
  const Prepared_soup& m_prepared;
  std::size_t m_collapses = 0;
};

} // namespace selvedge

#endif // SELVEDGE_REDUCTION_LOG_H
