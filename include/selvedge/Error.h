// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_ERROR_H
#define SELVEDGE_ERROR_H

#include <stdexcept>
#include <string>

namespace selvedge {

/// The base class of all exceptions of this library. `what()` is one line for a person: which file or
/// argument is wrong, which element of it, and how to mend it.
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

/// The output could not be written. What stood at its path before still stands there.
class Output_error : public Error
{
public:
  using Error::Error;
};

/// An argument does not meet a precondition. Preconditions documented with this exception are checked at run
/// time, in every build.
class Argument_error : public Error
{
public:
  using Error::Error;
};

/// The hook of a `Cancellation_scope` has ended the call.
class Interrupted : public Error
{
public:
  using Error::Error;
};

} // namespace selvedge

#endif // SELVEDGE_ERROR_H
