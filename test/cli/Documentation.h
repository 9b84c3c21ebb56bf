// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_CLI_DOCUMENTATION_H
#define SELVEDGE_TEST_CLI_DOCUMENTATION_H

#include "App_run.h"

#include <cstddef>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {

/// One row of a table in Markdown, cell by cell.
using Row = std::vector<std::string>;

/// Returns the rows of all tables that stand in a page of the documentation below headings that
/// `is_wanted(heading)` accepts, without the heads of the tables. A heading reaches to the next one of at
/// most its level.
template <class Is_wanted>
std::vector<Row> documented_rows(const std::string& page, const Is_wanted& is_wanted)
{
  std::istringstream lines(contents_of(std::string(SELVEDGE_SOURCES) + '/' + page));
  std::vector<Row> rows;
  std::size_t level = 0; // of the heading that is wanted, 0 outside of any
  bool is_in_table = false;
  for (std::string line; std::getline(lines, line);) {
    if (const std::size_t marks = line.find_first_not_of('#');
        line[0] == '#' && (level == 0 || marks <= level))
      level = is_wanted(line) ? marks : 0;
    if (level == 0 || line.rfind("| ", 0) != 0) {
      is_in_table = false;
      continue;
    }
    Row row;
    for (std::size_t begin = 2; begin < line.size();) {
      const std::size_t end = line.find(" |", begin);
      row.push_back(line.substr(begin, end - begin));
      begin = end == std::string::npos ? end : end + 3;
    }
    rows.push_back(std::move(row));
    if (!std::exchange(is_in_table, true)) // the head; a line of dashes follows
      rows.pop_back();
    else if (rows.back()[0].rfind("---", 0) == 0)
      rows.pop_back();
  }
  return rows;
}

} // namespace selvedge::test

#endif // SELVEDGE_TEST_CLI_DOCUMENTATION_H
