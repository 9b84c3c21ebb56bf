// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_CANCELLATION_SCOPE_H
#define SELVEDGE_CANCELLATION_SCOPE_H

#include <selvedge/Error.h>

#include <functional>
#include <utility>

namespace selvedge {

/// Ends long calls of this library early. While an object of this class lives, the calls that its thread
/// makes ask a hook from time to time, and throw `Interrupted` as soon as the hook returns true.
///
///     selvedge::Cancellation_scope scope([&] { return is_cancelled.load(); });
///     const selvedge::Mesh_file file = selvedge::read_mesh(path);
///
/// All work that takes long asks the hook: reading, preparing, reducing, judging, comparing, replaying,
/// generating and writing. For a million triangles on an ordinary processor, the time between two calls of
/// the hook is well below a second. It grows about linearly with the mesh, because no single sort or copy of
/// a large array is interrupted.
///
/// **Guarantees**
/// 1. *Nothing half done*: a call that throws `Interrupted` returns nothing, and a file that it was to write
///    is as it was before (`write_mesh`). A mesh that was being reduced in place (`simplify_mesh`) has
///    undergone some of its collapses, as with any stop.
/// 2. *No handler*: the library neither installs nor changes a signal handler. The hook may read what a
///    handler of yours has set.
/// 3. *Threads*: work that the library does in other threads on behalf of the call asks the hook, too. Calls
///    that other threads make do not.
///
/// Of nested scopes, only the innermost is asked. Several threads may call the hook at once, and they call it
/// often: it should be quick. Once it has returned true, it should go on returning true.
///
/// To end a reduction early and keep what it has reached, use `Simplify_options::should_stop` instead. Where
/// that is to happen, this hook should return false from the first call of `should_stop` on: it is asked,
/// too.
class Cancellation_scope
{
public:
  explicit Cancellation_scope(std::function<bool()> should_stop)
      : m_should_stop(std::move(should_stop)), m_outer(s_current)
  {
    s_current = this;
  }
  ~Cancellation_scope() { s_current = m_outer; }
  Cancellation_scope(const Cancellation_scope&) = delete;
  Cancellation_scope& operator=(const Cancellation_scope&) = delete;

  /// Asks the hook of the scope that this thread is in, if any, and throws `Interrupted` when it returns
  /// true.
  static void check()
  {
    if (s_current)
      s_current->ask();
  }

  /// Returns a function that does what `function` does, in the scope that the calling thread is in now,
  /// whichever thread calls the function later. Use it for work that is handed to other threads while the
  /// scope lives.
  template <class Function>
  static auto inherited(Function function)
  {
    return [scope = s_current, function = std::move(function)](auto&&... arguments) {
      const Visit visit(scope);
      return function(std::forward<decltype(arguments)>(arguments)...);
    };
  }

private:
  // Not inlined, so that compilers inline `check` into its callers.
  [[gnu::noinline]] void ask() const
  {
    if (m_should_stop && m_should_stop())
      throw Interrupted("interrupted");
  }

  class Visit
  {
  public:
    explicit Visit(const Cancellation_scope* scope) : m_own(s_current) { s_current = scope; }
    ~Visit() { s_current = m_own; }
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;

  private:
    const Cancellation_scope* m_own;
  };

  static inline thread_local const Cancellation_scope* s_current = nullptr;

  std::function<bool()> m_should_stop;
  const Cancellation_scope* m_outer;
};

/// Calls `Cancellation_scope::check` once in every 1024 of its own calls: for loops of many short steps.
class Cancellation_poll
{
public:
  void operator()()
  {
    if (++m_calls % 1024 == 0)
      Cancellation_scope::check();
  }

private:
  unsigned m_calls = 0;
};

} // namespace selvedge

#endif // SELVEDGE_CANCELLATION_SCOPE_H
