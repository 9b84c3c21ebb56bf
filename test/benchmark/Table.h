// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_BENCHMARK_TABLE_H
#define SELVEDGE_BENCHMARK_TABLE_H

#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

namespace selvedge::benchmark {

using Row = std::vector<std::string>;

/// A number in a cell.
inline std::string text(double number)
{
  if (std::isnan(number))
    return "-";
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.3g", number);
  return buffer;
}

/// Printed as markdown row by row, since rows take their time, and kept as CSV. Cells hold neither commas nor
/// quotes nor bars, and the first of a row is not empty.
class Table
{
public:
  explicit Table(const Row& header)
  {
    add(header);
    print(Row(header.size(), "---"));
  }

  void add(const Row& row)
  {
    print(row);
    m_csv += joined(row, ",") + '\n';
  }

  const std::string& csv() const { return m_csv; }

private:
  static void print(const Row& row) { std::cout << "| " << joined(row, " | ") << " |" << std::endl; }

  static std::string joined(const Row& row, const std::string& separator)
  {
    std::string line;
    for (const std::string& cell : row)
      line += (line.empty() ? "" : separator) + cell;
    return line;
  }

  std::string m_csv;
};

} // namespace selvedge::benchmark

#endif // SELVEDGE_BENCHMARK_TABLE_H
