#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

/// \file CommandLine.h
/// What the commands of `vantage` have in common.

namespace vantage
{

/// The work that the command line asked for; returns the exit code. Errors are thrown.
using Command = std::function<int()>;

/// Each adds a subcommand that, when it is chosen, puts its work into `chosen`.
void AddRenderCommand(CLI::App& app, Command& chosen);
void AddInfoCommand(CLI::App& app, Command& chosen);
void AddLabyrinthCommand(CLI::App& app, Command& chosen);
void AddCompareCommand(CLI::App& app, Command& chosen);
void AddFormFactorsCommand(CLI::App& app, Command& chosen);
void AddPlatesCommand(CLI::App& app, Command& chosen);
void AddReportCommand(CLI::App& app, Command& chosen);
void AddViewCommand(CLI::App& app, Command& chosen);

/// "vantage: what" on standard error, as one line whatever the text.
void PrintError(const std::string& what);
/// "vantage: warning: what", one line each.
void PrintWarnings(const std::vector<std::string>& warnings);

/// The suffix of a file name in lower case, such as ".png"; empty when there is none.
std::string SuffixOf(const std::string& path);

/// \throw InputError that lists the known suffixes, when that of `path` is not one of them.
void RequireSuffix(const std::string& path, const std::vector<std::string>& known);

/// Makes the folder and those above it, unless it is there. \throw InputError
void PrepareFolder(const std::string& folder);

/// How many threads an option asks for: 0 for all there are.
std::size_t ThreadsFor(int asked);

/// "a, b, c".
std::string Join(const std::vector<std::string>& words);

} // namespace vantage
