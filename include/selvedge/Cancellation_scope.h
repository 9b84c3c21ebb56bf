// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_CANCELLATION_SCOPE_H
#define SELVEDGE_CANCELLATION_SCOPE_H

#include <selvedge/Error.h>

#include <functional>
#include <utility>

namespace selvedge {

/// Makes long calls of this library end early: while an object of this class lives, what its thread calls
/// asks a hook now and then, and throws `Interrupted` as soon as the hook returns true.
///
///     selvedge::Cancellation_scope scope([&] { return is_cancelled.load(); });
///     const selvedge::Mesh_file file = selvedge::read_mesh(path);
///
/// Everything that takes long asks: reading, preparing, reducing, judging, comparing, replaying, generating
/// and writing. For a million triangles on an ordinary processor the time between two questions is well below
/// a second; it grows about linearly, with single sorts and copies of large arrays.
///
/// **Guarantees**
/// 1. *Nothing half done*: a call that throws `Interrupted` has given nothing back, and a file that it was to
///    write is as it was before (`write_mesh`). A mesh that was being reduced in place (simplify.h) is one in
///    which some of the collapses were done, as with any stop.
/// 2. *No handler*: the library installs no handler of signals, and changes none. The hook may read what a
///    handler of yours has set.
/// 3. *Threads*: what the library does in other threads on behalf of the call asks as well. Calls of other
///    threads do not.
///
/// Of nested scopes the innermost is asked. The hook is called by several threads at once, and many times: it
/// should be quick. Once true, it should stay true.
///
/// To end a reduction early and keep what it has reached, use `Simplify_options::should_stop` instead. Where
/// both are in use, the hook here should return false from the first question of the other on.
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

  /// Throws `Interrupted` when the hook of the scope that this thread is in says so.
  static void check()
  {
    if (s_current)
      s_current->ask();
  }

  /// A function that does what another does, in the scope of the thread that calls `inherited`, whichever
  /// thread calls it: for what is handed to other threads while the scope lives.
  template <class Function>
  static auto inherited(Function function)
  {
    return [scope = s_current, function = std::move(function)](auto&&... arguments) {
      const Visit visit(scope);
      return function(std::forward<decltype(arguments)>(arguments)...);
    };
  }

private:
  // Apart, so that it does not keep a compiler from inlining who asks now and then.
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

/// For loops of many short steps: asks once in every 1024 calls.
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
