// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_SANITIZERS_H
#define SELVEDGE_TEST_SUPPORT_SANITIZERS_H

// SELVEDGE_IS_SANITIZED is defined where the compiler's address or thread sanitizer is on: a test may then do less.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SELVEDGE_IS_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SELVEDGE_IS_SANITIZED
#endif
#endif

#endif // SELVEDGE_TEST_SUPPORT_SANITIZERS_H
