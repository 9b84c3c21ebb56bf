// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_PROGRESS_BAR_H
#define SELVEDGE_APPS_PROGRESS_BAR_H

#include "text.h"

#include <selvedge/Simplify_options.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <iostream>
#include <string>

#include <unistd.h>

namespace selvedge::app {

/// Shows one line on stderr: what is being done, how fast, and how long it will take. It shows nothing unless
/// stderr is a terminal.
class Progress_bar
{
  using Clock = std::chrono::steady_clock;

public:
  explicit Progress_bar(bool is_wanted) : m_is_shown(is_wanted && ::isatty(STDERR_FILENO)) {}
  ~Progress_bar() { clear(); }
  Progress_bar(const Progress_bar&) = delete;
  Progress_bar& operator=(const Progress_bar&) = delete;

  /// Begins a phase, which the line names, with the number of poses where there are further ones.
  void begin(const std::string& phase, std::size_t further_poses = 0)
  {
    m_is_reducing = false;
    show(phase + (further_poses == 0 ? "" : " in " + counted(1 + further_poses, "pose")) + " …");
  }

  void update(const Simplify_progress& progress)
  {
    const Clock::time_point now = Clock::now();
    if (!m_is_reducing)
      m_start = m_shown_at = now;
    m_is_reducing = true;
    if (!m_is_shown || now - m_shown_at < std::chrono::milliseconds(100))
      return;
    m_shown_at = now;
    const double seconds = std::chrono::duration<double>(now - m_start).count();
    const double rate = double(progress.faces_input - progress.faces) / seconds;
    std::string line = "reducing ";
    if (progress.faces_target > 0 && progress.faces_target < progress.faces_input) {
      const double done = double(progress.faces_input - progress.faces) /
                          double(progress.faces_input - progress.faces_target);
      const std::size_t filled = (std::min)(std::size_t(done * width), width);
      line += '[' + std::string(filled, '=') + std::string(width - filled, ' ') + "] " +
              with_digits(100 * done, "%.0f %%") + ", ";
    }
    line += counted(progress.faces, "face") + ", " + with_commas(std::size_t(rate)) + " removed/s";
    if (progress.faces_target > 0 && rate > 0)
      line += ", " + with_digits(double(progress.faces - progress.faces_target) / rate, "%.0f s") + " left";
    show(line);
  }

  void clear() { show(""); }

  /// Prints a message of the program in place of the line.
  void complain(const std::string& message)
  {
    clear();
    std::cerr << "selvedge: " << message << std::endl;
  }

private:
  static constexpr std::size_t width = 16;

  void show(const std::string& line) const
  {
    if (m_is_shown)
      std::cerr << "\r\033[K" << line << std::flush;
  }

  bool m_is_shown;
  bool m_is_reducing = false;
  Clock::time_point m_start{};
  Clock::time_point m_shown_at{};
};

} // namespace selvedge::app

#endif // SELVEDGE_APPS_PROGRESS_BAR_H
