// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_HTML_PAGE_H
#define SELVEDGE_APPS_HTML_PAGE_H

#include <string_view>

namespace selvedge::app {

/// Returns page.html with its script, or nothing where the program was built without what this needs.
std::string_view html_page();

} // namespace selvedge::app

#endif // SELVEDGE_APPS_HTML_PAGE_H
