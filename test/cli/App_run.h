// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_CLI_APP_RUN_H
#define SELVEDGE_TEST_CLI_APP_RUN_H

#include "support/Temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace selvedge::test {

inline void write_text(const std::filesystem::path& path, const std::string& text)
{
  std::ofstream(path, std::ios::binary) << text;
}

struct App_limits
{
  rlim_t file_size = RLIM_INFINITY;
  rlim_t memory = RLIM_INFINITY;
};

/// Where the app is: what the environment variable SELVEDGE_APP names, or the app of the build.
inline std::string path_of_app()
{
  const char* const path = std::getenv("SELVEDGE_APP");
  return path ? path : SELVEDGE_APP;
}

/// The app, running, its stderr a terminal when that is wanted.
class App_process
{
public:
  explicit App_process(const std::vector<std::string>& arguments, bool is_on_terminal = false,
                       const App_limits& limits = {})
  {
    int slave = -1;
    if (is_on_terminal && ::openpty(&m_terminal, &slave, nullptr, nullptr, nullptr) != 0)
      throw std::runtime_error("no terminal can be opened");
    const std::string app = path_of_app();
    std::vector<char*> argv{const_cast<char*>(app.c_str())};
    for (const std::string& argument : arguments)
      argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const std::string out = out_path(), err = err_path();
    m_id = ::fork();
    if (m_id < 0)
      throw std::runtime_error("the app cannot be started");
    if (m_id == 0) {
      // A full disk, for a file of more than `file_size` bytes.
      std::signal(SIGXFSZ, SIG_IGN);
      ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
      ::dup2(is_on_terminal ? slave : ::open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
      const rlimit file_size{limits.file_size, limits.file_size};
      const rlimit memory{limits.memory, limits.memory};
      ::setrlimit(RLIMIT_FSIZE, &file_size);
      ::setrlimit(RLIMIT_AS, &memory);
      ::execv(argv[0], argv.data());
      ::_exit(127);
    }
    if (slave >= 0)
      ::close(slave);
  }

  ~App_process()
  {
    if (m_id > 0) {
      ::kill(m_id, SIGKILL);
      ::waitpid(m_id, nullptr, 0);
    }
    if (m_terminal >= 0)
      ::close(m_terminal);
  }
  App_process(const App_process&) = delete;
  App_process& operator=(const App_process&) = delete;

  /// Reads the terminal until it has shown `text`, after all that it was read for before; false when the app
  /// ends first, or in five minutes.
  bool shows(const std::string& text)
  {
    std::size_t place;
    while ((place = m_shown.find(text, m_read)) == std::string::npos)
      if (!read_terminal())
        return false;
    m_read = place + text.size();
    return true;
  }

  void send(int signal) const { ::kill(m_id, signal); }

  /// The exit code, or minus the number of the signal that ended it.
  int wait()
  {
    while (m_terminal >= 0 && read_terminal()) {
    }
    int status = 0;
    ::waitpid(m_id, &status, 0);
    m_id = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  std::string out() const { return contents_of(out_path()); }
  std::string err() const { return m_terminal >= 0 ? m_shown : contents_of(err_path()); }

private:
  std::string out_path() const { return m_folder / "out"; }
  std::string err_path() const { return m_folder / "err"; }

  bool read_terminal()
  {
    pollfd ready{m_terminal, POLLIN, 0};
    char buffer[4096];
    if (::poll(&ready, 1, 300'000) <= 0)
      return false;
    const ssize_t count = ::read(m_terminal, buffer, sizeof buffer);
    if (count <= 0)
      return false;
    m_shown.append(buffer, std::size_t(count));
    return true;
  }

  Temporary_folder m_folder;
  pid_t m_id = 0;
  int m_terminal = -1;
  std::string m_shown;
  std::size_t m_read = 0; // of what was shown, up to the last text that was waited for
};

struct App_result
{
  int code;
  std::string out;
  std::string err;

  /// An error is told in one line.
  bool is_one_line() const
  {
    return err.rfind("selvedge: ", 0) == 0 && std::count(err.begin(), err.end(), '\n') == 1 &&
           err.back() == '\n';
  }
};

inline App_result run_app(const std::vector<std::string>& arguments, const App_limits& limits = {})
{
  App_process process(arguments, false, limits);
  const int code = process.wait();
  return {code, process.out(), process.err()};
}

/// What a refused run looks like: the code, one line that says `what`, and nothing on stdout.
inline void expect_refused(const std::vector<std::string>& arguments, int code, const std::string& what,
                           const App_limits& limits = {})
{
  const App_result result = run_app(arguments, limits);
  EXPECT_EQ(result.code, code) << result.err;
  EXPECT_TRUE(result.is_one_line()) << result.err;
  EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
}

/// A folder with a mesh in it, made by the app.
class Workspace
{
public:
  std::string operator/(const std::string& name) const { return (m_folder / name).string(); }

  std::string generate(const std::string& scene, const std::string& name, std::size_t faces,
                       int layers = 2) const
  {
    const std::string path = *this / name;
    std::vector<std::string> command{"generate", scene, "-o", path, "--faces", std::to_string(faces),
                                     "--quiet"};
    if (scene != "grid" && scene != "seams" && scene != "tunnel") // which have no layers
      command.insert(command.end(), {"--layers", std::to_string(layers)});
    const App_result result = run_app(command);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.out + result.err, "");
    return path;
  }

  std::size_t files() const
  {
    return std::size_t(std::distance(std::filesystem::directory_iterator(m_folder.path()), {}));
  }

private:
  Temporary_folder m_folder;
};

} // namespace selvedge::test

#endif // SELVEDGE_TEST_CLI_APP_RUN_H
