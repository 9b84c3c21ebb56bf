// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_INTERRUPTION_H
#define SELVEDGE_APPS_INTERRUPTION_H

namespace selvedge::app {

/// From now on the first SIGINT or SIGTERM is remembered, and the next one kills as it always does. Calls of
/// the system that wait end when the first comes.
void watch_for_interruption();

bool is_interrupted();

} // namespace selvedge::app

#endif // SELVEDGE_APPS_INTERRUPTION_H
