// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_LOGGED_REDUCTION_H
#define SELVEDGE_TEST_SUPPORT_LOGGED_REDUCTION_H

#include <selvedge/Reduction_log.h>
#include <selvedge/collapse_log.h>
#include <selvedge/replay.h>
#include <selvedge/simplify.h>

#include <sstream>
#include <string>

namespace selvedge::test {

struct Logged_reduction
{
  Triangle_soup original;
  Simplified_soup simplified;
  std::string log;
};

inline Logged_reduction reduce_and_log(const Triangle_soup& soup, Simplify_options options,
                                       const Prepare_options& prepare_options = {}, bool is_stl = false,
                                       const Triangle_soup& obstacle = {})
{
  Logged_reduction result;
  result.original = soup;
  const Log_numbering numbering(soup, is_stl);
  Log_header header;
  header.vertices = numbering.size();
  header.triangles = soup.triangles.size();
  header.is_rounded_to_float32 = prepare_options.round_to_float32;
  if (!obstacle.triangles.empty())
    header.obstacle = {obstacle.points.size(), obstacle.triangles.size(), {}};
  const Prepared_soup prepared = prepare(soup, prepare_options, obstacle);
  std::ostringstream stream;
  Reduction_log log(stream, header, numbering, prepared, options);
  options.on_collapse = [&](const Soup_collapse& collapse) { log.add_collapse(collapse); };
  result.simplified = simplify_soup(prepared, options);
  log.finish(result.simplified);
  result.log = stream.str();
  return result;
}

/// Returns the first lines of a log of collapses of a soup.
inline std::string head_of(const Triangle_soup& soup, const std::string& more = {})
{
  return "selvedge-log 1\ninput " + std::to_string(soup.points.size()) + ' ' +
         std::to_string(soup.triangles.size()) + " -\n" + more;
}

inline Replay_verdict replay_text(const Triangle_soup& original, const std::string& log,
                                  const Replay_options& options = {}, bool is_stl = false)
{
  std::istringstream stream(log);
  Log_reader reader(stream, "log");
  return replay(original, is_stl, reader, options);
}

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_LOGGED_REDUCTION_H
