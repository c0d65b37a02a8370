#pragma once

#include <functional>
#include <string>

/// \file AtomicFile.h
/// Files that are either written whole or not at all, for every format.

namespace vantage
{

/// Tries whether a file of that name could be written, and leaves nothing behind: to complain
/// before long work, not after it.
/// \throw InputError when the folder does not exist or is not writable, or the name belongs to
/// something that is not an ordinary file.
void CheckWritable(const std::string& path);

/// Calls `write` with the name of a temporary file in the same folder and with the same suffix,
/// then renames it to `path`. When `write` throws, the temporary file is removed and an older
/// file of that name stays as it was. A symbolic link is followed.
/// \throw InputError as CheckWritable, or when the disk is full.
void WriteAtomically(
  const std::string& path, const std::function<void(const std::string& temporary)>& write);

/// The same for a text that is at hand.
void WriteTextAtomically(const std::string& path, const std::string& text);

} // namespace vantage
