// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Runs any number of random worlds, each in a process that may crash or hang, judges every collapse, shrinks
// what fails, and writes it as files.

#include "judge_world.h"
#include "random_world.h"
#include "shrunk_world.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace selvedge::test {
namespace {

using Clock = std::chrono::steady_clock;

struct Request
{
  std::uint64_t seed = 1;
  std::uint64_t count = 1000; ///< without a limit when `minutes` has one
  double minutes = 0;         ///< after which no world is begun; 0: no limit
  std::uint64_t replay_every = 1;
  std::size_t option_sets = 0;
  unsigned processes = 1;
  double seconds = 60;    ///< that a world may take
  std::size_t shrink = 3; ///< so many failures, for each promise
  std::filesystem::path output = "failed_worlds";
  std::filesystem::path world; ///< a folder to run again
};

const char* const s_usage =
    "worlds [--seed N] [--count M] [--minutes T] [--processes P] [--replay-every R] [--options O] "
    "[--seconds S]\n"
    "       [--shrink K] [--output FOLDER]\n"
    "worlds FOLDER\n\n"
    "Runs the worlds of the seeds N to N + M - 1 and judges every collapse by brute force, the log by the "
    "replay, the\n"
    "file by reading it, and twins by what they must have in common. What fails is shrunk, K worlds for each "
    "promise,\n"
    "and written to a folder of its own in FOLDER, which the second form runs again. A world may take S "
    "seconds.\n"
    "With --minutes no world begins after T minutes, and without --count there is no other end. With "
    "--replay-every the\n"
    "replay is asked about every Rth world alone; with --options every input is reduced O times more, with "
    "other options.\n"
    "Both make a collapse cheaper to judge. Every minute a line says what has been judged, and a second one "
    "how many\n"
    "reductions had which option.\n"
    "Exit code 1: a promise was broken.\n";

Request read_request(int count, char** arguments)
{
  Request request;
  bool has_count = false;
  for (int i = 1; i < count; ++i) {
    const std::string option = arguments[i];
    if (option.compare(0, 2, "--") != 0) {
      request.world = option;
      continue;
    }
    if (i + 1 == count)
      throw std::invalid_argument(option + " wants a value");
    const std::string value = arguments[++i];
    if (option == "--seed")
      request.seed = std::stoull(value);
    else if (option == "--count") {
      request.count = std::stoull(value);
      has_count = true;
    } else if (option == "--minutes")
      request.minutes = std::stod(value);
    else if (option == "--replay-every")
      request.replay_every = std::max(1ull, std::stoull(value));
    else if (option == "--options")
      request.option_sets = std::stoul(value);
    else if (option == "--processes")
      request.processes = unsigned(std::max(1ul, std::stoul(value)));
    else if (option == "--seconds")
      request.seconds = std::stod(value);
    else if (option == "--shrink")
      request.shrink = std::stoul(value);
    else if (option == "--output")
      request.output = value;
    else
      throw std::invalid_argument("no option " + option);
  }
  if (request.minutes > 0 && !has_count)
    request.count = std::numeric_limits<std::uint64_t>::max() - request.seed;
  return request;
}

std::string one_line(std::string text)
{
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// "ok" with counts, or "bad" with the promise and what is wrong.
std::string verdict_line(const World& world, const Judgement_extent& extent = {})
{
  Judgement_counts counts;
  std::ostringstream line;
  if (const auto broken = judge(world, counts, extent)) {
    line << "bad " << name(broken->promise) << ": " << one_line(broken->message);
    return line.str();
  }
  line << "ok " << counts.worlds << ' ' << counts.refused_worlds << ' ' << counts.collapses << ' '
       << counts.snaps << ' ' << counts.twins << ' ' << counts.option_sets;
  for (const auto& [option, count] : counts.options)
    line << ' ' << option << ' ' << count;
  return line.str();
}

/// The counts in a line that begins with "ok".
Judgement_counts counts_in(const std::string& line)
{
  std::istringstream words(line.substr(3));
  Judgement_counts counts;
  words >> counts.worlds >> counts.refused_worlds >> counts.collapses >> counts.snaps >> counts.twins >>
      counts.option_sets;
  std::string option;
  for (std::size_t count = 0; words >> option >> count;)
    counts.options[option] = count;
  return counts;
}

/// A process that runs worlds one after another and sends two lines for each: its seed, then the verdict.
class Worker
{
public:
  /// What is asked about the world of a number is told by `verdict`.
  Worker(std::uint64_t count, const std::function<std::string(std::uint64_t)>& verdict)
  {
    int ends[2];
    if (::pipe(ends) != 0)
      throw std::runtime_error("no pipe");
    std::cout.flush();
    m_process = ::fork();
    if (m_process < 0)
      throw std::runtime_error("no process");
    if (m_process == 0) {
      ::close(ends[0]);
      const auto send = [&](std::string line) {
        line += '\n';
        for (std::size_t sent = 0; sent < line.size();) {
          const ssize_t now = ::write(ends[1], line.data() + sent, line.size() - sent);
          if (now <= 0)
            ::_exit(3);
          sent += std::size_t(now);
        }
      };
      for (std::uint64_t i = 0; i < count; ++i) {
        send("world " + std::to_string(i));
        std::string line;
        try {
          line = verdict(i);
        } catch (const std::exception& error) {
          line = std::string("bad world: ") + one_line(error.what());
        }
        send(line);
      }
      ::_exit(0);
    }
    ::close(ends[1]);
    m_pipe = ends[0];
  }

  ~Worker() { end(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  int pipe() const { return m_pipe; }
  std::uint64_t current() const { return m_current; }

  /// Reads what is there. False when nothing more will come.
  bool read(const std::function<void(std::uint64_t, const std::string&)>& on_verdict)
  {
    char buffer[4096];
    const ssize_t count = ::read(m_pipe, buffer, sizeof buffer);
    if (count <= 0)
      return false;
    m_heard = Clock::now();
    m_heard_in_process = seconds_of_process();
    m_text.append(buffer, std::size_t(count));
    for (std::size_t end; (end = m_text.find('\n')) != std::string::npos; m_text.erase(0, end + 1)) {
      const std::string line = m_text.substr(0, end);
      m_is_busy = line.compare(0, 6, "world ") == 0;
      if (m_is_busy)
        m_current = std::stoull(line.substr(6));
      else
        on_verdict(m_current, line);
    }
    return true;
  }

  /// Of a processor, since it was last heard of: a machine that is busy otherwise makes nothing hang. Who
  /// only waits hangs, too, after thirty times as long.
  double seconds_silent() const
  {
    const double waited = std::chrono::duration<double>(Clock::now() - m_heard).count();
    return std::max(seconds_of_process() - m_heard_in_process, waited / 30);
  }

  /// Ends the process, and says how the world at hand ended if that was not of its own accord.
  std::optional<std::string> end(bool is_hanging = false)
  {
    if (m_process == 0)
      return std::nullopt;
    const int seconds = int(seconds_silent());
    if (is_hanging)
      ::kill(m_process, SIGKILL);
    int status = 0;
    ::waitpid(m_process, &status, 0);
    ::close(m_pipe);
    m_process = 0;
    if (is_hanging)
      return "bad hang: no end after " + std::to_string(seconds) + " seconds";
    if (WIFSIGNALED(status))
      return std::string("bad crash: ") + ::strsignal(WTERMSIG(status));
    return m_is_busy ? std::optional<std::string>("bad crash: ended early") : std::nullopt;
  }

private:
  double seconds_of_process() const
  {
    ::clockid_t clock;
    ::timespec time{};
    if (::clock_getcpuclockid(m_process, &clock) != 0 || ::clock_gettime(clock, &time) != 0)
      return m_heard_in_process;
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
  }

  ::pid_t m_process = 0;
  int m_pipe = -1;
  std::uint64_t m_current = 0;
  bool m_is_busy = false;
  std::string m_text;
  Clock::time_point m_heard = Clock::now();
  double m_heard_in_process = 0;
};

/// The verdict on one world, in a process of its own.
std::string verdict_in_process(const World& world, double seconds)
{
  Worker worker(1, [&](std::uint64_t) { return verdict_line(world); });
  std::string verdict;
  for (;;) {
    ::pollfd waiting{worker.pipe(), POLLIN, 0};
    ::poll(&waiting, 1, 200);
    if (waiting.revents != 0) {
      if (!worker.read([&](std::uint64_t, const std::string& line) { verdict = line; }))
        return worker.end().value_or(verdict);
    } else if (worker.seconds_silent() > seconds) {
      return *worker.end(true);
    }
  }
}

/// What makes two failures alike: the promise, and the first words of what is wrong, without numbers.
std::string kind_of(const std::string& verdict)
{
  std::string kind = verdict;
  kind.erase(std::remove_if(kind.begin(), kind.end(), [](char c) { return c >= '0' && c <= '9'; }),
             kind.end());
  const std::size_t colon = kind.find(':'), second = kind.find(':', colon + 1);
  kind.resize(std::min({kind.size(), second, colon + 40}));
  return kind;
}

class Campaign
{
public:
  explicit Campaign(const Request& request) : m_request(request), m_start(Clock::now()) {}

  bool run()
  {
    std::vector<std::unique_ptr<Batch>> batches;
    std::uint64_t next = m_request.seed;
    const std::uint64_t beyond = m_request.seed + m_request.count;
    for (;;) {
      while (!is_over() && batches.size() < m_request.processes && (next < beyond || !m_left.empty())) {
        if (m_left.empty()) {
          const std::uint64_t end = std::min(beyond, next + s_batch);
          m_left.push_back({next, end});
          next = end;
        }
        const auto [first, end] = m_left.back();
        m_left.pop_back();
        batches.push_back(std::make_unique<Batch>(first, end, [&, begin = first](std::uint64_t i) {
          const std::uint64_t seed = begin + i;
          return verdict_line(random_world(seed),
                              {seed % m_request.replay_every == 0, m_request.option_sets});
        }));
      }
      if (batches.empty())
        break;
      serve(batches);
    }
    tell(true);
    return m_failures.empty();
  }

private:
  static constexpr std::uint64_t s_batch = 200;

  struct Batch
  {
    Batch(std::uint64_t first_, std::uint64_t beyond_,
          const std::function<std::string(std::uint64_t)>& verdict)
        : first(first_), beyond(beyond_), worker(beyond_ - first_, verdict)
    {
    }

    std::uint64_t first, beyond;
    Worker worker;
  };

  void serve(std::vector<std::unique_ptr<Batch>>& batches)
  {
    std::vector<::pollfd> waiting;
    for (const auto& batch : batches)
      waiting.push_back({batch->worker.pipe(), POLLIN, 0});
    ::poll(waiting.data(), waiting.size(), 500);
    for (std::size_t i = batches.size(); i-- > 0;) {
      Batch& batch = *batches[i];
      const bool is_hanging = waiting[i].revents == 0 && batch.worker.seconds_silent() > m_request.seconds;
      if (!is_hanging &&
          (waiting[i].revents == 0 || batch.worker.read([&](std::uint64_t number, const std::string& line) {
            add(batch.first + number, line);
          })))
        continue;
      if (const auto how = batch.worker.end(is_hanging)) {
        const std::uint64_t seed = batch.first + batch.worker.current();
        if (seed + 1 < batch.beyond)
          m_left.push_back({seed + 1, batch.beyond});
        add(seed, *how);
      }
      batches.erase(batches.begin() + std::ptrdiff_t(i));
    }
    tell(false);
  }

  void add(std::uint64_t seed, const std::string& verdict)
  {
    ++m_done;
    if (verdict.compare(0, 3, "ok ") == 0) {
      m_counts += counts_in(verdict);
      return;
    }
    std::cout << "seed " << seed << ": " << verdict.substr(4) << std::endl;
    if (++m_failures[kind_of(verdict)] <= m_request.shrink)
      shrink(seed, verdict);
  }

  void shrink(std::uint64_t seed, const std::string& verdict)
  {
    const std::string kind = kind_of(verdict);
    // What hangs is told from what is slow by a tenth of the time.
    const double seconds = kind.compare(0, 8, "bad hang") == 0 ? m_request.seconds / 10 : m_request.seconds;
    const auto fails = [&](const World& world) {
      return kind_of(verdict_in_process(world, seconds)) == kind;
    };
    World world = random_world(seed);
    for (std::size_t number = 1; number <= m_request.option_sets && !fails(world); ++number)
      world = with_other_options(random_world(seed), number);
    if (!fails(world)) {
      std::cout << "  does not fail again" << std::endl;
      return;
    }
    const World small = shrunk(world, fails);
    const std::filesystem::path folder =
        m_request.output / (verdict.substr(4, verdict.find(':') - 4) + '_' + std::to_string(seed));
    try {
      write_world(small, folder);
      std::cout << "  " << verdict_in_process(small, seconds).substr(4) << "\n  " << describe(small)
                << "\n  worlds '" << folder.string() << '\'' << std::endl;
      if (!fails(read_world(folder)))
        std::cout << "  but not when read from the files" << std::endl;
    } catch (const std::exception& error) {
      std::cout << "  " << describe(small) << "\n  cannot be written: " << error.what() << std::endl;
    }
  }

  double seconds() const { return std::chrono::duration<double>(Clock::now() - m_start).count(); }
  bool is_over() const { return m_request.minutes > 0 && seconds() > 60 * m_request.minutes; }

  void tell(bool is_end)
  {
    if (!is_end && seconds() < m_told + 60)
      return;
    m_told = seconds();
    std::cout << m_done << " seeds from " << m_request.seed << ": " << m_counts.worlds << " worlds accepted, "
              << m_counts.refused_worlds << " refused, " << m_counts.collapses << " collapses and "
              << m_counts.snaps << " snaps judged, " << m_counts.twins << " twins, " << m_counts.option_sets
              << " other sets of options, " << int(m_told) << " s";
    for (const auto& [kind, count] : m_failures)
      std::cout << ", " << count << " x " << kind.substr(4);
    std::cout << "\n  reductions by option:";
    for (const auto& [option, count] : m_counts.options)
      std::cout << ' ' << option << ' ' << count;
    std::cout << std::endl;
  }

  const Request& m_request;
  Clock::time_point m_start;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> m_left; // of batches that ended early
  Judgement_counts m_counts;
  std::map<std::string, std::size_t> m_failures;
  std::uint64_t m_done = 0;
  double m_told = 0; // seconds after the start
};

} // namespace
} // namespace selvedge::test

int main(int count, char** arguments)
{
  using namespace selvedge::test;
  try {
    const Request request = read_request(count, arguments);
    if (request.world.empty())
      return Campaign(request).run() ? 0 : 1;
    const World world = read_world(request.world);
    std::cout << describe(world) << '\n';
    const std::string verdict = verdict_in_process(world, request.seconds);
    std::cout << verdict << std::endl;
    return verdict.compare(0, 3, "ok ") == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "worlds: " << error.what() << "\n\n" << s_usage;
    return 2;
  }
}
