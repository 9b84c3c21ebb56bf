// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_INTERRUPTION_H
#define SELVEDGE_APPS_INTERRUPTION_H

namespace selvedge::app {

/// Remembers the first SIGINT or SIGTERM that comes from now on; the next one kills the process as usual. The
/// first one also ends system calls that wait.
void watch_for_interruption();

/// Whether such a signal has come.
bool is_interrupted();

} // namespace selvedge::app

#endif // SELVEDGE_APPS_INTERRUPTION_H
