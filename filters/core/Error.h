#pragma once

#include <stdexcept>
#include <string>

/// \file Error.h
/// What the core throws. Every message is one line that says what is wrong, where, and the mend.

namespace vantage
{

/// Base of everything the core throws on purpose.
class Error : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The scene, a file or an argument is wrong; the user can mend it.
class InputError : public Error
{
public:
  using Error::Error;
};

/// A name that is not one of a closed list (method, camera, material, file suffix).
class UnknownNameError : public InputError
{
public:
  /// \param kind what was looked up ("method"), \param name what was given,
  /// \param known the accepted names, comma separated.
  UnknownNameError(const std::string& kind, const std::string& name, const std::string& known)
    : InputError("unknown " + kind + " '" + name + "'; choose one of: " + known)
  {
  }
};

/// The problem has no finite solution (albedo 1 in a closed scene).
class DivergenceError : public Error
{
public:
  using Error::Error;
};

} // namespace vantage
