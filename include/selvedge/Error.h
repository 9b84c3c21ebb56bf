// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_ERROR_H
#define SELVEDGE_ERROR_H

#include <stdexcept>
#include <string>

namespace selvedge {

/// What every exception of this library derives from. `what()` is one line for a person: which file or
/// argument, which element of it, and what would mend it.
class Error : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The input cannot be read, or is not a mesh that this library accepts.
class Input_error : public Error
{
public:
  using Error::Error;
};

/// The result could not be written; what stood at its path before still stands there.
class Output_error : public Error
{
public:
  using Error::Error;
};

/// A precondition on an argument that is checked at run time, in every build, was not met.
class Argument_error : public Error
{
public:
  using Error::Error;
};

/// Somebody wanted the call to end: see Cancellation_scope.h.
class Interrupted : public Error
{
public:
  using Error::Error;
};

} // namespace selvedge

#endif // SELVEDGE_ERROR_H
